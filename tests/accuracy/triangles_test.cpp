// Distances to triangle meshes held to exact arithmetic.
#include <gtest/gtest.h>

#include "reference/exact_distance.h"
#include "sdf/triangles/distance.h"
#include "support/triangle_meshes.h"

namespace sdf::test {
namespace triangles_test {

double ulpOf(double v) { return std::nextafter(v, HUGE_VAL) - v; }

/// The largest difference at random points in and around the mesh, and near it by all sorts of distances.
double worstUlps(const ClosedTriangles& all, int count, unsigned seed) {
  const accuracy::ExactDistance exact(all.points, all.triangles);
  const TriangleDistance distance(all);
  std::mt19937 random(seed);
  double worst = 0.0;
  const auto look = [&](const glm::dvec3& p) {
    const double truth = exact(p), f = std::abs(distance.read(p).distance);
    worst = std::max(worst, std::abs(f - truth) / ulpOf(truth));
    return f;
  };
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 p = randomIn(random, 1.7);
    look(p);
    const TriangleDistance::Read read = distance.read(p);
    const double part = std::exp2(-1.0 - static_cast<double>(random() % 40));
    look(p - (1.0 - part) * read.distance * read.gradient);
  }
  return worst;
}

TEST(TriangleAccuracy, OfATorusIsWithinFourUlpOfCgals) {
  EXPECT_LE(worstUlps(closed(bumpyTorus(40)), 500, 1), 4.0);
}

TEST(TriangleAccuracy, OfAHundredThousandTrianglesIsWithinFourUlpOfCgals) {
  const ClosedTriangles all = closed(bumpyTorus(224));
  ASSERT_GT(all.triangles.size(), 100000u);
  EXPECT_LE(worstUlps(all, 200, 2), 4.0);
}

TEST(TriangleAccuracy, OfAMeshWithHolesIsWithinFourUlpOfCgals) {
  std::mt19937 random(3);
  const TriangleMesh torus = bumpyTorus(40);
  EXPECT_LE(worstUlps(closed(without(torus, [&](std::size_t) { return random() % 20 == 0; })), 300, 3), 4.0);
}

// Slivers: corners of a very flat box and long thin triangles.
TEST(TriangleAccuracy, OfSliversIsWithinFourUlpOfCgals) {
  EXPECT_LE(worstUlps(closed(boxOf({-1.0f, -1e-6f, -1.0f}, {1.0f, 1e-6f, 1.0f})), 300, 4), 4.0);
  const TriangleMesh needles = ring(3, 400, [](double u, double v) {
    return glm::dvec3((1.0 + 0.3 * std::cos(v)) * std::cos(u), 0.3 * std::sin(v),
                      (1.0 + 0.3 * std::cos(v)) * std::sin(u));
  });
  EXPECT_LE(worstUlps(closed(needles), 300, 5), 4.0);
}

}  // namespace triangles_test
}  // namespace sdf::test
