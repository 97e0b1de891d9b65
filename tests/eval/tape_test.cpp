#include "sdf/eval/tape.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <numbers>
#include <random>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace tape_test {

Expr sphere(const glm::dvec3& centre, double radius) {
  return length(position() - Vec3E(centre)).claimLipschitz(1.0) - radius;
}

// A few hundred spheres, boxes and cuts from a seed, with min, max, select and comparisons.
Expr randomScene(std::mt19937& random, int shapes) {
  std::uniform_real_distribution<double> place(-1.5, 1.5), size(0.05, 0.4);
  Expr scene = sphere({place(random), place(random), place(random)}, size(random));
  for (int i = 1; i < shapes; ++i) {
    const Expr next = sphere({place(random), place(random), place(random)}, size(random));
    switch (random() % 4) {
      case 0:
        scene = max(scene, -next);
        break;
      case 1:
        scene = select(less(position().x, place(random)), min(scene, next), scene);
        break;
      default:
        scene = min(scene, next);
    }
  }
  return scene;
}

std::size_t count(const Tape& tape, Op op) {
  std::size_t n = 0;
  for (const Instruction& i : tape.instructions()) n += i.op == op;
  return n;
}

TEST(Tape, FusesATranslatedSphereIntoOneInstruction) {
  const Tape tape(sphere({1, 2, 3}, 0.5));
  ASSERT_EQ(tape.instructions().size(), 1u);
  EXPECT_EQ(tape.instructions()[0].op, Op::Distance3);
  EXPECT_EQ(evaluate(tape, {1, 2, 5}), 1.5);
}

TEST(Tape, SharesCommonPartsAndFoldsParameters) {
  const Expr k = Expr::parameter({"k", 3.0, 0.0, 5.0});
  const Expr x = position().x;
  const Expr shared = sin(x * (k * k));
  const Tape tape(shared + shared * x);
  EXPECT_EQ(count(tape, Op::Sin), 1u);
  EXPECT_NEAR(evaluate(tape, {0.25, 0, 0}), 1.25 * std::sin(0.25 * 9.0), 4 * DBL_EPSILON);
}

TEST(Tape, RegistersAreReused) {
  Expr scene = sphere({0, 0, 0}, 1);
  for (int i = 1; i < 200; ++i) scene = min(scene, sphere({0.1 * i, 0, 0}, 1));
  EXPECT_LE(Tape(scene).registerCount(), kVariableCount + 3u);
}

TEST(Tape, EveryOutputIsServedConstantsAndVariablesToo) {
  const Vec3E p = position();
  const std::vector<Expr> outputs{p.x + p.y, Expr(2.5), p.z, p.x + p.y};
  const Tape tape(outputs);
  const float x[] = {1, 2, 3}, y[] = {4, 5, 6}, z[] = {7, 8, 9};
  float out[4][3];
  float* const rows[] = {out[0], out[1], out[2], out[3]};
  BatchEvaluator().evaluate(tape, {.x = x, .y = y, .z = z}, 3, rows);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(out[0][i], x[i] + y[i]);
    EXPECT_EQ(out[1][i], 2.5f);
    EXPECT_EQ(out[2][i], z[i]);
    EXPECT_EQ(out[3][i], x[i] + y[i]);
  }
  EXPECT_EQ(evaluateAll(tape, {1, 4, 7}), (std::vector<double>{5, 2.5, 7, 5}));
}

TEST(Tape, SelectFollowsAParameterThatDecidesIt) {
  const Expr flag = Expr::parameter({"flag", 1.0, 0.0, 1.0});
  const Tape tape(select(less(Expr(0.5), flag), position().x, position().y));
  const float x[] = {1}, y[] = {2};
  float out[1];
  BatchEvaluator().evaluate(tape, {.x = x, .y = y}, 1, out);
  EXPECT_EQ(out[0], 1.0f);
}

