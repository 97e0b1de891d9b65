// Functions given by data through every reading of a tape, and through all that makes tapes of others.
#include <gtest/gtest.h>

#include <cfloat>
#include <random>

#include "sdf/eval/batch.h"
#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/eval/union_tapes.h"
#include "sdf/expr/gradient.h"
#include "support/float_range.h"
#include "support/payloads.h"

namespace sdf::test {
namespace payload_test {

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

// An instruction is read from memory at each step of every reading.
static_assert(sizeof(Instruction) == 24 && sizeof(RegisterInstruction) == 24);

/// Some points in the cube of half size 1.6, as the batch reading takes them.
struct Cloud {
  explicit Cloud(std::size_t count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(-1.6f, 1.6f);
    for (std::size_t i = 0; i < count; ++i)
      x.push_back(any(random)), y.push_back(any(random)), z.push_back(any(random));
  }
  std::size_t size() const { return x.size(); }
  glm::dvec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Rows rows() const { return {x.data(), y.data(), z.data()}; }
  std::vector<float> x, y, z;
};

struct BatchOutput {
  std::vector<float> values, beside, slopes[3];
};

BatchOutput batchOf(const Tape& tape, const Cloud& points) {
  BatchOutput out;
  for (auto* row : {&out.values, &out.beside, &out.slopes[0], &out.slopes[1], &out.slopes[2]})
    row->resize(points.size());
  BatchEvaluator batch;
  batch.evaluate(tape, points.rows(), points.size(), out.values.data());
  batch.evaluateGradient(tape, points.rows(), points.size(), out.beside.data(), out.slopes[0].data(),
                         out.slopes[1].data(), out.slopes[2].data());
  return out;
}

class PayloadTape : public testing::TestWithParam<PayloadCase> {
 protected:
  const std::shared_ptr<const Payload> payload = GetParam().payload;

  Expr here() const { return payloadHere(payload); }
  Expr moved() const { return Expr::payload({payload}, {kX * 0.5 + kY, kZ, kX - kY}); }
};

INSTANTIATE_TEST_SUITE_P(All, PayloadTape, testing::ValuesIn(payloadCases()),
                         [](const auto& i) { return i.param.name; });

TEST_P(PayloadTape, IsTheFunctionInDouble) {
  const Tape tape(std::array{here(), moved() * 2.0 - kX});
  const Cloud points(200);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 p = points.at(i);
    ASSERT_EQ(
        evaluateAll(tape, p),
        (std::vector{payload->value(p), 2.0 * payload->value({p.x * 0.5 + p.y, p.z, p.x - p.y}) - p.x}));
    ASSERT_EQ(evaluateGradient(tape, p).gradient, payload->gradient(p).gradient);
  }
  EXPECT_GE(tape.lipschitz(), payload->lipschitz());
  EXPECT_LE(tape.lipschitz(), payload->lipschitz() * (1.0 + FLT_EPSILON));
}

TEST_P(PayloadTape, BatchKeepsItsPromise) {
  const Cloud points(3000);
  for (const Expr& e : {here(), moved(), here() * 3.0 + min(moved(), kY)}) {
    const Tape tape(e);
    const BatchOutput got = batchOf(tape, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::vec3 p(points.at(i));
      const Interval allowed = floatRange(tape, p);
      ASSERT_TRUE(allowed.contains(got.values[i]))
          << got.values[i] << " not in " << allowed.lo << ", " << allowed.hi;
      ASSERT_TRUE(allowed.contains(got.beside[i]));
      ASSERT_TRUE(allowed.contains(evaluate(tape, points.at(i))));
      ASSERT_LE(allowed.width(), 1e-3) << "hardly anything is promised";
      const auto slopes = floatGradientRange(tape, p);
      for (int k = 0; k < 3; ++k) ASSERT_TRUE(slopes[k].contains(got.slopes[k][i]));
    }
  }
}

TEST_P(PayloadTape, BatchGradientsAreTheDoubleReadingsButAtCreases) {
  const Cloud points(3000);
  for (const Expr& e : {here(), moved() * kX}) {
    const Tape tape(e);
    const BatchOutput got = batchOf(tape, points);
    std::size_t off = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 g = evaluateGradient(tape, points.at(i)).gradient;
      off += glm::length(g - glm::dvec3(got.slopes[0][i], got.slopes[1][i], got.slopes[2][i])) > 1e-4;
    }
    EXPECT_LE(off, 3u);
  }
}

