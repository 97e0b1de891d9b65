// What floats make of a formula is known beforehand, and where they do not do it is read in double.
#include "sdf/eval/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"
#include "support/operations.h"

namespace sdf {
namespace rounding_test {

constexpr int kPoints = 300;

TapePtr tapeOf(const Expr& e) { return std::make_shared<const Tape>(e); }

Expr fract(const Expr& e) { return e - floor(e); }

// Towers on a grid, each as high as a hash of its cell says, by a sine that is multiplied.
Expr towers(double along, double across, double factor) {
  const auto [x, y, z] = position();
  const Expr i = floor(x * 0.5 + 0.5), k = floor(z * 0.5 + 0.5);
  const Expr height = 1.0 + 3.0 * fract(sin(i * along + k * across) * factor);
  return max(max(abs(x - 2.0 * i), abs(z - 2.0 * k)) - 0.6, abs(y) - height);
}

struct Points {
  std::vector<glm::dvec3> at;
  std::vector<float> x, y, z;

  Points(unsigned seed, double reach) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(static_cast<float>(-reach), static_cast<float>(reach));
    for (int i = 0; i < kPoints; ++i) {
      x.push_back(coordinate(random)), y.push_back(coordinate(random)), z.push_back(coordinate(random));
      at.emplace_back(x.back(), y.back(), z.back());
    }
  }
  Rows rows() const { return {x.data(), y.data(), z.data()}; }
};

std::vector<float> readInBatch(const Tape& tape, const Points& p) {
  std::vector<float> values(kPoints);
  BatchEvaluator().evaluate(tape, p.rows(), kPoints, values.data());
  return values;
}

double mostOff(const Tape& tape, const Points& p) {
  const std::vector<float> values = readInBatch(tape, p);
  double most = 0.0;
  for (int i = 0; i < kPoints; ++i) most = std::max(most, std::abs(values[i] - evaluate(tape, p.at[i])));
  return most;
}

// Hashes as they are written everywhere: floats give other heights, and the tape is read in double then.
TEST(Rounding, HashesAreReadInDouble) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> factor(5e3, 2e5), along(5.0, 100.0);
  int off = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const TapePtr plain = tapeOf(towers(along(random), along(random), factor(random)));
    const TapePtr tape = withAccuracy(plain, {Box::centred(glm::dvec3(9.0)), 1e-3});
    const Points points(static_cast<unsigned>(trial), 9.0);
    off += mostOff(*plain, points) > 1e-3;
    EXPECT_TRUE(tape->isExact()) << trial;
    EXPECT_LE(mostOff(*tape, points), 1e-6) << trial;
  }
  EXPECT_EQ(off, 40) << "floats do";
}

// And formulas whose floats do are not.
TEST(Rounding, OrdinaryFormulasAreReadInFloat) {
  const Vec3E p = position();
  const auto wave = [](const Expr& e) { return sin(3.0 * e); };
  const Expr q = p.x - 0.7 * round(p.x / 0.7), angle = atan2(p.z, p.x);
  for (const Expr& e :
       {length(p) - 1.0, length(abs(p) - Vec3E(0.3, 0.2, 0.7)) - 0.1, length(q, p.y) - 0.2,
        wave(p.x) * wave(p.y) + wave(p.z), max(mod(p.x, 0.3), pow(abs(p.y), 3.0) - 0.2),
        length(p.x - 0.1 * cos(7.0 * angle), p.y - 0.3) - 0.05, sqrt(p.x * p.x + p.y * p.y) - 0.3,
        exp(p.x) - log(1.5 + p.z * 0.1), select(less(p.x, 0.1), p.y, p.z)}) {
    const TapePtr tape = tapeOf(e);
    EXPECT_EQ(withAccuracy(tape, {Box::centred(glm::dvec3(4.0)), 1e-4}), tape);
  }
  // At any place and size; where bounds end in the middle of what is in them, too.
  for (const double size : {0x1p-20, 1e-6, 1.0, 1e6})
    for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(0.41, 0.3, 0.2), glm::dvec3(-7.3, 0.1, 900.0)}) {
      const Vec3E q = p - Vec3E(size * at);
      const Expr ball = sqrt(q.x * q.x + q.y * q.y + q.z * q.z) - 0.08 * size;
      const Box bounds{size * (at - 0.08), size * (at + 0.08)};
      EXPECT_TRUE(exactNodes({&ball, 1}, {bounds, 0x1p-10 * size}).empty()) << size << " at " << at.x;
    }
}

// A specialised tape is read in floats again once nothing is left of what they do not do for.
TEST(Rounding, OnlyTheTapesThatKeepItAreReadInDouble) {
  const Expr ball = length(position() - Vec3E(30.0, 0.0, 0.0)) - 1.0;
  const TapePtr tape = withAccuracy(tapeOf(min(towers(12.9898, 78.233, 43758.5453), ball)),
                                    {Box::centred(glm::dvec3(9.0)), 1e-3});
  ASSERT_TRUE(tape->isExact());
  std::vector<Decision> decisions(tape->decisionCount(), Decision::Open);
  decisions.back() = Decision::Second;
  const TapePtr special = tape->specialised(decisions.data(), 1);
  ASSERT_TRUE(special);
  EXPECT_FALSE(special->isExact());
}

