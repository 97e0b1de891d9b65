// Every operation through every reading, with hostile arguments. The double reading of ops.def is the
// meaning; the others must agree with it to the tolerance that eval/batch.h states.
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <random>
#include <vector>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/vec.h"
#include "support/operations.h"

namespace sdf {
namespace {

using test::arguments;
using test::graphOperations;
using Case = test::OperationCase;

// Fused operations, written so that the tape compiler makes them.
std::vector<Case> fusedOperations() {
  const auto [x, y, z] = position();
  return {{Op::MulAdd, x * y + z},
          {Op::AbsMinus, abs(x) - 0.75},
          {Op::Length2, length(x, y) - 0.5},
          {Op::Length3, length(x, y, z) - 0.5},
          {Op::Distance3, length(x - 0.25, y + 0.5, z - 1.0) - 0.125}};
}

double ulp(double value) {
  const float v = std::abs(static_cast<float>(value));
  if (!std::isfinite(v)) return HUGE_VAL;
  return std::max<double>(std::nextafter(v, HUGE_VALF) - v, FLT_TRUE_MIN);
}

// What eval/batch.h promises, in units of the last place of the result.
double promisedUlps(Op op) {
  switch (op) {
    case Op::Tan:
      return 8.0;
    case Op::Pow:
      return 2.0;
    default:
      return 4.0;
  }
}

// Largest difference between the batch and the double reading that is allowed for these arguments.
double allowance(Op op, const double (&a)[3], double expected) {
  double bound = promisedUlps(op) * ulp(expected);
  if (op == Op::Mod) bound = 2.0 * ulp(expected) + ulp(a[0]);
  // exp flushes results under the smallest normal number.
  if (op == Op::Exp || op == Op::Pow) bound = std::max<double>(bound, FLT_MIN);
  // A sum of products is rounded once at the size of its terms, a length minus a constant at the size of the
  // length.
  if (op == Op::MulAdd) bound = ulp(std::abs(a[0] * a[1]) + std::abs(a[2]));
  if (op == Op::AbsMinus || op == Op::Length2 || op == Op::Length3 || op == Op::Distance3)
    bound = 4.0 * ulp(std::abs(expected) + 2.0);
  return bound;
}

// Arguments for which the operation promises nothing in float: overflow or underflow on the way.
bool outOfScope(Op op, const double (&a)[3]) {
  const double big = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (op == Op::Mod) return !(std::abs(a[0] / a[1]) < 1 << 22) || std::abs(a[0]) < 1e-30;
  if (op == Op::Length2 || op == Op::Length3 || op == Op::Distance3) return big > 1e18;
  if (op == Op::MulAdd) return big > 1e18;
  return false;
}

void expectClose(Op op, float got, double expected, const double (&a)[3]) {
  if (outOfScope(op, a)) return;
  const std::string where = std::string(info(op).name) + "(" + std::to_string(a[0]) + ", " +
                            std::to_string(a[1]) + ", " + std::to_string(a[2]) + ")";
  SCOPED_TRACE(where);
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(got)) << got;
    return;
  }
  const float rounded = static_cast<float>(expected);
  if (got == rounded) return;
  double difference = std::abs(got - expected);
  // The quotient may round up to a whole number; the remainder is then off by one whole divisor.
  if (op == Op::Mod) difference = std::min(difference, std::abs(difference - std::abs(a[1])));
  EXPECT_LE(difference, allowance(op, a, expected)) << "got " << got << ", expected " << expected;
}

// Runs a case over all triples of the argument lists through the batch reading, and checks each against
// double.
void checkBatch(const Case& c, const std::vector<float>& xs, const std::vector<float>& ys,
                const std::vector<float>& zs) {
  std::vector<float> x, y, z;
  for (const float a : xs)
    for (const float b : ys)
      for (const float d : zs) x.push_back(a), y.push_back(b), z.push_back(d);
  const Tape tape(c.expr);
  ASSERT_EQ(tape.instructions().back().op, c.op) << "the tape compiler chose another instruction";
  std::vector<float> got(x.size());
  BatchEvaluator batch;
  batch.evaluate(tape, {.x = x.data(), .y = y.data(), .z = z.data()}, x.size(), got.data());
  for (std::size_t i = 0; i < x.size(); ++i)
    expectClose(c.op, got[i], evaluate(tape, {x[i], y[i], z[i]}), {x[i], y[i], z[i]});
}

class Agreement : public testing::TestWithParam<Case> {};

std::string caseName(const testing::TestParamInfo<Case>& i) { return std::string(info(i.param.op).name); }

