// Steps by region: the ball that one may go is free of the surface, and steep distances are passed quickly.
#include "sdf/model/region_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/model/model.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace region_steps_test {

using Random = std::mt19937_64;

double between(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

glm::dvec3 pointIn(const Box& box, Random& random) {
  return {between(random, box.min.x, box.max.x), between(random, box.min.y, box.max.y),
          between(random, box.min.z, box.max.z)};
}

struct Steeply {
  std::string name;
  Shape shape;
};

std::vector<Steeply> steep() {
  const auto& [x, y, z] = position();
  const Expr a = x * x + 2.25 * z * z + y * y - 1.0, ball = x * x + y * y + z * z;
  const Expr heart = a * a * a - x * x * y * y * y - 0.1125 * z * z * y * y * y;
  const Expr waves = sin(4.0 * x) * cos(4.0 * y) + sin(4.0 * y) * cos(4.0 * z) + sin(4.0 * z) * cos(4.0 * x);
  const Shape whole = field(heart, Box::centred(glm::dvec3(1.6)));
  return {
      {"twisted", twist(whole, 0.7)},
      {"bent", bend(whole, 0.3)},
      {"cut", subtract(whole, cylinder(0.3, 3.0))},
      {"blended", unite(whole, translate(sphere(0.5), Vec3E(0.9, 0.9, 0.0)), {Blend::Kind::Quadratic, 0.1})},
      {"displaced", displace(whole, 0.03 * sin(20.0 * x))},
      {"in a grid", repeatGrid(scale(whole, Vec3E(0.4)), Vec3E(1.5, 0.0, 1.5), glm::ivec3(2, 1, 2))},
      {"in a grid without end", repeatGrid(whole, Vec3E(3.5, 0.0, 3.5))},
      {"in a grid that is turned",
       scale(rotate(repeatGrid(whole, Vec3E(3.0, 3.5, 0.0)), Vec3E(0.4, 0.3, 0.2)), Vec3E(0.7))},
      {"in a grid that is cut", intersect(repeatGrid(whole, Vec3E(3.5, 0.0, 3.5)), cylinder(3.0, 3.0))},
      {"about an axis", polarRepeat(translate(rotate(whole, Vec3E(0.4, 0.3, 0.2)), Vec3E(4.0, 0.0, 0.0)), 7)},
      {"about an axis, each its own mirror image", polarRepeat(translate(whole, Vec3E(4.0, 0.0, 0.0)), 7)},
      {"about an axis, stretched",
       scale(polarRepeat(translate(rotate(whole, Vec3E(0.4, 0.3, 0.2)), Vec3E(4.0, 0.0, 0.0)), 5),
             Vec3E(1.0, 1.5, 1.0))},
      {"heart", field(heart, {{-1.6, -1.6, -1.2}, {1.6, 1.6, 1.2}})},
      {"quartic", field(x * x * x * x + y * y * y * y + z * z * z * z - 1.0, Box::centred(glm::dvec3(1.2)))},
      {"product", field((ball - 0.5) * (ball + 1.0), Box::centred(glm::dvec3(1.0)))},
      {"waves", intersect(field(waves * exp(x), Box::centred(glm::dvec3(2.0))), sphere(1.9))},
      {"moved",
       translate(scale(field(heart, Box::centred(glm::dvec3(1.6))), Vec3E(0.01)), Vec3E(3.0, 0.0, 0.0))}};
}

TEST(StepsByRegion, AreFreeOfTheSurface) {
  for (const auto& [name, shape] : steep()) {
    const Marchable m = marchable(shape, Steps::ByRegion), slow = marchable(shape);
    const Box around = shape.bounds.finite() ? shape.bounds.grown(0.3 * shape.bounds.longestSide())
                                             : Box::centred(glm::dvec3(8.0, 2.0, 8.0));
    const TapePtr distance = Function(m.distance).at(), step = Function(m.step).at(),
                  bySlope = Function(slow.step).at();
    Random random(7);
    std::vector<double> gains;
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 p = pointIn(around, random);
      const double f = evaluate(*distance, p), g = evaluate(*step, p);
      ASSERT_EQ(f < 0.0, g < 0.0) << name;
      ASSERT_EQ(f > 0.0, g > 0.0) << name;
      if (f <= 0.0) continue;
      const double least = evaluate(*bySlope, p);
      ASSERT_GE(g, least) << name;
      if (shape.bounds.contains(Box{p, p})) gains.push_back(g / least);
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 way(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        const glm::dvec3 q = p + g * std::cbrt(between(random, 0.3, 1.0)) * glm::normalize(way);
        ASSERT_GE(evaluate(*distance, q), -1e-12)
            << name << ": from " << p.x << ", " << p.y << ", " << p.z << " by " << g;
      }
    }
    std::ranges::nth_element(gains, gains.begin() + gains.size() / 2);
    EXPECT_GE(gains[gains.size() / 2], 3.0) << name;
  }
}

TEST(StepsByRegion, AreTheSameForTheSameDistance) {
  const Shape shape = steep().front().shape;
  EXPECT_TRUE(marchable(shape, Steps::ByRegion).step == marchable(shape, Steps::ByRegion).step);
}

