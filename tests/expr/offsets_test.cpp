// What lies far from the origin is read near it.
#include "sdf/expr/offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "expr/evaluate.h"
#include "sdf/expr/vec.h"
#include "support/evaluate.h"
#include "support/operations.h"

namespace sdf {
namespace offsets_test {

// The largest magnitude of a constant of the graph, and of its values at p.
double largestOf(const Expr& e, const glm::dvec3& p) {
  const test::Evaluator evaluator(e);
  evaluator(p);
  double largest = 0.0;
  for (const double v : evaluator.values()) largest = std::max(largest, std::abs(v));
  return largest;
}

struct FarCase {
  const char* name;
  Expr (*of)(const Vec3E& p);  // of a position near the origin
  double largest;              // of its own numbers, for coordinates up to 2
};

Expr hashOf(const Expr& i, const Expr& k) {
  const Expr h = sin(12.9898 * i + 78.233 * k);
  return h - floor(h);
}

// Written so that each way that offsets pass is taken.
const FarCase kCases[] = {
    {"ball", [](const Vec3E& p) { return length(p) - 1.0; }, 12.0},
    {"turned box",
     [](const Vec3E& p) {
       const Vec3E q{0.6 * p.x + 0.8 * p.z, p.y, 0.6 * p.z - 0.8 * p.x};
       const Vec3E d = abs(q) - Vec3E(0.5, 0.25, 0.75);
       return length(max(d, 0.0)) + min(max(d.x, max(d.y, d.z)), 0.0);
     },
     12.0},
    {"nearest point of a box",
     [](const Vec3E& p) { return length(p - Vec3E(clamp(p.x, -1.0, 1.0), clamp(p.y, -0.5, 0.5), 0.0)); },
     12.0},
    {"select", [](const Vec3E& p) { return select(less(p.x, p.y), p.x - 0.25, p.y) * 2.0; }, 12.0},
    {"neighbours", [](const Vec3E& p) { return abs(p.x - 0.5 * round(p.x / 0.5)) + abs(p.y - floor(p.y)); },
     12.0},
    {"ceiling", [](const Vec3E& p) { return ceil(p.x * 2.0) * 0.5 - p.x; }, 12.0},
    {"waves", [](const Vec3E& p) { return sin(4.0 * p.x) * cos(3.0 * p.y + 0.5) + tan(0.25 * p.z); }, 15.0}};

TEST(Offsets, FarFormulasAreReadNearTheOrigin) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> near(-2.0, 2.0);
  for (const FarCase& c : kCases)
    for (const glm::dvec3& far :
         {glm::dvec3(6455808.0, 2408.0, 1920960.0), glm::dvec3(-3e5, 1e6 + 0.125, 0.0)}) {
      const Vec3E q = position() - Vec3E(far);
      const Expr there = remap(c.of(position()), {q.x, q.y, q.z}, 1.0),
                 here = relativeTo({&there, 1}, far)[0];
      for (int i = 0; i < 100; ++i) {
        const glm::dvec3 p(near(random), near(random), near(random));
        EXPECT_NEAR(test::Evaluator(here)(p), test::Evaluator(c.of(position()))(p), 1e-8) << c.name;
        EXPECT_LE(largestOf(here, p), c.largest) << c.name;
      }
    }
}

// A formula that depends on the place itself keeps its values: a hash of a cell's number, and its own phase.
TEST(Offsets, WhatThePlaceDecidesStays) {
  const Vec3E p = position();
  const Expr f = hashOf(floor(p.x / 2.0), floor(p.z / 2.0)) + mod(p.y, 0.75) + sin(3.0 * p.x) +
                 select(less(p.x, 6455809.0), 1.0, 2.0) + max(p.y, 2408.25) + pow(p.z, 0.5);
  const glm::dvec3 far(6455808.0, 2408.0, 1920960.0);
  const Expr here = relativeTo({&f, 1}, far)[0];
  std::mt19937 random(5);
  std::uniform_real_distribution<double> near(-2.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p0(near(random), near(random), near(random));
    EXPECT_NEAR(test::Evaluator(here)(p0), test::Evaluator(f)(far + p0), 1e-6);
  }
}

// A parameter's share of an offset stays one number for all points.
TEST(Offsets, ParametersAreGatheredToo) {
  const Expr d = Expr::parameter({"d", 6455808.0, 0.0, 1e7});
  const Expr f = length(position() - Vec3E(d, 0.0, 0.0)) - 1.0;
  const Expr here = relativeTo({&f, 1}, {6455808.0, 0.0, 0.0})[0];
  int parts = 0;
  for (const Expr& e : topologicalOrder({&here, 1}))
    for (int k = 0; k < arity(e.op()); ++k)
      parts += dependsOnSpace(e) && !dependsOnSpace(e.arg(k)) && !e.arg(k).isConstant();
  EXPECT_EQ(parts, 1);
  EXPECT_NEAR(test::Evaluator(here, {{"d", 6455809.0}})({2.0, 0.0, 0.0}), 0.0, 1e-9);
}

// Every operation, with and without an offset: no value changes, and claims stay.
TEST(Offsets, ValuesAndClaimsStay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> near(0.05, 0.95);
  const glm::dvec3 origin(0.25, -0.5, 0.125);
  for (const test::OperationCase& c : test::graphOperations()) {
    const Expr claimed = (0.25 * c.expr + position().x).claimLipschitz(0.875);
    const Expr here = relativeTo({&claimed, 1}, origin)[0];
    if (info(c.op).linearity != Linearity::Linear) {  // a sum's own bound is exact, and this one false
      EXPECT_LE(here.lipschitz(), claimed.lipschitz()) << info(c.op).name;
    }
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 p(near(random), near(random), near(random));
      const double value = test::Evaluator(claimed)(p);
      if (std::isfinite(value)) {
        EXPECT_NEAR(test::Evaluator(here)(p - origin), value, 1e-12 * (1.0 + std::abs(value)))
            << info(c.op).name;
      }
    }
  }
}

}  // namespace offsets_test
}  // namespace sdf