// One pass over the cube of this half side, by its ball or by its intervals.
TapePtr specialiseOnce(const Tape& tape, const glm::dvec3& centre, double half, bool byBall) {
  std::vector<Decision> decisions;
  if (byBall) {
    const float x = static_cast<float>(centre.x), y = static_cast<float>(centre.y),
                z = static_cast<float>(centre.z);
    const float radius = static_cast<float>(half * std::sqrt(3.0)), slack = 32 * FLT_EPSILON;
    float value;
    BatchEvaluator().evaluateBalls(tape, {.x = &x, .y = &y, .z = &z}, 1, radius, slack, &value, decisions);
  } else {
    ScalarReading<Interval> workspace;
    evaluate(tape, Box{centre - half, centre + half}, workspace, decisions);
  }
  return tape.specialised(decisions.data(), 1);
}

// Specialised by balls and by intervals, once and again inside: the values inside the region stay the same.
TEST(Specialisation, LeavesValuesInTheRegionUnchanged) {
  std::size_t full = 0, left = 0;  // instructions
  for (int seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    auto tape = std::make_shared<const Tape>(randomScene(random, 60));
    std::uniform_real_distribution<double> place(-2.0, 2.0), unit(-1.0, 1.0);
    glm::dvec3 centre{place(random), place(random), place(random)};
    TapePtr special = tape;
    for (double half = 0.5; half > 0.03; half /= 2.0) {
      // Dropping a branch that jumps lets slopes decide what depends on it, so a second pass may drop more.
      while (const TapePtr next = specialiseOnce(*special, centre, half, seed % 2)) special = next;
      for (int sample = 0; sample < 20; ++sample) {
        const glm::dvec3 p = centre + half * glm::dvec3{unit(random), unit(random), unit(random)};
        ASSERT_EQ(evaluate(*special, p), evaluate(*tape, p)) << "seed " << seed << ", half side " << half;
      }
      centre += half / 2.0 * glm::dvec3{unit(random), unit(random), unit(random)};
    }
    full += tape->instructions().size();
    left += special->instructions().size();
  }
  EXPECT_LT(left, full / 3);
}

TEST(Specialisation, DropsAFarUnionMemberAndAllItNeeds) {
  const Tape tape(min(sphere({0, 0, 0}, 1), sin(position().y) + sphere({100, 0, 0}, 1)));
  const float zero[] = {0.0f};
  float value;
  std::vector<Decision> decisions;
  BatchEvaluator().evaluateBalls(tape, {.x = zero, .y = zero, .z = zero}, 1, 0.5f, 0.0f, &value, decisions);
  EXPECT_EQ(value, -1.0f);
  const TapePtr special = tape.specialised(decisions.data(), 1);
  ASSERT_TRUE(special);
  EXPECT_EQ(special->instructions().size(), 1u);
}

TEST(Specialisation, DropsABlendWithFarOperands) {
  const Expr k = 0.25, near = sphere({0, 0, 0}, 1), far = sphere({100, 0, 0}, 1);
  const auto apart = [&](const Expr& a, const Expr& b) { return max(k - abs(b - a), 0.0); };
  const auto quadratic = [&](const Expr& a, const Expr& b) {
    return min(a, b) + square(apart(a, b)) * (-0.25 / k);
  };
  const auto cubic = [&](const Expr& a, const Expr& b) {
    return square(apart(a, b)) * apart(a, b) * (-1.0 / (6.0 * square(k))) + min(a, b);
  };
  for (const Expr& blend : {quadratic(near, far), quadratic(far, near), cubic(near, far), cubic(far, near)}) {
    const Tape tape(blend);
    for (const bool byBall : {false, true}) {
      const TapePtr special = specialiseOnce(tape, {0.9, 0.2, 0.1}, 0.1, byBall);
      ASSERT_TRUE(special);
      EXPECT_EQ(special->instructions().size(), 1u);
      EXPECT_EQ(evaluate(*special, {0.9, 0.2, 0.1}), evaluate(tape, {0.9, 0.2, 0.1}));
    }
  }
}

// 0 times infinity or NaN is NaN.
TEST(Specialisation, KeepsWhatAFactorDecidedToBeZeroStandsBeside) {
  const Vec3E p = position();
  for (const Expr& beside : {1.0 / p.x, Expr(kInfinity), Expr(std::nan(""))}) {
    const Tape tape(max(p.y, 0.0) * beside + p.z);
    const TapePtr special = specialiseOnce(tape, {1.0, -1.0, 0.0}, 0.5, false);
    ASSERT_TRUE(special);
    EXPECT_TRUE(std::isnan(evaluate(*special, {0.0, -1.0, 0.0})));
  }
}