// They hold for all values of parameters only where these do not matter.
TEST(StepsByRegion, AreThoseByOneSlopeWhereThereAreInputs) {
  const auto& [x, y, z] = position();
  const Expr size = Expr::parameter({"size", 1.0, 0.5, 2.0});
  const Shape shape =
      field(x * x * x * x + y * y * y * y + z * z * z * z - size, Box::centred(glm::dvec3(1.5)));
  EXPECT_TRUE(marchable(shape, Steps::ByRegion).step == marchable(shape).step);
  EXPECT_TRUE(marchable(shape, Steps::ByRegionNow).step == marchable(shape).step);
  EXPECT_TRUE(waitsForInputs(shape, Steps::ByRegionNow));
}

// With one value each, they are those of this value, and of one form for all.
TEST(StepsByRegion, AreThoseOfKnownValues) {
  const auto& [x, y, z] = position();
  const auto of = [&, &x = x, &y = y, &z = z](const Expr& size) {
    const Expr quartic = x * x * x * x + y * y * y * y + z * z * z * z;
    return field(quartic - size, Box::centred(glm::dvec3(1.5)));
  };
  for (const double value : {0.5, 1.7}) {
    const Shape known = of(Expr::parameter({"size", value, value, value}));
    EXPECT_TRUE(waitsForInputs(known, Steps::ByRegion));
    EXPECT_FALSE(waitsForInputs(known, Steps::ByRegionOfSliders));
    EXPECT_TRUE(marchable(known, Steps::ByRegion).step == marchable(known).step);
    const Marchable now = marchable(known, Steps::ByRegionNow), same = marchable(of(value), Steps::ByRegion);
    EXPECT_DOUBLE_EQ(now.gain, same.gain);
    const TapePtr a = Function(now.step).at(), b = Function(same.step).at();
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 p = pointIn(Box::centred(glm::dvec3(2.0)), random);
      EXPECT_DOUBLE_EQ(evaluate(*a, p), evaluate(*b, p));
    }
  }
}

TEST(StepsByRegion, GoThroughWhereThereIsNoSurface) {
  const auto& [x, y, z] = position();
  const Box box = Box::centred(glm::dvec3(1.6));
  const Marchable m =
      marchable(field(exp(4.0 * x) + exp(-4.0 * x) + y * y + z * z - 1.9, box), Steps::ByRegion);
  EXPECT_GT(evaluate(*Function(m.step).at(), glm::dvec3(0.0)), 0.01) << "4e-5 by one slope";
}

// What inputs move is known where it was.
TEST(StepsByRegion, FollowWhatInputsMove) {
  const Shape whole = steep().front().shape;
  const Expr turn = Expr::parameter({"turn", 0.3, -2.0, 2.0});
  const Shape turned = translate(rotate(whole, Vec3E(0.0, turn, 0.0)), Vec3E(turn, 0.0, 0.0));
  for (const Shape& shape : {turned, repeatGrid(turned, Vec3E(8.0, 0.0, 8.0))}) {
    const Marchable m = marchable(shape, Steps::ByRegion);
    const Function distance(m.distance), step(m.step), bySlope(marchable(shape).step);
    for (const double value : {-1.7, 0.0, 0.9}) {
      const Values values{{"turn", value}};
      const TapePtr f = distance.at(values), g = step.at(values), least = bySlope.at(values);
      Random random(5);
      double gain = 0.0;
      for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 p = pointIn(Box::centred(glm::dvec3(5.0, 2.0, 5.0)), random);
        const double by = evaluate(*g, p);
        ASSERT_EQ(evaluate(*f, p) > 0.0, by > 0.0);
        if (by <= 0.0) continue;
        gain += by > 3.0 * evaluate(*least, p);
        const glm::dvec3 way(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        ASSERT_GE(evaluate(*f, p + by * glm::normalize(way)), -1e-12);
      }
      EXPECT_GT(gain, 100) << value;
    }
  }
}

TEST(StepsByRegion, AreThoseByOneSlopeWhereTheDistanceIsAsSteepEverywhere) {
  const auto& [x, y, z] = position();
  const Shape shape = field(5.0 * (length(position()) - 1.0), Box::centred(glm::dvec3(1.5)));
  EXPECT_TRUE(marchable(shape, Steps::ByRegion).step == marchable(shape).step);
}

// Each has a texture in a shader.
TEST(StepsByRegion, AreThoseOfThreeOperandsAtMost) {
  const auto& [x, y, z] = position();
  std::vector<Shape> operands;
  for (int i = 1; i <= 5; ++i)
    operands.push_back(translate(field((x * x * x * x + y * y * y * y + z * z * z * z - 1.0) * double(i),
                                       Box::centred(glm::dvec3(1.2))),
                                 Vec3E(4.0 * i, 0.0, 0.0)));
  const Marchable m = marchable(unite(operands), Steps::ByRegion);
  const auto nodes = topologicalOrder({&m.step, 1});
  EXPECT_EQ(std::ranges::count(nodes, Op::Payload, &Expr::op), 3);
}

}  // namespace region_steps_test
}  // namespace sdf
