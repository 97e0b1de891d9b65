// Functions are compiled once and read at any values of their inputs.
#include "sdf/eval/function.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"
#include "support/bind.h"

namespace sdf {
namespace function_test {

const Expr kX = position().x, kY = position().y, kZ = position().z;

Expr input(const char* name, double value = 0.5) { return Expr::parameter({name, value, 0.0, 1.0}); }

TEST(Function, NamesItsInputsOnce) {
  const Function f({kX * input("a") + input("b", 0.25), input("a")});
  ASSERT_EQ(f.inputs().size(), 2u);
  EXPECT_NE(f.inputs()[0].name, f.inputs()[1].name);
  EXPECT_TRUE(Function(kX).inputs().empty());
}

TEST(Function, SaysWhatTheBoundExpressionSays) {
  const Expr a = input("a"), b = input("b");
  const Expr all[] = {sin(kX * a) + b * b,
                      length(kX - a, kY + b, kZ - a * b) - b,
                      abs(kX) - a,
                      select(less(a, b), kX, kY),
                      length(kX, kY) + exp(a),
                      pow(abs(kX), a) * (a + 2.0 * b)};
  for (const Expr& e : all) {
    const Function f(e);
    for (const double first : {0.0, 0.25, 1.0})
      for (const double second : {0.0, 0.5, 1.0}) {
        const Values values{{"a", first}, {"b", second}};
        const Tape bound(test::bind(e, values));
        for (const glm::dvec3& p : {glm::dvec3(0.3, -0.7, 1.1), glm::dvec3(-2.0, 0.5, 0.0)})
          EXPECT_NEAR(evaluate(*f.at(values), p), evaluate(bound, p),
                      1e-15 * (1.0 + std::abs(evaluate(bound, p))));
      }
  }
}

TEST(Function, CompilesNothingForNewValues) {
  const Function f(length(kX - input("a"), kY, kZ) - input("b"));
  const TapePtr first = f.at({{"a", 0.1}}), second = f.at({{"a", 0.9}, {"b", 0.2}});
  EXPECT_EQ(first->instructions().data(), second->instructions().data());
  EXPECT_EQ(first->program().data(), second->program().data());
  EXPECT_NE(evaluate(*first, {1.0, 2.0, 3.0}), evaluate(*second, {1.0, 2.0, 3.0}));
}

TEST(Function, FusesShiftsByInputsAsByNumbers) {
  const TapePtr tape = Function(length(kX - input("a"), kY + input("b"), kZ - 1.0) - input("a")).at();
  ASSERT_EQ(tape->instructions().size(), 1u);
  EXPECT_EQ(tape->instructions()[0].op, Op::Distance3);
}

TEST(Function, TheBatchReadingTakesTheValues) {
  const Function f(kX * input("a") + input("b"));
  BatchEvaluator batch;
  const float x[] = {1.0f, 2.0f, -3.0f};
  float out[3];
  batch.evaluate(*f.at({{"a", 0.5}, {"b", 0.25}}), {.x = x}, 3, out);
  EXPECT_EQ(out[0], 0.75f);
  EXPECT_EQ(out[2], -1.25f);
}

TEST(Function, SlopesHoldForValuesInTheirRangesOnly) {
  const Function f(min(kX * input("a"), kY));
  EXPECT_EQ(f.at({{"a", 1.0}})->lipschitz(), 1.0f);
  EXPECT_EQ(f.at({{"a", 1.5}})->lipschitz(), HUGE_VALF);
  EXPECT_FALSE(f.at({{"a", 1.5}})->hasSlopes());
  EXPECT_EQ(f.at({{"another", 1.5}})->lipschitz(), 1.0f);
}

TEST(Function, UniformOutputsAreNumbers) {
  const Expr a = input("a");
  const Function f({a, Expr(3.0), sin(a) + 1.0});
  EXPECT_EQ(f.uniform(), (std::vector<double>{0.5, 3.0, std::sin(0.5) + 1.0}));
  EXPECT_EQ(f.uniform({{"a", 2.0}}), (std::vector<double>{2.0, 3.0, std::sin(2.0) + 1.0}));
}

TEST(Tape, AClaimServesThoseAloneWhoUseIt) {
  const Expr steep = sin(kX * 3.0), claimed = steep.claimLipschitz(0.5);
  EXPECT_EQ(Tape(claimed).lipschitz(), 0.5f);
  EXPECT_GE(Tape(steep).lipschitz(), 3.0f);
  EXPECT_EQ(Tape(min(claimed, kY)).instructions()[1].lipschitz, 0.5f)
      << "all who use the sine rely on the claim";
  EXPECT_GE(Tape(min(claimed, steep + kY)).instructions()[1].lipschitz, 3.0f) << "not all do";
  EXPECT_EQ(Tape(claimed).instructions().size(), Tape(steep).instructions().size())
      << "a claim costs nothing";
}

}  // namespace function_test
}  // namespace sdf