// What is said of a reading holds for it: every operation, at points of any size.
TEST(Rounding, BoundsHoldForEveryOperation) {
  for (const test::OperationCase& c : test::graphOperations()) {
    // Arguments that are rounded themselves, and a use of the result.
    const Vec3E p = position();
    const Expr e = remap(c.expr, {p.x * 1.1, p.y * 0.7 + 0.1, p.z / 3.0}, kInfinity) * 1.3 + 0.1;
    const TapePtr tape = tapeOf(e);
    for (const double reach : {0.9, 30.0}) {
      const Points points(7, reach);
      const std::vector<float> values = readInBatch(*tape, points);
      RoundingBounds bounds;
      for (int i = 0; i < kPoints; ++i) {
        const glm::dvec3& at = points.at[i];
        bounds.run(*tape, {at.x, at.y, at.z});
        const Operand o = tape->outputs()[0];
        const double value = evaluate(*tape, at);
        EXPECT_TRUE(bounds.value(o) == value || std::isnan(value));
        if (!std::isfinite(value)) continue;
        // To first order: a thousandth for what is beyond.
        EXPECT_LE(std::abs(values[i] - value), 1.001 * bounds.error(o) + 1e-30)
            << info(c.op).name << " at (" << at.x << ", " << at.y << ", " << at.z << ")";
        double sum = 0.0;
        for (const double share : bounds.shares(o)) sum += share;
        EXPECT_NEAR(sum, bounds.error(o), 1e-9 * bounds.error(o)) << info(c.op).name;
      }
    }
  }
}

// All batch readings of a tape that is read in double are those of the oracle.
TEST(Rounding, ReadingsInDoubleAreTheOracles) {
  for (const test::OperationCase& c : test::graphOperations()) {
    const TapePtr plain = tapeOf(min(c.expr, 0.3 * position().x) + 0.2);
    const TapePtr tape = plain->readExactly(std::vector<bool>(plain->instructions().size(), true));
    const Points p(11, 3.0);
    std::vector<float> value(kPoints), dx(kPoints), dy(kPoints), dz(kPoints), balls(kPoints),
        exactly(kPoints);
    BatchEvaluator batch;
    batch.evaluateGradient(*tape, p.rows(), kPoints, value.data(), dx.data(), dy.data(), dz.data());
    std::vector<Decision> decisions;
    batch.evaluateBalls(*tape, p.rows(), kPoints, 0.01f, 0.0f, balls.data(), decisions);
    batch.evaluateExactly(*plain, p.at, exactly.data());
    const std::vector<float> alone = readInBatch(*tape, p);
    ASSERT_EQ(decisions.size(), tape->decisionCount() * kPoints);
    const auto same = [](float a, double b) {
      return std::isnan(b) ? std::isnan(a) : a == static_cast<float>(b);
    };
    for (int i = 0; i < kPoints; ++i) {
      const auto [f, slope] = evaluateGradient(*tape, p.at[i]);
      for (const float read : {value[i], balls[i], exactly[i], alone[i]})
        EXPECT_PRED2(same, read, f) << info(c.op).name;
      EXPECT_PRED2(same, dx[i], slope.x) << info(c.op).name;
      EXPECT_PRED2(same, dy[i], slope.y) << info(c.op).name;
      EXPECT_PRED2(same, dz[i], slope.z) << info(c.op).name;
    }
  }
}

// A ball decides by slopes in double as it does in floats, save where the margin is met within rounding.
TEST(Rounding, BallsDecideAlike) {
  const Vec3E p = position();
  const Expr a = length(p) - 1.0, b = length(p - Vec3E(0.5, 0.2, 0.0)) - 0.7;
  const TapePtr plain = tapeOf(max(min(a, b), select(less(a, b), p.x, p.y) - 2.0));
  const TapePtr tape = plain->readExactly({true});
  const Points points(13, 2.0);
  std::vector<float> value(kPoints);
  std::vector<Decision> floats, doubles;
  BatchEvaluator batch;
  batch.evaluateBalls(*plain, points.rows(), kPoints, 0.1f, 0.0f, value.data(), floats);
  batch.evaluateBalls(*tape, points.rows(), kPoints, 0.1f, 0.0f, value.data(), doubles);
  ASSERT_EQ(floats.size(), doubles.size());
  int apart = 0, decided = 0;
  for (std::size_t i = 0; i < floats.size(); ++i)
    apart += floats[i] != doubles[i], decided += doubles[i] != Decision::Open;
  EXPECT_LE(apart, 2);
  EXPECT_GE(decided, kPoints);
}

}  // namespace rounding_test
}  // namespace sdf
