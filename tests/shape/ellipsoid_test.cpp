// The exact ellipsoid and ellipse against a bisection in extended precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"
#include "support/evaluate.h"

namespace sdf {
namespace ellipsoid_test {

using glm::dvec3;
using test::Evaluator;
using Long = long double;

constexpr unsigned kSeed = 20240613;

// What the header promises, in largest radii, or in distances where the point is far.
constexpr double kAccuracy = 5e-7;

// Root of sum (r y / (s + r^2 - r_min^2))^2 = 1 by bisection, in the logarithm while it is uncertain by
// factors.
double bisectedDistance(const std::array<double, 3>& radii, const dvec3& p) {
  const Long least = *std::min_element(radii.begin(), radii.end());
  std::array<Long, 3> y, gap;
  Long low = 0, high = 0;
  for (int i = 0; i < 3; ++i) {
    y[i] = std::max<Long>(std::abs(Long(p[i])), 1e-15L * radii[i]);
    gap[i] = Long(radii[i]) * radii[i] - least * least;
    high += y[i] * y[i] * radii[i] * radii[i];
  }
  high = std::sqrt(high);
  for (int step = 0; step < 400; ++step) {
    const Long s = high > 4 * low ? std::sqrt(std::max(low, Long(1e-30)) * high) : (low + high) / 2;
    Long sum = 0;
    for (int i = 0; i < 3; ++i) sum += std::pow(radii[i] * y[i] / (s + gap[i]), 2);
    (sum >= 1 ? low : high) = s;
  }
  Long squares = 0;
  for (int i = 0; i < 3; ++i) squares += std::pow(y[i] / (low + gap[i]), 2);
  return double((low - least * least) * std::sqrt(squares));
}

struct Case {
  std::array<double, 3> radii;
  dvec3 point;
};

// Radii in ratios up to `aspect`, the largest 1; points that like symmetry planes and the edge of the disc
// between the focal points, where iterations of this kind are slow.
Case adversary(std::mt19937& random, double aspect) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Case c;
  for (double& r : c.radii) r = std::pow(aspect, unit(random));
  const double kind = unit(random);
  if (kind < 0.3) c.radii[1] = c.radii[0];
  if (kind > 0.8) c.radii[1] = c.radii[0] * 1.0001;
  const double largest = *std::max_element(c.radii.begin(), c.radii.end());
  for (double& r : c.radii) r /= largest;
  std::shuffle(c.radii.begin(), c.radii.end(), random);
  const double least = *std::min_element(c.radii.begin(), c.radii.end());
  for (int i = 0; i < 3; ++i) {
    const double r = c.radii[i];
    c.point[i] = (2.6 * unit(random) - 1.3) * r;
    if (unit(random) < 0.2) {
      const double off = std::pow(10.0, -6.0 * unit(random));
      c.point[i] = (r * r - least * least) / r * (unit(random) < 0.5 ? 1.0 + off : 1.0 - off);
    }
    if (unit(random) < 0.3) c.point[i] *= std::pow(10.0, -9.0 * unit(random));
    if (unit(random) < 0.1) c.point[i] = 0.0;
  }
  if (unit(random) < 0.1) c.point *= std::pow(10.0, 5.0 * unit(random));
  return c;
}

TEST(Ellipsoid, IsExactForNeedlesDiscsAndPointsNearTheFocalDisc) {
  std::mt19937 random(kSeed);
  for (double aspect : {1.2, 2.0, 10.0, 100.0}) {
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const Case c = adversary(random, aspect);
      const Shape s = ellipsoid({c.radii[0], c.radii[1], c.radii[2]});
      const double expected = bisectedDistance(c.radii, c.point);
      const double error =
          std::abs(Evaluator(s.distance)(c.point) - expected) / std::max(1.0, std::abs(expected));
      ASSERT_LE(error, kAccuracy) << "radii " << c.radii[0] << ", " << c.radii[1] << ", " << c.radii[2]
                                  << " at " << c.point.x << ", " << c.point.y << ", " << c.point.z
                                  << ", seed " << kSeed;
      worst = std::max(worst, error);
    }
    RecordProperty("worst_at_ratio_" + std::to_string(int(aspect)), std::to_string(worst * 1e9) + "e-9");
  }
}

