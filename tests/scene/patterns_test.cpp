// How steep noise is.
#include "sdf/scene/patterns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "support/evaluate.h"

namespace sdf {
namespace patterns_test {

// The formula again, as its gradient for given phases: f of the bend, t of the turn, signs for the cosines of
// the three sines, in which the length is convex and so the largest at an end.
double slopeAt(double f, double t, double second, double third) {
  const glm::dvec3 u = 2.3 * glm::dvec3(0.36, 0.48, 0.8), v = 2.9 * glm::dvec3(-0.8, 0.6, 0.0),
                   w = 2.6 * glm::dvec3(-0.48, -0.64, 0.6);
  const glm::dvec3 bend = std::cos(f) * 0.73 * (u - v), turn = -std::sin(t) * 0.61 * (v + w);
  const glm::dvec3 first = u + 1.3 * turn;
  return glm::length(first + second * (v + 1.1 * bend) +
                     third * (w + 1.2 * (std::cos(t) * bend + std::sin(f) * turn))) /
         3.0;
}

TEST(Noise, IsNoSteeperThanItClaims) {
  constexpr int kSteps = 1000;
  constexpr double kStep = 2.0 * std::numbers::pi / kSteps;
  // Along f the gradient changes by at most (1.1 * 2.71 + 1.2 (2.71 + 2.39)) / 3 = 3.1, 2.71 and 2.39 being
  // the lengths of what is bent and turned; along t by (1.3 * 2.39 + 1.2 (2.71 + 2.39)) / 3 = 3.1.
  constexpr double kBetween = (3.1 + 3.1) * 0.5 * kStep;
  double most = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k)
      for (const double second : {-1.0, 1.0})
        for (const double third : {-1.0, 1.0})
          most = std::max(most, slopeAt(i * kStep, k * kStep, second, third));
  const double claimed = noise(position(), 1).lipschitz();
  EXPECT_LE(most + kBetween, claimed);
  EXPECT_GT(most * 1.01, claimed) << "or it could claim less";
}

TEST(Noise, ComesNearTheSlopeThatItClaims) {
  const test::Evaluator value(noise(position() * Expr(2.0), 1));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-50.0, 50.0);
  constexpr double kNudge = 1e-5;
  double most = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const glm::dvec3 p{any(random), any(random), any(random)};
    glm::dvec3 g;
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 q = p;
      q[k] += kNudge;
      g[k] = (value(q) - value(p)) / kNudge;
    }
    most = std::max(most, glm::length(g));
  }
  const double claimed = noise(position() * Expr(2.0), 1).lipschitz();
  EXPECT_NEAR(claimed, 2.0 * 3.82, 1e-9);
  EXPECT_LE(most, claimed * (1.0 + 1e-3));  // differences are off by a step times the second derivative
  EXPECT_GT(most, 0.9 * claimed);
}

// Octaves are weighed 4, 2 and 1, ridges point up where the noise is 0, and seeds differ.
TEST(LatticeNoisePattern, SumsOctaves) {
  using enum LatticeNoise::Kind;
  const auto at = [](LatticeNoise::Kind kind, const Octaves& octaves, const glm::dvec3& p) {
    return test::Evaluator(latticeNoise(kind, position(), octaves))(p);
  };
  const glm::dvec3 p(0.37, -1.21, 2.6);
  EXPECT_EQ(at(Value, {}, p), LatticeNoise::of(Value)->value(p));
  EXPECT_EQ(at(Value, {.seed = 4}, p), LatticeNoise::of(Value, 4)->value(p));
  EXPECT_EQ(at(Border, {.seed = 4}, p), LatticeNoise::of(Border, 4)->value(p));
  EXPECT_EQ(at(Gradient, {.ridged = true}, {1.0, 2.0, 3.0}), 1.0);
  const double second = at(Gradient, {.count = 2, .seed = 1}, p), first = at(Gradient, {.seed = 1}, p);
  EXPECT_NEAR(3.0 * second - 2.0 * first, LatticeNoise::of(Gradient, 2)->value(2.03 * p + 5.1), 1e-12);
}

// As steep as that of the lattice, times how often it is repeated in a unit.
TEST(LatticeNoisePattern, HasTheSlopeOfItsPlace) {
  using enum LatticeNoise::Kind;
  EXPECT_NEAR(latticeNoise(Value, position() * Expr(2.0)).lipschitz(), 7.5, 1e-9);
  EXPECT_NEAR(latticeNoise(Nearest, position() * Expr(3.0)).lipschitz(), 3.0, 1e-9);
  EXPECT_NEAR(latticeNoise(Gradient, position(), {.count = 2}).lipschitz(), 3.84 * (1.0 + 0.5 * 2.03) / 1.5,
              1e-6);
}

}  // namespace patterns_test
}  // namespace sdf