TEST_P(PayloadTape, BatchReadsDerivativesThatAreNodes) {
  const Vec3E g = gradientOf(moved());
  const Tape slopes(std::array{g.x, g.y, g.z}), tape(moved());
  const Cloud points(700);
  const BatchOutput got = batchOf(tape, points);
  std::vector<float> out[3];
  for (auto& row : out) row.resize(points.size());
  float* const rows[] = {out[0].data(), out[1].data(), out[2].data()};
  BatchEvaluator().evaluate(slopes, points.rows(), points.size(), rows);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(out[k][i], got.slopes[k][i], 1e-5);
  const BatchOutput second = batchOf(Tape(g.x), points);
  EXPECT_EQ(second.beside, out[0]);
  EXPECT_TRUE(std::isnan(second.slopes[1][5])) << "second derivatives are not known";
}

TEST_P(PayloadTape, IntervalsContainValuesAndSlopes) {
  const Tape tape(moved() + kX * 0.25);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.6, 1.6), unit(0.0, 1.0);
  for (int trial = 0; trial < 500; ++trial) {
    const glm::dvec3 corner{any(random), any(random), any(random)},
        size = glm::dvec3{unit(random), unit(random), unit(random)} * (trial % 2 ? 1.0 : 0.02);
    const Box box{corner, corner + size};
    const Interval range = evaluate(tape, box);
    const double slope = lipschitzOver(tape, box);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 p = corner + size * glm::dvec3{unit(random), unit(random), unit(random)};
      ASSERT_TRUE(range.contains(evaluate(tape, p)));
      ASSERT_LE(glm::length(evaluateGradient(tape, p).gradient), slope * (1.0 + 1e-9));
    }
  }
  EXPECT_LE(lipschitzOver(Tape(here()), Box::centred(glm::dvec3(2.0))), payload->lipschitz() * 1.7321);
  EXPECT_TRUE(evaluate(tape, Box::everything()).contains(evaluate(tape, {1e30, 0.0, 0.0})));
}

TEST_P(PayloadTape, IsSpecialisedWithWhatItNeeds) {
  // In x < 0 one argument is the constant 0; far off in y the payload itself is dropped.
  const Expr e =
      min(Expr::payload({payload}, {max(kX, 0.0), kY, kZ}).claimLipschitz(payload->lipschitz()), kY + 5.0);
  const Tape tape(e);
  ScalarReading<Interval> workspace;
  std::vector<Decision> decisions;
  evaluate(tape, Box{{-1.5, -1.0, -1.0}, {-0.5, 1.0, 1.0}}, workspace, decisions);
  const TapePtr left = tape.specialised(decisions.data(), 1);
  ASSERT_TRUE(left);
  ASSERT_EQ(left->instructions().size(), 1u);
  EXPECT_EQ(left->instructions()[0].op, Op::Payload);
  EXPECT_EQ(left->instructions()[0].in[0], Operand::constant(0));
  Cloud points(100);
  for (float& x : points.x) x = -0.5f - std::abs(x) / 1.6f, x = std::max(x, -1.5f);
  const BatchOutput whole = batchOf(tape, points), part = batchOf(*left, points);
  EXPECT_EQ(part.values, whole.values);
  EXPECT_EQ(part.slopes[1], whole.slopes[1]);
  EXPECT_EQ(part.slopes[0], std::vector<float>(points.size(), 0.0f));
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(evaluate(*left, points.at(i)), evaluate(tape, points.at(i)));

  const float x = 0.25f, y = -9.0f, z = 0.0f;
  float value;
  BatchEvaluator().evaluateBalls(tape, {&x, &y, &z}, 1, 0.5f, 1e-4f, &value, decisions);
  const TapePtr below = tape.specialised(decisions.data(), 1);
  ASSERT_TRUE(below);
  for (const Instruction& n : below->instructions()) EXPECT_NE(n.op, Op::Payload);
  EXPECT_EQ(value, -4.0f);
}