TEST(Ellipse, IsExactForThinOnesToo) {
  std::mt19937 random(kSeed);
  for (double aspect : {2.0, 100.0}) {
    for (int i = 0; i < 4000; ++i) {
      const Case c = adversary(random, aspect);
      const Shape s = ellipse(c.radii[0], c.radii[1]);
      // The section of an ellipsoid whose third axis is no shorter: the closest point stays in the plane.
      const double expected = bisectedDistance({c.radii[0], c.radii[1], std::max(c.radii[0], c.radii[1])},
                                               {c.point.x, c.point.y, 0});
      const double error =
          std::abs(Evaluator(s.distance)(c.point) - expected) / std::max(1.0, std::abs(expected));
      ASSERT_LE(error, kAccuracy) << "radii " << c.radii[0] << ", " << c.radii[1] << " at " << c.point.x
                                  << ", " << c.point.y << ", seed " << kSeed;
    }
  }
}

TEST(Ellipsoid, HasItsSmallestRadiusAtTheCentre) {
  EXPECT_NEAR(Evaluator(ellipsoid({3.0, 1.0, 2.0}).distance)({0, 0, 0}), -1.0, 3.0 * kAccuracy);
  EXPECT_NEAR(Evaluator(ellipsoid({1.0, 0.05, 1.0}).distance)({0, 0, 0}), -0.05, kAccuracy);
  EXPECT_NEAR(Evaluator(ellipse(0.05, 1.0).distance)({0, 0, 0}), -0.05, kAccuracy);
}

// Meshes take their normals from the gradient at the surface: it must be that of sum (p / r)^2.
TEST(Ellipsoid, HasTheTrueNormalOnItsSurface) {
  std::mt19937 random(kSeed);
  std::normal_distribution<double> normal;
  for (const dvec3& r : {dvec3(1, 0.6, 0.4), dvec3(0.05, 1, 0.05), dvec3(1, 0.03, 0.8)}) {
    const Evaluator f(ellipsoid({r.x, r.y, r.z}).distance);
    for (int i = 0; i < 500; ++i) {
      const dvec3 p = r * glm::normalize(dvec3{normal(random), normal(random), normal(random)});
      // Closer to the focal disc than this a needle's or disc's medial sheet would be seen by the
      // differences.
      const double step = 1e-4 * std::min({r.x, r.y, r.z}) * std::min({r.x, r.y, r.z});
      const dvec3 expected = glm::normalize(p / (r * r));
      // Differences: curvature^2 step^2, at most (r_max / r_min^2 * step)^2 = 1e-8, and what is rounded,
      // 1e-16 / step.
      EXPECT_LE(glm::distance(f.gradient(p, step), expected), 1e-6)
          << "radii " << r.x << ", " << r.y << ", " << r.z << " at " << p.x << ", " << p.y << ", " << p.z
          << ", seed " << kSeed;
    }
  }
}

TEST(Ellipsoid, IsASphereInFewOperationsWhereAllRadiiAreOne) {
  EXPECT_LE(topologicalOrder(std::array{ellipsoid(Vec3E(2.0)).distance}).size(), 16u);
  EXPECT_LE(topologicalOrder(std::array{ellipsoid({1.0, 2.0, 1.0}).distance}).size(), 160u);
  EXPECT_LE(topologicalOrder(std::array{ellipsoid({1.0, 2.0, 3.0}).distance}).size(), 300u);
  EXPECT_LE(topologicalOrder(std::array{ellipsoidBound({1.0, 2.0, 3.0}).distance}).size(), 16u);
}

}  // namespace ellipsoid_test
}  // namespace sdf
