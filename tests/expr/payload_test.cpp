// Nodes whose function is given by data: sharing, folding, facts, rewriting, derivatives.
#include "sdf/expr/payload.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <random>

#include "expr/evaluate.h"
#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "support/bind.h"
#include "support/payloads.h"

namespace sdf {
namespace payload_test {

using test::coordinates;

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

class PayloadNode : public testing::TestWithParam<test::PayloadCase> {
 protected:
  const std::shared_ptr<const Payload> payload = GetParam().payload;
  std::mt19937 random{1};

  double anywhere(double reach = 1.6) {
    return std::uniform_real_distribution<double>(-reach, reach)(random);
  }
  glm::dvec3 anyPoint(double reach = 1.6) { return {anywhere(reach), anywhere(reach), anywhere(reach)}; }
  double at(const Expr& e, const glm::dvec3& p) const { return evaluateGraph(e, p.x, p.y, p.z); }
};

INSTANTIATE_TEST_SUITE_P(All, PayloadNode, testing::ValuesIn(test::payloadCases()),
                         [](const auto& i) { return i.param.name; });

TEST_P(PayloadNode, IsSharedByPayloadPartAndPoint) {
  const Expr e = Expr::payload({payload}, coordinates());
  EXPECT_EQ(e.op(), Op::Payload);
  EXPECT_EQ(e, Expr::payload({payload}, {kX, kY, kZ}));
  EXPECT_NE(e, Expr::payload({payload}, {kY, kX, kZ}));
  EXPECT_NE(e, Expr::payload({payload, 1}, coordinates()));
  EXPECT_NE(Expr::payload({payload, 2}, coordinates()), Expr::payload({payload, 1}, coordinates()));
  EXPECT_EQ(e.payloadPart()->payload, payload);
  EXPECT_EQ(kX.payloadPart(), nullptr);
  EXPECT_NE(Expr::payload({test::fourPoints()}, coordinates()),
            Expr::payload({test::fourPoints()}, coordinates()))
      << "payloads are told apart by identity";
}

TEST_P(PayloadNode, OfConstantsIsAConstant) {
  const glm::dvec3 p = anyPoint();
  EXPECT_TRUE(Expr::payload({payload}, {p.x, p.y, p.z}).isConstant(payload->value(p)));
  EXPECT_TRUE(Expr::payload({payload, 2}, {p.x, p.y, p.z}).isConstant(payload->gradient(p).gradient.y));
  const Expr a = Expr::parameter({"a", p.x, -2.0, 2.0});
  EXPECT_EQ(uniformValue(Expr::payload({payload}, {a, p.y, p.z})), payload->value(p));
}

TEST_P(PayloadNode, TakesTheValueAtItsArguments) {
  const Expr e = Expr::payload({payload}, {kX * 2.0, kZ - 0.5, kX + kY}) + kY;
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p = anyPoint();
    ASSERT_EQ(at(e, p), payload->value({p.x * 2.0, p.z - 0.5, p.x + p.y}) + p.y);
  }
}

// A slope from intervals takes three squares, two sums, a root and a product, each rounded and stepped
// outward by an ulp: less than two. `exact` is rounded twice.
void expectRoundedUp(double slope, double exact) {
  EXPECT_GE(slope, exact * (1.0 - DBL_EPSILON));
  EXPECT_LE(slope, exact * (1.0 + 7 * 2 * DBL_EPSILON));
}

TEST_P(PayloadNode, HasItsRangeAndSlope) {
  const Expr here = Expr::payload({payload}, coordinates());
  expectRoundedUp(here.lipschitz(), payload->lipschitz() * std::sqrt(3.0));
  EXPECT_EQ(test::payloadHere(payload).lipschitz(), payload->lipschitz());
  EXPECT_EQ(Expr::payload({payload, 1}, coordinates()).lipschitz(), HUGE_VAL);
  EXPECT_GE(Expr::payload({payload, 1}, coordinates()).range().hi, payload->lipschitz());
  const Expr folded = Expr::payload({payload}, {abs(kX) * 0.5, kY * 2.0, 0.25});
  expectRoundedUp(folded.lipschitz(), payload->lipschitz() * std::hypot(0.5, 2.0));
  double steepest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = anyPoint(), q = i % 2 ? anyPoint() : p + 0.01 * anyPoint();
    for (const Expr& e : {test::payloadHere(payload), folded}) {
      ASSERT_TRUE(e.range().contains(at(e, p)));
      ASSERT_LE(std::abs(at(e, p) - at(e, q)), e.lipschitz() * glm::length(p - q) * (1.0 + 1e-9));
    }
    steepest = std::max(steepest, std::abs(payload->value(p) - payload->value(q)) / glm::length(p - q));
  }
  EXPECT_GT(steepest, GetParam().steepest * payload->lipschitz()) << "the bound says too little";
}

