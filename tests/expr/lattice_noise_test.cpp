// Noises on a lattice: what they promise, beside what is asked of every payload (payload_test.cpp).
#include "sdf/expr/lattice_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "sdf/base/box.h"

namespace sdf::test {
namespace lattice_noise_test {

using Kind = LatticeNoise::Kind;
constexpr double kScale = 0.96;  // of gradient noise
constexpr Kind kAll[] = {Kind::Value, Kind::Gradient, Kind::Nearest, Kind::Second, Kind::Border};

TEST(LatticeNoise, IsOneForEachKindAndSeed) {
  const auto noise = LatticeNoise::of(Kind::Value, 5);
  EXPECT_EQ(noise, LatticeNoise::of(Kind::Value, 5));
  const glm::dvec3 p(0.3, 1.7, -2.2);
  EXPECT_NE(noise->value(p), LatticeNoise::of(Kind::Value, 6)->value(p));
  EXPECT_NE(noise->value(p), LatticeNoise::of(Kind::Gradient, 5)->value(p));
}

// Over many cells values are all about, as often below the middle as above it, and not those of the next
// cell.
TEST(LatticeNoise, IsRandom) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-100.0, 100.0);
  for (const Kind kind : {Kind::Value, Kind::Gradient}) {
    const auto noise = LatticeNoise::of(kind);
    double sum = 0.0, squares = 0.0, product = 0.0, most = 0.0;
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) {
      const glm::dvec3 p(any(random), any(random), any(random));
      const double v = noise->value(p);
      sum += v, squares += v * v, product += v * noise->value(p + glm::dvec3(2.0, 0.0, 0.0));
      most = std::max(most, std::abs(v));
    }
    EXPECT_LT(std::abs(sum), 0.02 * kPoints);
    EXPECT_LT(std::abs(product), 0.1 * squares) << "what is two cells away knows nothing of it";
    EXPECT_GT(squares / kPoints, 0.05);
    EXPECT_GT(most, 0.7);
    EXPECT_LE(most, 1.0);
  }
}

// All points of the five cells around along each axis, without leaving any out.
TEST(LatticeNoise, FindsTheNearestPoints) {
  // Where the distance is 0 there are points: its own gradient leads to them.
  const auto nearest = LatticeNoise::of(Kind::Nearest), second = LatticeNoise::of(Kind::Second),
             border = LatticeNoise::of(Kind::Border);
  std::vector<glm::dvec3> points;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z)
        for (int i = 0; i < 8; ++i) {
          const glm::dvec3 p = glm::dvec3(x, y, z) + 0.25 + 0.5 * glm::dvec3(i & 1, i >> 1 & 1, i >> 2);
          const ValueAndGradient f = nearest->gradient(p);
          const glm::dvec3 at = p - f.value * f.gradient;
          const auto isThere = [&](const glm::dvec3& q) { return glm::distance(q, at) < 1e-9; };
          EXPECT_LT(nearest->value(at), 1e-9);
          if (std::ranges::none_of(points, isThere)) points.push_back(at);
        }
  EXPECT_GT(points.size(), 300u);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p(any(random), any(random), any(random));
    std::vector<double> distances;
    for (const glm::dvec3& q : points) distances.push_back(glm::distance(p, q));
    std::ranges::partial_sort(distances, distances.begin() + 2);
    ASSERT_NEAR(nearest->value(p), distances[0], 1e-9);
    ASSERT_NEAR(border->value(p), second->value(p) - nearest->value(p), 1e-12);
    ASSERT_LE(second->value(p), distances[1] + 1e-9);  // a point may be nearest to none of those places
  }
}

TEST(LatticeNoise, GoesOnAsItIsFarAway) {
  for (const Kind kind : kAll) {
    const auto noise = LatticeNoise::of(kind);
    EXPECT_EQ(noise->value({1e300, 0.5, 0.5}), noise->value({0x1p30, 0.5, 0.5}));
    EXPECT_EQ(noise->value({HUGE_VAL, -HUGE_VAL, 0.5}), noise->value({0x1p30, -0x1p30, 0.5}));
    EXPECT_EQ(noise->gradient({1e300, 0.5, 0.5}).gradient.x, 0.0);
    EXPECT_TRUE(std::isnan(noise->value({NAN, 0.5, 0.5})));
    EXPECT_TRUE(noise->range({Interval(0.0, HUGE_VAL), Interval(0.0), Interval(0.0)})
                    .contains(noise->value({0.5, 0.0, 0.0})));
  }
}

// The steepest that gradient noise can be, and the largest: what all twelve slopes at all eight nodes of a
// cell can come to. By a node's weight w, the ways d from it and e, which is unit, the slope along e is the
// sum of g . (w e + (e . grad w) d), and of such a product a slope makes at most the two largest components.
class SlopesOfGradientNoise : public testing::Test {
 protected:
  struct Bound {
    double value = 0.0, slope = 0.0;
  };