TEST_P(PayloadTape, IsAFunctionOfItsInputs) {
  const Expr a = Expr::parameter({"a", 0.1, -1.0, 1.0});
  // One payload node varies over space, one is computed from the input alone.
  const Function f(Expr::payload({payload}, {kX + a, kY, kZ}) +
                   Expr::payload({payload}, {a, 0.2, a * a}) * kX);
  const glm::dvec3 p(0.3, -0.4, 0.5);
  for (const double v : {0.1, -0.7, 0.9}) {
    const double expected = payload->value({p.x + v, p.y, p.z}) + payload->value({v, 0.2, v * v}) * p.x;
    EXPECT_EQ(evaluate(*f.at({{"a", v}}), p), expected);
  }
  EXPECT_EQ(f.at({{"a", 0.9}})->instructions().size(), 3u);
}

// The operands' lists of payloads and of constants are of different lengths.
TEST(PayloadUnion, LinksEachOperandsPayload) {
  const std::vector<std::shared_ptr<const Payload>> payloads{sampledBall(9), fourPoints(), sampledBall(5)};
  std::vector<Expr> distances{length(Vec3E(kX, kY, kZ) - Vec3E(Expr(0.5))) - 0.25};
  for (const auto& payload : payloads) {
    const double shift = 0.3 * static_cast<double>(distances.size());
    const Expr e = Expr::payload({payload}, {kX - shift, kY * 0.9 + 0.1, kZ});
    distances.push_back(distances.size() == 2 ? max(e, payloadHere(payloads[0]) - 0.2) : e);
  }
  std::vector<TapePtr> tapes;
  for (const Expr& e : distances) tapes.push_back(std::make_shared<const Tape>(std::array{e, kX * 2.0}));
  const auto smooth = std::make_shared<const Tape>(
      std::array{Expr::payload({fourPoints()}, {kX, kY, 0.5}), Expr(0.5), Expr(0.0)});
  const Cloud points(600);
  for (const TapePtr& join : {TapePtr(), smooth}) {
    const UnionTapes all(tapes, join);
    for (const std::vector<std::uint32_t>& some :
         {std::vector<std::uint32_t>{0, 1, 2, 3}, {1, 3}, {2}, {0, 2, 3}}) {
      const TapePtr linked = all.link(some);
      const BatchOutput batch = batchOf(*linked, points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 p = points.at(i);
        double expected = evaluate(*tapes[some[0]], p);
        for (const std::uint32_t k : std::span(some).subspan(1)) {
          const double next = evaluate(*tapes[k], p);
          expected = join ? evaluate(*join, {expected, next, 0.0}) : std::min(expected, next);
        }
        ASSERT_EQ(evaluate(*linked, p), expected);
        ASSERT_NEAR(batch.values[i], expected, 1e-4);
      }
    }
  }
}

TEST(PayloadNumbers, ThatAreNoneStayNone) {
  const Tape tape(std::array{payloadHere(sampledBall(5)), payloadHere(fourPoints())});
  EXPECT_TRUE(std::isnan(evaluateAll(tape, {NAN, 0.0, 0.0})[0]));
  EXPECT_TRUE(std::isnan(evaluateAll(tape, {0.0, NAN, 0.0})[1]));
  EXPECT_EQ(evaluateAll(tape, {0.0, kInfinity, 0.0})[1], kInfinity);
}

}  // namespace payload_test
}  // namespace sdf::test