INSTANTIATE_TEST_SUITE_P(Graph, Agreement, testing::ValuesIn(graphOperations()), caseName);
INSTANTIATE_TEST_SUITE_P(Fused, Agreement, testing::ValuesIn(fusedOperations()), caseName);

TEST_P(Agreement, BatchIsWithinThePromisedUlps) {
  const int rows = rowArguments(GetParam().op);
  const std::vector<float> none{0.0f}, all = arguments(1, 2000), some = arguments(2, 40);
  if (rows == 1) checkBatch(GetParam(), all, none, none);
  if (rows == 2) checkBatch(GetParam(), some, some, none);
  if (rows == 3)
    checkBatch(GetParam(), some, test::hostileArguments(), {0.0f, -1.5f, 1e-20f, 1e9f, HUGE_VALF, NAN});
}

TEST_P(Agreement, IntervalContainsEverySample) {
  const Tape tape(GetParam().expr);
  const std::vector<float> all = arguments(3, 40);
  std::mt19937 random(4);
  auto pick = [&] { return all[random() % all.size()]; };
  for (int trial = 0; trial < 20000; ++trial) {
    double ends[3][2];
    for (auto& e : ends) {
      do e[0] = pick(), e[1] = trial % 4 ? pick() : e[0];
      while (std::isnan(e[0]) || std::isnan(e[1]));
      if (e[0] > e[1]) std::swap(e[0], e[1]);
    }
    const Interval range =
        evaluate(tape, Box{{ends[0][0], ends[1][0], ends[2][0]}, {ends[0][1], ends[1][1], ends[2][1]}});
    std::uniform_real_distribution<double> inside(0.0, 1.0);
    for (int sample = 0; sample < 8; ++sample) {
      glm::dvec3 p;
      for (int k = 0; k < 3; ++k) {
        const double t = sample < 2 ? sample : inside(random);
        p[k] = t == 0.0   ? ends[k][0]
               : t == 1.0 ? ends[k][1]
                          : std::clamp((1 - t) * ends[k][0] + t * ends[k][1], ends[k][0], ends[k][1]);
        if (std::isnan(p[k])) p[k] = ends[k][0];
      }
      const double value = evaluate(tape, p);
      ASSERT_TRUE(range.contains(value))
          << "trial " << trial << ": " << value << " at (" << p.x << ", " << p.y << ", " << p.z
          << ") is not in [" << range.lo << ", " << range.hi << "]" << (range.nan ? " or NaN" : "");
    }
  }
}

// Away from kinks and poles the SIMD derivatives equal the double ones to the rounding of the few operations
// they take.
TEST_P(Agreement, BatchGradientEqualsTheReference) {
  constexpr double kRoundings = 32.0;  // of the value's and the derivative's own size
  const Tape tape(GetParam().expr);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> plain(0.1f, 0.9f);
  constexpr int kCount = 300;  // not a whole number of vectors
  float x[kCount], y[kCount], z[kCount], v[kCount], dx[kCount], dy[kCount], dz[kCount];
  for (int i = 0; i < kCount; ++i) x[i] = plain(random), y[i] = plain(random), z[i] = plain(random);
  BatchEvaluator batch;
  batch.evaluateGradient(tape, {.x = x, .y = y, .z = z}, kCount, v, dx, dy, dz);
  for (int i = 0; i < kCount; ++i) {
    const ValueAndGradient expected = evaluateGradient(tape, {x[i], y[i], z[i]});
    const double got[3] = {dx[i], dy[i], dz[i]};
    for (int k = 0; k < 3; ++k) {
      const double scale = 1.0 + std::abs(expected.gradient[k]) + std::abs(expected.value);
      EXPECT_NEAR(got[k], expected.gradient[k], kRoundings * FLT_EPSILON * scale)
          << info(GetParam().op).name << " axis " << k << " at " << x[i] << ", " << y[i] << ", " << z[i];
    }
    EXPECT_NEAR(v[i], expected.value, kRoundings * FLT_EPSILON * (1.0 + std::abs(expected.value)));
  }
}

TEST(AgreementCases, CoverTheWholeOperationList) {
  std::vector<bool> covered(kOpCount, false);
  for (const Case& c : graphOperations()) covered[static_cast<int>(c.op)] = true;
  for (const Case& c : fusedOperations()) covered[static_cast<int>(c.op)] = true;
  for (int i = 0; i < kOpCount; ++i) {
    EXPECT_TRUE(covered[i] || arity(static_cast<Op>(i)) == 0) << kOps[i].name;
  }
}

}  // namespace
}  // namespace sdf