  // Polynomials of t in an interval, which rise as t does, or up to t = 1/2.
  static double curve(double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); }
  static double rise(double t) { return 30.0 * t * t * (1.0 - t) * (1.0 - t); }

  static double twoLargest(const std::array<double, 3>& v) {
    return v[0] + v[1] + v[2] - std::min({v[0], v[1], v[2]});
  }

  // Of t in a cube, and along any of these ways.
  static double slopeIn(const glm::dvec3& lo, double side, const glm::dvec3& e) {
    double sum = 0.0;
    for (int node = 0; node < 8; ++node) {
      Interval w[3], dw[3], d[3];
      for (int k = 0; k < 3; ++k) {
        const double a = lo[k], b = std::min(lo[k] + side, 0.5);
        const Interval u(curve(a), curve(b)), du(rise(a), rise(b));
        const bool far = node >> k & 1;
        w[k] = far ? u : sub(Interval(1.0), u), dw[k] = far ? du : neg(du);
        d[k] = sub(Interval(a, b), Interval(far ? 1.0 : 0.0));
      }
      const auto product = [](const Interval& a, const Interval& b, const Interval& c) {
        return mul(mul(a, b), c);
      };
      const Interval all = product(w[0], w[1], w[2]);
      Interval along(0.0);
      for (int k = 0; k < 3; ++k)
        along = add(along, mul(Interval(e[k]), product(dw[k], w[(k + 1) % 3], w[(k + 2) % 3])));
      std::array<double, 3> most{};
      for (int k = 0; k < 3; ++k) {
        const Interval v = add(mul(Interval(e[k]), all), mul(along, d[k]));
        most[k] = std::max(std::abs(v.lo), std::abs(v.hi));
      }
      sum += twoLargest(most);
    }
    return sum;
  }
  static double valueIn(const glm::dvec3& lo, double side) {
    double sum = 0.0;
    for (int node = 0; node < 8; ++node) {
      double w = 1.0;
      std::array<double, 3> most{};
      for (int k = 0; k < 3; ++k) {
        const double a = lo[k], b = lo[k] + side;
        const bool far = node >> k & 1;
        w *= far ? curve(b) : 1.0 - curve(a), most[k] = far ? 1.0 - a : b;
      }
      sum += w * twoLargest(most);
    }
    return sum;
  }
};

// Cubes are divided until the bound holds in each; a cell's other parts are its mirror images. So are those
// whose coordinates come in another order, for the ways along all of them are the same but for signs.
TEST_F(SlopesOfGradientNoise, AreNoSteeperThanItSays) {
  // Ways on the faces of a cube: their hull holds the ball of this radius. What is largest along a way is
  // convex in it, so that along no way it is larger than along these, over that.
  constexpr int kSteps = 6;
  std::vector<glm::dvec3> ways;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
      for (const glm::dvec3& e :
           {glm::dvec3(1.0, a, b), glm::dvec3(a, 1.0, b), glm::dvec3(a, b, 1.0), glm::dvec3(-a, b, 1.0)})
        ways.push_back(glm::normalize(e));
    }
  // Three neighbours lie on a circle about their middle, half of the diagonal between steps wide at most.
  const double inner = std::cos(0.5 * std::sqrt(2.0) / kSteps);
  const double claimed = LatticeNoise::of(Kind::Gradient)->lipschitz() / kScale;
  struct Cube {
    glm::dvec3 lo;
    double side;
  };
  std::vector<Cube> left{{glm::dvec3(0.0), 0.5}};
  std::size_t looked = 0;
  while (!left.empty()) {
    const Cube cube = left.back();
    left.pop_back();
    if (cube.lo.x < cube.lo.y || cube.lo.y < cube.lo.z) continue;
    ASSERT_LT(++looked, 200'000u) << "cannot be proven";
    const bool holds = std::ranges::all_of(
        ways, [&](const glm::dvec3& e) { return slopeIn(cube.lo, cube.side, e) <= claimed * inner; });
    if (holds) continue;
    for (int i = 0; i < 8; ++i)
      left.push_back({cube.lo + 0.5 * cube.side * glm::dvec3(i & 1, i >> 1 & 1, i >> 2), 0.5 * cube.side});
  }
}

TEST_F(SlopesOfGradientNoise, AreNoLargerThanOne) {
  std::vector<std::pair<glm::dvec3, double>> left{{glm::dvec3(0.0), 0.5}};
  std::size_t looked = 0;
  while (!left.empty()) {
    const auto [lo, side] = left.back();
    left.pop_back();
    ASSERT_LT(++looked, 10'000'000u) << "cannot be proven";
    if (kScale * valueIn(lo, side) <= 1.0) continue;
    for (int i = 0; i < 8; ++i)
      left.emplace_back(lo + 0.5 * side * glm::dvec3(i & 1, i >> 1 & 1, i >> 2), 0.5 * side);
  }
}

}  // namespace lattice_noise_test
}  // namespace sdf::test