TEST(Specialisation, KeepsAFactorThatIsWrittenAsZero) {
  const Vec3E p = position();
  const Tape tape(min((1.0 / p.x) * 0.0, 1.0) + max(p.y, 0.0));
  const TapePtr special = specialiseOnce(tape, {1.0, -1.0, 0.0}, 0.5, false);
  ASSERT_TRUE(special);
  EXPECT_TRUE(std::isnan(evaluate(*special, {0.0, -1.0, 0.0})));
}

TEST(Specialisation, IsEqualWhereTheSameIsDropped) {
  const auto balls = [] { return min(sphere({0, 0, 0}, 1), sphere({3, 0, 0}, 1)); };
  const Tape both(balls()), anew(balls());
  const TapePtr first = specialiseOnce(both, {-1.0, 0.0, 0.0}, 0.5, false),
                again = specialiseOnce(both, {0.0, 1.0, 0.0}, 0.25, false),
                second = specialiseOnce(both, {4.0, 0.0, 0.0}, 0.5, false);
  ASSERT_TRUE(first && again && second);
  EXPECT_NE(first, again);
  EXPECT_EQ(*first, *again);
  EXPECT_EQ(first->hash(), again->hash());
  EXPECT_FALSE(*first == *second);
  EXPECT_FALSE(*first == both);
  EXPECT_FALSE(both == anew);  // constants are compared by their place
}

TEST(Specialisation, SaysWhenNothingCanBeDropped) {
  const Tape tape(min(sphere({0, 0, 0}, 1), sphere({0.5, 0, 0}, 1)));
  const Decision open = Decision::Open;
  EXPECT_EQ(tape.specialised(&open, 1), nullptr);
}

TEST(Specialisation, KeepsOnlyTheNearFaceOfABox) {
  const Vec3E q = abs(position()) - Vec3E(Expr(1.0));
  const Expr box = length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
  const Tape tape(box);
  ScalarReading<Interval> workspace;
  std::vector<Decision> decisions;
  evaluate(tape, Box{{2.0, -0.1, -0.1}, {2.2, 0.1, 0.1}}, workspace, decisions);
  const TapePtr special = tape.specialised(decisions.data(), 1);
  ASSERT_TRUE(special);
  EXPECT_LE(special->instructions().size(), 2u);  // |x| - 1, and its absolute value
  EXPECT_EQ(evaluate(*special, {2.1, 0.0, 0.05}), evaluate(tape, {2.1, 0.0, 0.05}));
}

TEST(Specialisation, BatchEqualsTheFullTapeWhereConstantsAppear) {
  // max(x, 0) becomes a constant in x < 0, in places where instructions usually have values.
  const Vec3E p = position();
  const Expr e =
      sqrt(max(p.x, 0.0)) + max(p.x, 0.0) * max(p.y, 0.0) + atan2(max(p.x, 0.0), max(p.y, 0.0)) + p.z;
  const Tape tape(e);
  ScalarReading<Interval> workspace;
  std::vector<Decision> decisions;
  evaluate(tape, Box{{-2.0, -2.0, 0.0}, {-1.0, -1.0, 1.0}}, workspace, decisions);
  const TapePtr special = tape.specialised(decisions.data(), 1);
  ASSERT_TRUE(special);
  const float x[] = {-1.5f, -1.25f}, y[] = {-1.5f, -1.75f}, z[] = {0.5f, 0.75f};
  float a[2], b[2], v[2], dx[2], dy[2], dz[2];
  BatchEvaluator batch;
  batch.evaluate(tape, {.x = x, .y = y, .z = z}, 2, a);
  batch.evaluate(*special, {.x = x, .y = y, .z = z}, 2, b);
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[1], b[1]);
  batch.evaluateGradient(*special, {.x = x, .y = y, .z = z}, 2, v, dx, dy, dz);
  EXPECT_EQ(dz[0], 1.0f);
}

