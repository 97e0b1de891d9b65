// Building graphs: sharing, folding, what is simplified and what must not be, depth, threads, limits.
#include "sdf/expr/expr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "expr/evaluate.h"
#include "number/adversary.h"
#include "sdf/expr/vec.h"

namespace sdf {

// The parts that fused operations are written with, so that their bodies can be expanded into graphs.
Expr mulAdd(const Expr& a, const Expr& b, const Expr& c) { return mul(a, b) + c; }
Expr squareAdd(const Expr& a, const Expr& c) { return square(a) + c; }

namespace expr_test {

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

std::vector<Op> graphOperations() {
  std::vector<Op> all;
  for (const Op op : operations())
    if (!info(op).fused) all.push_back(op);
  return all;
}

Expr makeOf(Op op, const std::vector<Expr>& args) {
  return Expr::make(op, {args.data(), static_cast<std::size_t>(arity(op))});
}

bool sameValue(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(Expr, EqualGraphsAreTheSameNode) {
  for (const Op op : graphOperations()) {
    const Expr a = makeOf(op, {kX, kY, kZ});
    EXPECT_EQ(a, makeOf(op, {kX, kY, kZ})) << info(op).name;
    EXPECT_EQ(a.op(), op);
    EXPECT_NE(a, makeOf(op, {kY, kX, kZ})) << info(op).name;
  }
  EXPECT_EQ(sin(kX) + cos(kY), sin(kX) + cos(kY));
  EXPECT_EQ(Expr(2.5), Expr(2.5));
  EXPECT_NE(Expr(2.5), Expr(2.25));
  EXPECT_EQ(Expr(kNaN), Expr(kNaN));
  EXPECT_NE(Expr(0.0), Expr(-0.0));
  EXPECT_EQ(Expr::variable(Variable::X), kX);
  EXPECT_NE(kX, kY);
}

TEST(Expr, ParametersAreTheSameNodeWhereNameValueAndRangeAgree) {
  const Expr k = Expr::parameter({"k", 0.5, 0.0, 1.0});
  EXPECT_EQ(k, Expr::parameter({"k", 0.5, 0.0, 1.0}));
  EXPECT_NE(k, Expr::parameter({"j", 0.5, 0.0, 1.0}));
  EXPECT_NE(k, Expr::parameter({"k", 0.6, 0.0, 1.0}));
  EXPECT_NE(k, Expr::parameter({"k", 0.5, 0.0, 2.0}));
}

TEST(Expr, OperationsOnConstantsAreFolded) {
  for (const Op op : graphOperations())
    for (int trial = 0; trial < 200; ++trial) {
      Adversary adversary(trial);
      std::vector<double> x;
      std::vector<Expr> args;
      for (int i = 0; i < arity(op); ++i) {
        x.push_back(adversary.below(8) == 0 ? kNaN : adversary.hostile());
        args.emplace_back(x.back());
      }
      const Expr folded = makeOf(op, args);
      ASSERT_TRUE(folded.isConstant()) << text(op, x);
      const double value = evaluateOp<double>(op, [&](int i) { return x[i]; });
      ASSERT_TRUE(sameValue(folded.constantValue(), value)) << text(op, x);
    }
}

TEST(Expr, IdentitiesThatHoldForEveryNumberAreApplied) {
  EXPECT_EQ(kX + 0.0, kX);
  EXPECT_EQ(0.0 + kX, kX);
  EXPECT_EQ(kX - 0.0, kX);
  EXPECT_EQ(kX * 1.0, kX);
  EXPECT_EQ(1.0 * kX, kX);
  EXPECT_EQ(kX / 1.0, kX);
  EXPECT_EQ(min(kX, kX), kX);
  EXPECT_EQ(max(kX, kX), kX);
  EXPECT_EQ(-(-kX), kX);
  EXPECT_EQ(abs(abs(kX)), abs(kX));
  EXPECT_EQ(abs(-kX), abs(kX));
  EXPECT_EQ(square(abs(-kX)), square(kX));
  EXPECT_EQ(kX * kX, square(kX));
  EXPECT_EQ(select(Expr(1.0), kX, kY), kX);
  EXPECT_EQ(select(Expr(0.0), kX, kY), kY);
  EXPECT_EQ(select(kZ, kX, kX), kX);
}

TEST(Expr, IdentitiesThatFailForNaNOrInfinityAreNot) {
  for (const Expr& kept :
       {kX * 0.0, 0.0 * kX, kX - kX, kX / kX, 0.0 / kX, kX + -kX, square(sqrt(kX)), exp(log(kX)),
        log(exp(kX)), pow(kX, 0.0), equal(kX, kX), lessEqual(kX, kX), mod(kX, 1.0) - mod(kX, 1.0)})
    EXPECT_FALSE(kept.isConstant() || kept == kX);
  EXPECT_TRUE(std::isnan(evaluateGraph(kX * 0.0, kInf)));
  EXPECT_TRUE(std::isnan(evaluateGraph(kX - kX, kInf)));
  EXPECT_EQ(evaluateGraph(equal(kX, kX), kNaN), 0.0);
}

TEST(Expr, BuildingChangesNoValue) {
  // Every operation with each argument a variable, its negative or absolute value, or a constant that
  // identities look at: the node must mean what its operation means. Only the sign of a zero may differ.
  const std::array<double, 8> constants = {0.0, -0.0, 1.0, -1.0, 2.0, kInf, -kInf, kNaN};
  for (const Op op : graphOperations())
    for (int trial = 0; trial < 4000; ++trial) {
      Adversary adversary(trial);
      const std::array<double, 2> at = {adversary.below(8) == 0 ? kNaN : adversary.hostile(),
                                        adversary.hostile()};
      std::vector<double> x;
      std::vector<Expr> args;
      for (int i = 0; i < arity(op); ++i) {
        const int v = adversary.below(2), form = adversary.below(4);
        const Expr variable = v ? kY : kX;
        const double c = constants[adversary.below(constants.size())];
        args.push_back(form == 0 ? variable : form == 1 ? -variable : form == 2 ? abs(variable) : Expr(c));
        x.push_back(form == 0 ? at[v] : form == 1 ? -at[v] : form == 2 ? std::abs(at[v]) : c);
      }
      const double meant = evaluateOp<double>(op, [&](int i) { return x[i]; });
      const double built = evaluateGraph(makeOf(op, args), at[0], at[1]);
      ASSERT_TRUE(sameValue(built, meant)) << "trial " << trial << ": " << text(op, x) << " = " << text(meant)
                                           << ", but the graph yields " << text(built);
    }
}

TEST(Expr, FusedOperationsEqualTheGraphOfTheirBody) {
  // The two may associate a sum of squares differently; each of at most eight roundings moves it by half an
  // ulp of the largest intermediate value, which is at most the sum of the arguments' sizes.
  constexpr double kRoundings = 8.0;
  for (const Op op : operations()) {
    if (!info(op).fused) continue;
    for (int trial = 0; trial < 5000; ++trial) {
      Adversary adversary(trial);
      std::vector<double> x(kMaxArity, 0.0);
      std::vector<Expr> args(kMaxArity);
      double size = 0.0;
      for (int i = 0; i < arity(op); ++i) {
        x[i] = adversary.moderate();
        args[i] = Expr(x[i]);
        size += std::abs(x[i]);
      }
      for (int i = 0; i < rowArguments(op); ++i) args[i] = std::array{kX, kY, kZ}[i];
      const Expr body = evaluateOp<Expr>(op, [&](int i) { return args[i]; });
      const double fused = evaluateOp<double>(op, [&](int i) { return x[i]; });
      const double meant = evaluateGraph(body, x[0], x[1], x[2]);
      const double tolerance = kRoundings * 0.5 * kEpsilon * size * std::max(1.0, size);
      ASSERT_NEAR(fused, meant, tolerance) << "trial " << trial << ": " << text(op, x);
      const Interval range = evaluateOp<Interval>(op, [&](int i) { return Interval(x[i]); });
      ASSERT_TRUE(range.contains(meant)) << "trial " << trial << ": " << text(op, x) << " = " << text(range);
      using D = Dual<double, 1>;
      const auto moving = [&](int i) { return D{x[i], {i < rowArguments(op) ? 0.5 + i : 0.0}}; };
      const D slope = evaluateOp<D>(op, moving);
      const D meantSlope = evaluateGraph<D>(body, {moving(0), moving(1), moving(2), D{}, D{}, D{}},
                                            [](double v) { return constant<double, 1>(v); });
      // Near a root's zero the quotient of two small numbers takes over their relative error only.
      ASSERT_NEAR(slope.d[0], meantSlope.d[0], kRoundings * kEpsilon * (8.0 + size)) << "trial " << trial;
    }
  }
}

Expr chain(int depth) {
  Expr e = kX;
  for (int i = 0; i < depth; ++i) e = abs(e - 1.0);
  return e;
}

TEST(Expr, ChainsOfAMillionOperationsAreBuiltWalkedAndTakenDown) {
  const Expr e = chain(500'000);
  EXPECT_EQ(topologicalOrder({&e, 1}).size(), 1'000'002u);  // and x and 1
}

TEST(Expr, DeepChainsAreRemappedAndEvaluated) {
  const Expr e = chain(50'000), moved = remap(e, {kX + 0.25, kY, kZ}, 1.0);
  EXPECT_EQ(evaluateGraph(moved, 0.0), evaluateGraph(e, 0.25));
  EXPECT_EQ(uniformValue(remap(e, {Expr(0.5), kY, kZ}, 1.0)), 0.5);
}

TEST(Expr, NodesGoWithTheirLastHandle) {
  const NodeLimit limit(std::numeric_limits<int>::max());
  {
    const Expr a = sin(kX * 17.25), b = cos(kX * 17.25);
    EXPECT_EQ(limit.held(), 4);  // 17.25, the product, sine and cosine
    const Expr c = sin(kX * 17.25);
    EXPECT_EQ(limit.held(), 4);
  }
  EXPECT_EQ(limit.held(), 0);
}

TEST(Expr, ALimitStopsAGraphThatOutgrowsIt) {
  Expr e = kX;
  const NodeLimit limit(100);
  EXPECT_THROW(for (int i = 0; i < 1000; ++i) e = sin(e), NodeLimitReached);
  EXPECT_LE(limit.held(), 100);
  e = kX;
  EXPECT_EQ(limit.held(), 0);
  EXPECT_EQ(sin(kX), sin(kX));
}

TEST(Expr, ThreadsBuildShareAndDropGraphsAtOnce) {
  constexpr int kThreads = 4, kRounds = 300, kNodes = 40;
  std::vector<Expr> last(kThreads);
  const auto build = [](int rounds) {
    Expr e;
    for (int round = 0; round < rounds; ++round) {
      e = kX;
      for (int i = 0; i < kNodes; ++i) e = sin(e * (1.0 + round % 7) + i).claimLipschitz(1000.0 - round);
    }
    return e;
  };
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t) threads.emplace_back([&, t] { last[t] = build(kRounds); });
  }
  for (const Expr& e : last) EXPECT_EQ(e, last[0]);
  EXPECT_EQ(last[0].lipschitz(), std::min(1000.0 - (kRounds - 1), last[0].lipschitz()));
}

TEST(Expr, OrderHasArgumentsBeforeUsersAndEachNodeOnce) {
  const Expr shared = sin(kX * kY), a = shared + cos(shared), b = sqrt(shared - a);
  const std::vector<Expr> roots = {a, b, a}, order = topologicalOrder(roots);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(std::find(order.begin(), order.begin() + i, order[i]), order.begin() + i) << "twice";
    for (int k = 0; k < arity(order[i].op()); ++k)
      EXPECT_NE(std::find(order.begin(), order.begin() + i, order[i].arg(k)), order.begin() + i)
          << "too late";
  }
  EXPECT_EQ(order.size(), 8u);  // x, y, product, sine, cosine, sum, difference, root
}

TEST(Expr, UniformValueTakesParametersAtTheirPresentValues) {
  const Expr k = Expr::parameter({"k", 0.5, 0.0, 1.0});
  EXPECT_EQ(uniformValue(sin(k * 3.0) + k), std::sin(1.5) + 0.5);
  EXPECT_FALSE(dependsOnSpace(sin(k * 3.0)));
  EXPECT_TRUE(dependsOnSpace(sin(k * kX)));
  EXPECT_TRUE(dependsOnSpace(normal().y));
}

// What constants are folded to is known of parameters of one value, too, to the bit.
TEST(Expr, FormulasOfKnownParametersHaveOneValue) {
  constexpr double kValue = 14.3, kTurn = 0.017453292519943295;
  const auto formula = [](const Expr& e) { return sin(e * kTurn) / sqrt(e) + max(e, 3.0); };
  const Expr known = Expr::parameter({"k", kValue, kValue, kValue});
  EXPECT_FALSE(formula(known).isConstant());
  ASSERT_TRUE(formula(known).range().isPoint());
  EXPECT_EQ(formula(known).range().lo, formula(Expr(kValue)).constantValue());
  EXPECT_FALSE(formula(Expr::parameter({"k", kValue, 14.0, 15.0})).range().isPoint());
  EXPECT_FALSE((known * kX).range().isPoint());
  EXPECT_TRUE(sqrt(-known).range().nan);
}

TEST(Expr, MixAndClampMeanWhatTheySay) {
  EXPECT_EQ(evaluateGraph(mix(kX, kY, Expr(0.25)), 1.0, 5.0), 2.0);
  EXPECT_EQ(evaluateGraph(clamp(kX, 0.0, 1.0), 3.0), 1.0);
  EXPECT_EQ(evaluateGraph(clamp(kX, 0.0, 1.0), -3.0), 0.0);
}

}  // namespace expr_test
}  // namespace sdf