TEST_P(PayloadNode, IntervalsContainTheValues) {
  const Expr e = Expr::payload({payload}, {kX + kY, kY * 0.5, kZ});
  const auto number = [](double v) { return Interval(v); };
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 corner = anyPoint(), size = glm::abs(anyPoint(i % 2 ? 0.01 : 1.0));
    std::array<Interval, kVariableCount> box;
    for (int k = 0; k < 3; ++k) box[k] = {corner[k], corner[k] + size[k]};
    const Interval range = evaluateGraph<Interval>(e, box, number);
    EXPECT_LE(range.width(), payload->lipschitz() * 4.0 * glm::length(size) + 1e-9) << "too wide";
    for (int s = 0; s < 8; ++s) {
      const glm::dvec3 p = corner + size * glm::dvec3(s & 1, (s >> 1) & 1, 0.5);
      ASSERT_TRUE(range.contains(at(e, p)));
    }
  }
  EXPECT_TRUE(Expr::payload({payload}, {kX, sqrt(kY), kZ}).range().nan);
  EXPECT_FALSE(Expr::payload({payload}, {kX, abs(kY), kZ}).range().nan);
}

TEST_P(PayloadNode, IsRewrittenAsOperationsAre) {
  const Expr e = test::payloadHere(payload) - 0.1;
  const Expr moved = remap(e, {kX * 0.6 - kY * 0.8, kX * 0.8 + kY * 0.6, kZ + 1.0}, 1.0);
  EXPECT_EQ(moved.lipschitz(), payload->lipschitz());
  const glm::dvec3 p = anyPoint();
  EXPECT_EQ(at(moved, p), payload->value({p.x * 0.6 - p.y * 0.8, p.x * 0.8 + p.y * 0.6, p.z + 1.0}) - 0.1);
  EXPECT_EQ(remap(e, coordinates(), 1.0), e);
  EXPECT_EQ(withoutClaims({&e, 1}).front(), Expr::payload({payload}, coordinates()) - 0.1);
  const Expr slope = Expr::payload({payload, 3}, coordinates());
  EXPECT_EQ(remap(slope, {kY, kZ, kX}, 1.0), Expr::payload({payload, 3}, {kY, kZ, kX}));
  const Expr a = Expr::parameter({"a", 0.5, 0.0, 1.0});
  EXPECT_EQ(test::bind(Expr::payload({payload}, {kX + a, kY, kZ}), {{"a", 0.25}}),
            Expr::payload({payload}, {kX + 0.25, kY, kZ}));
  EXPECT_EQ(hoisted(min(e, kX - 0.1)), min(Expr::payload({payload}, coordinates()), kX) - 0.1);
}

TEST_P(PayloadNode, DerivativesAreThatOfTheFunction) {
  const Expr e = Expr::payload({payload}, {kX + kY * kZ, kY - 0.25, sin(kZ)});
  const Vec3E g = gradientOf(e);
  int off = 0;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = anyPoint(1.0);
    const glm::dvec3 got(at(g.x, p), at(g.y, p), at(g.z, p));
    const auto dual = evaluateGraph<Dual<double, 3>>(
        e,
        {Dual<double, 3>{p.x, {1, 0, 0}}, Dual<double, 3>{p.y, {0, 1, 0}}, Dual<double, 3>{p.z, {0, 0, 1}},
         Dual<double, 3>{}, Dual<double, 3>{}, Dual<double, 3>{}},
        [](double v) { return constant<double, 3>(v); });
    ASSERT_EQ(dual.v, at(e, p));
    for (int k = 0; k < 3; ++k) {
      ASSERT_NEAR(dual.d[k], got[k], 1e-14 * (1.0 + std::abs(got[k])));
      glm::dvec3 step(0.0);
      step[k] = kStep;
      // Creases are rarely this near.
      off += std::abs((at(e, p + step) - at(e, p - step)) / (2.0 * kStep) - got[k]) > 1e-5;
    }
  }
  EXPECT_LE(off, 5);
}

TEST_P(PayloadNode, HasNoSecondDerivatives) {
  const Expr slope = Expr::payload({payload, 1}, coordinates());
  EXPECT_TRUE(std::isnan(at(gradientOf(slope).y, {0.1, 0.2, 0.3})));
}

// A payload may hold expressions, among them another payload's last.
TEST(PayloadLife, EndsWithTheLastNode) {
  struct Formula : test::Points {
    Formula(Expr e) : Points({{0.0, 0.0, 0.0}}, 1.0), inner(std::move(e)) {}
    Expr inner;
  };
  std::weak_ptr<const Payload> outer, inner;
  {
    const auto first = std::make_shared<const Formula>(kX * 17.0 + kY);
    const auto second = std::make_shared<const Formula>(Expr::payload({first}, coordinates()) + 3.5);
    inner = first, outer = second;
  }
  EXPECT_TRUE(inner.expired());
  {
    auto first = std::make_shared<const Formula>(kX * 17.0 + kY);
    auto second = std::make_shared<const Formula>(Expr::payload({first}, coordinates()) + 3.5);
    inner = first, outer = second;
    const Expr e = Expr::payload({std::move(second)}, coordinates()) * 2.0;
    first.reset();
    EXPECT_FALSE(inner.expired());
    EXPECT_EQ(evaluateGraph(e, 2.0), 2.0);
  }
  EXPECT_TRUE(outer.expired());
  EXPECT_TRUE(inner.expired());
}

}  // namespace payload_test
}  // namespace sdf