TEST(LipschitzOver, IsTightOnSmallBoxesAndUnboundedAcrossJumps) {
  const Vec3E p = position();
  const Tape wave(sin(p.x * 5.0) * cos(p.y * 5.0));
  const Box small{{0.0, 0.0, 0.0}, {0.01, 0.01, 0.01}};
  const double slope = lipschitzOver(wave, small);
  EXPECT_GE(slope, 5.0 * std::cos(0.05) * std::cos(0.05));
  EXPECT_LE(slope, 5.0 * 1.01);
  const Tape steps(floor(p.x));
  EXPECT_EQ(lipschitzOver(steps, Box{{0.1, 0, 0}, {0.9, 1, 1}}), std::nextafter(0.0, 1.0));
  EXPECT_EQ(lipschitzOver(steps, Box{{0.5, 0, 0}, {1.5, 1, 1}}), HUGE_VAL);
}

TEST(LipschitzOver, OfALengthIsThatOfItsPartsWhereItIsZeroToo) {
  const auto& [x, y, z] = position();
  const Box around{glm::dvec3(-0.1), glm::dvec3(0.1)};
  EXPECT_LE(lipschitzOver(Tape(length(2.0 * x, 2.0 * y)), around), 2.0 * std::numbers::sqrt2 * 1.0001);
  EXPECT_LE(lipschitzOver(Tape(length(max(3.0 * x, 0.0), max(y - 1.0, 0.0))), around), 3.0001);
  EXPECT_LE(lipschitzOver(Tape(length(x - 0.05, y, z)), around), std::numbers::sqrt3 * 1.0001);
  EXPECT_EQ(lipschitzOver(Tape(length(floor(x), y)), around), HUGE_VAL);
}

// A zigzag is put together of parts that jump.
TEST(LipschitzOver, OfAContinuousFunctionIsThatOfItsPieces) {
  const Expr x = position().x;
  const Tape zigzag(abs(x - round(x))), choice(select(less(x, 0.0), -x, 2.0 * x));
  const Box across{{-0.6, 0, 0}, {0.6, 1, 1}};
  EXPECT_EQ(lipschitzOver(zigzag, across), HUGE_VAL);
  EXPECT_LE(lipschitzOfContinuous(zigzag, across), 1.0001);
  EXPECT_EQ(lipschitzOver(choice, across), HUGE_VAL);
  EXPECT_GE(lipschitzOfContinuous(choice, across), 2.0);
  EXPECT_LE(lipschitzOfContinuous(choice, across), 2.0001);
}

// Found by fuzzing: a power of a negative base has values at whole exponents alone, and those may be steps.
TEST(LipschitzOver, IsUnboundedWhereTheExponentOfANegativeBaseSteps) {
  const Expr x = position().x;
  const Tape powers(pow(Expr(-0.75), floor(x)));
  EXPECT_EQ(lipschitzOver(powers, Box{{0.5, 0, 0}, {1.5, 1, 1}}), HUGE_VAL);
  EXPECT_EQ(lipschitzOver(powers, Box{{1.25, 0, 0}, {1.5, 1, 1}}), std::nextafter(0.0, 1.0));
  const Tape steady(pow(x, 3.0));
  EXPECT_LE(lipschitzOver(steady, Box{{-1.0, 0, 0}, {-0.5, 1, 1}}), 3.0 * 1.01);
}

TEST(Batch, AnyCountOfPointsIsCutIntoPasses) {
  const Tape tape(sphere({0.25, 0.5, 0.75}, 1.0));
  for (const std::size_t n : {0u, 1u, 31u, 32u, 33u, 511u, 512u, 513u, 2000u}) {
    std::vector<float> x(n), y(n), z(n), out(n + 1, -7.0f);
    for (std::size_t i = 0; i < n; ++i) x[i] = 0.001f * i, y[i] = 0.5f, z[i] = -0.002f * i;
    BatchEvaluator().evaluate(tape, {.x = x.data(), .y = y.data(), .z = z.data()}, n, out.data());
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_NEAR(out[i], evaluate(tape, {x[i], y[i], z[i]}), 4 * FLT_EPSILON * 4.0);
    EXPECT_EQ(out[n], -7.0f) << "wrote past the end";
  }
}

}  // namespace tape_test
}  // namespace sdf
