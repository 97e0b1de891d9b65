// Every clause refutes the error that it is for.
#include <gtest/gtest.h>

#include "claims/readings.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {
namespace clauses_test {

constexpr double kRadius = 0.7351;

Shape claimed(Shape s, ClaimKind kind, double lipschitz, double growth = kInfinity) {
  s.claim = {kind, lipschitz, growth};
  return s;
}

Shape steepBall() {
  Shape s = sphere(kRadius);
  s.distance = s.distance * 1.01;
  return s;
}

Shape smallBounds() {
  Shape s = sphere(kRadius);
  s.bounds = Box::centred(glm::dvec3(0.9 * kRadius));
  return s;
}

Shape falseSlopes() {
  const Vec3E p = position();
  Shape s = sphere(kRadius);
  s.distance = min((p.x * 1.3751).claimLipschitz(0.01), (p.y * 1.4159).claimLipschitz(0.01));
  return claimed(std::move(s), ClaimKind::Field, kInfinity);
}

TEST(Clauses, RefuteTheErrorsThatTheyAreFor) {
  const Shape slow = ellipsoidBound({2.0, 0.1, 1.0});
  const Shape column = field(max(abs(position().x), abs(position().y)) - kRadius);
  const struct {
    const char* error;
    Verdict (*refute)(const Subject&);
    Shape shape;
  } planted[] = {
      {"NaN on one side", isFinite, field(sqrt(position().x))},
      {"bounds too small", isBounded, smallBounds()},
      {"growth too small", isBounded, claimed(slow, ClaimKind::Bound, 1.0, 1.0)},
      {"constant too small", keepsItsConstant, claimed(steepBall(), ClaimKind::Field, 1.0)},
      {"more than the distance", neverExceedsTheDistance, claimed(steepBall(), ClaimKind::Bound, kInfinity)},
      {"not exact", isExact, claimed(slow, ClaimKind::Exact, 1.0)},
      {"not exact at an edge", isExact, claimed(column, ClaimKind::ExactOutside, 1.0)},
      {"bounds too small where moved", movesRigidly, smallBounds()},
      {"slopes too small", specialises, falseSlopes()},
      {"a sum far above the coordinates", roundsAsADistance, field(position().x + 4096.0 - 4096.7351)},
  };
  constexpr unsigned kSeeds = 8;  // what a single subject's few dozen points may miss
  for (const auto& p : planted) {
    bool refuted = false;
    for (unsigned seed = 1; seed <= kSeeds && !refuted; ++seed)
      refuted = p.refute(Subject(p.shape, seed)).has_value();
    EXPECT_TRUE(refuted) << p.error;
  }
}

TEST(Clauses, LetTheTruthStand) {
  const Subject subject(intersect(box({1.0, 0.5, 0.25}), sphere(kRadius), Blend::quadratic(0.1)), 1);
  for (const Clause& c : kClaimClauses)
    EXPECT_FALSE(c.refute(subject)) << c.name << ": " << *c.refute(subject);
  for (const Clause& c : kReadingClauses)
    EXPECT_FALSE(c.refute(subject)) << c.name << ": " << *c.refute(subject);
}

TEST(WidthByChainRule, IsTheSlopeTimesTheSizeOfTheBox) {
  const auto [x, y, z] = position();
  const Tape product(x * y);
  constexpr double kTerms = 20.0;  // 6 from the product and 6 from each factor, and their halves of boxes
  for (const double size : {1e-1, 1e-4, 1e-7}) {
    // Half a box either way about (2, 3): the slopes are at most 3 + size / 2 and 2 + size / 2.
    const double width = widthByChainRule(product, around({2.0, 3.0, 0.0}, size / 2.0));
    EXPECT_GE(width, 5.0 * size);
    EXPECT_LE(width, (5.0 + size) * size + kTerms * 64.0 * kEpsilon);
  }
  EXPECT_EQ(widthByChainRule(Tape(floor(x)), around(glm::dvec3(0.0), 0.1)), kInfinity)
      << "a jump has no slope";
}

TEST(WidthByChainRule, IsFiniteForMostSmallBoxesOfPrimitives) {
  for (const ShapeCase& c : primitiveCases()) {
    const Subject s(c.shape, 1);
    int finite = 0;
    for (const glm::dvec3& p : s.points())
      finite += widthByChainRule(s.tape(), around(p, 1e-6 * s.longest())) < kInfinity;
    EXPECT_GE(finite, static_cast<int>(s.points().size()) / 2) << c.name;
  }
}

TEST(FloatRange, IsAFewRoundingsWide) {
  const Tape tape(sphere(kRadius).distance);
  const glm::vec3 p(1.5f, -0.75f, 0.25f);
  const Interval range = floatRange(tape, p);
  const double value = evaluate(tape, glm::dvec3(p));
  EXPECT_TRUE(range.contains(value));
  EXPECT_TRUE(range.contains(static_cast<float>(value)));
  // Squares, sums and the root are of the size of the squared length, 2.9, and there are seven.
  constexpr double kMostUlps = promise(Op::Sqrt).ulps;
  EXPECT_LE(range.width(), 7.0 * 2.0 * kMostUlps * floatUlp(2.9));
  const std::array<Interval, 3> slopes = floatGradientRange(tape, p);
  const glm::dvec3 slope = evaluateGradient(tape, glm::dvec3(p)).gradient;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_TRUE(slopes[axis].contains(slope[axis]));
    // Some twenty roundings of the value and of the derivative, which are below 2.
    EXPECT_LE(slopes[axis].width(), 40.0 * 2.0 * kMostUlps * floatUlp(2.0));
  }
}

TEST(FloatRange, HoldsBothSidesOfAKink) {
  const Tape tape(abs(position().x));
  const std::array<Interval, 3> slopes = floatGradientRange(tape, {0.0f, 0.0f, 0.0f});
  EXPECT_TRUE(slopes[0].contains(1.0));
  EXPECT_FALSE(slopes[1].contains(1.0));
}

}  // namespace clauses_test
}  // namespace sdf::test
