// The meaning of the operations on double, which every other reading is held to.
#include "sdf/number/scalar.h"

#include <gtest/gtest.h>

#include "number/adversary.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace scalar_test {

TEST(Scalar, MinAndMaxTakeTheSecondOnATieOrANaN) {
  EXPECT_EQ(min(kNaN, 2.0), 2.0);
  EXPECT_EQ(max(kNaN, 2.0), 2.0);
  EXPECT_TRUE(std::isnan(min(2.0, kNaN)));
  EXPECT_TRUE(std::isnan(max(2.0, kNaN)));
  EXPECT_TRUE(std::signbit(min(0.0, -0.0)));
  EXPECT_FALSE(std::signbit(max(-0.0, 0.0)));
}

TEST(Scalar, RoundTakesTiesToEven) {
  EXPECT_EQ(round(0.5), 0.0);
  EXPECT_EQ(round(1.5), 2.0);
  EXPECT_EQ(round(2.5), 2.0);
  EXPECT_EQ(round(-0.5), 0.0);
  EXPECT_EQ(round(-1.5), -2.0);
}

TEST(Scalar, ModHasTheSignOfTheDivisor) {
  EXPECT_EQ(mod(5.0, 3.0), 2.0);
  EXPECT_EQ(mod(-5.0, 3.0), 1.0);
  EXPECT_EQ(mod(5.0, -3.0), -1.0);
  EXPECT_EQ(mod(6.0, 3.0), 0.0);
  EXPECT_TRUE(std::isnan(mod(1.0, 0.0)));
}

TEST(Scalar, ModStaysWithinAnUlpOfItsPeriod) {
  for (int trial = 0; trial < 100000; ++trial) {
    Adversary adversary(trial);
    const double a = adversary.uniform(-1e6, 1e6), b = adversary.uniform(0.01, 100.0);
    const double slack = 2.0 * kEpsilon * std::abs(a);  // of the quotient and of the product
    ASSERT_GE(mod(a, b), -slack) << text(a) << " mod " << text(b);
    ASSERT_LE(mod(a, b), b + slack) << text(a) << " mod " << text(b);
  }
}

TEST(Scalar, ComparisonsYieldOneOrZeroAndAreFalseForNaN) {
  EXPECT_EQ(less(1.0, 2.0), 1.0);
  EXPECT_EQ(less(2.0, 2.0), 0.0);
  EXPECT_EQ(lessEqual(2.0, 2.0), 1.0);
  EXPECT_EQ(lessEqual(3.0, 2.0), 0.0);
  EXPECT_EQ(equal(-0.0, 0.0), 1.0);
  EXPECT_EQ(equal(1.0, 2.0), 0.0);
  for (const double x : {0.0, 1.0, kInf, kNaN}) {
    EXPECT_EQ(less(kNaN, x), 0.0);
    EXPECT_EQ(lessEqual(x, kNaN), 0.0);
    EXPECT_EQ(equal(kNaN, x), 0.0);
  }
}

TEST(Scalar, SelectTakesTheFirstForAnythingButZero) {
  EXPECT_EQ(select(1.0, 5.0, 7.0), 5.0);
  EXPECT_EQ(select(-0.5, 5.0, 7.0), 5.0);
  EXPECT_EQ(select(kNaN, 5.0, 7.0), 5.0);
  EXPECT_EQ(select(0.0, 5.0, 7.0), 7.0);
  EXPECT_EQ(select(-0.0, 5.0, 7.0), 7.0);
  EXPECT_EQ(select(1.0, 5.0, kNaN), 5.0);
}

TEST(Scalar, EveryOperationIsNamedAfterItsFunction) {
  const auto lowered = [](std::string name) {
    name[0] = static_cast<char>(std::tolower(name[0]));
    return name;
  };
#define SDF_UNARY(name, call, ...) EXPECT_EQ(lowered(#name), #call);
#define SDF_BINARY SDF_UNARY
#define SDF_TERNARY SDF_UNARY
#include "sdf/expr/ops.def"
  for (const Op op : operations())
    EXPECT_GE(arity(op), 1 + info(op).constants) << info(op).name << " has no argument that varies";
}

}  // namespace scalar_test
}  // namespace sdf
