// The facts that nodes carry (range, slope), checked by sampling random expressions. A failing expression is
// shrunk to the smallest that still fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "expr/evaluate.h"
#include "number/adversary.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace lipschitz_facts_test {

/// An expression that can be taken apart. Leaves: a constant (variable < 0) or a coordinate.
struct Tree {
  Op op = Op::Constant;
  int variable = -1;
  double value = 0.0;
  std::vector<Tree> args;

  bool isLeaf() const { return args.empty(); }

  static Tree random(Adversary& adversary, int depth) {
    Tree t;
    if (depth == 0 || adversary.below(6) == 0) {
      t.variable = adversary.below(5) - 1;
      t.variable = std::min(t.variable, 2);
      t.value = adversary.below(2) ? adversary.dyadic(3) : adversary.below(7) - 3;
      return t;
    }
    static const std::vector<Op> all = operations();
    do t.op = all[adversary.below(all.size())];
    while (info(t.op).fused);
    for (int i = 0; i < arity(t.op); ++i) t.args.push_back(random(adversary, depth - 1));
    return t;
  }

  Expr build() const {
    if (isLeaf()) return variable < 0 ? Expr(value) : Expr::variable(static_cast<Variable>(variable));
    std::vector<Expr> built;
    for (const Tree& a : args) built.push_back(a.build());
    return Expr::make(op, built);
  }

  std::string text() const {
    if (isLeaf()) return variable < 0 ? sdf::text(value) : std::string(1, "xyz"[variable]);
    std::string s = std::string(info(op).name) + "(";
    for (const Tree& a : args) s += (&a == args.data() ? "" : ", ") + a.text();
    return s + ")";
  }

  /// Every tree that is this one with one part replaced by one of its own arguments or by a plain leaf.
  std::vector<Tree> smaller() const {
    std::vector<Tree> all = args;
    if (!isLeaf()) {
      all.push_back(Tree{Op::Constant, -1, 1.0, {}});
      all.push_back(Tree{Op::Constant, 0, 0.0, {}});
    }
    for (std::size_t i = 0; i < args.size(); ++i)
      for (Tree& a : args[i].smaller()) {
        all.push_back(*this);
        all.back().args[i] = std::move(a);
      }
    return all;
  }
};

/// What a check finds wrong with a tree, if anything.
using Check = std::function<std::optional<std::string>(const Tree&, Adversary)>;

void expectForRandomTrees(int trials, const Check& check) {
  for (int trial = 0; trial < trials; ++trial) {
    Adversary adversary(trial);
    Tree tree = Tree::random(adversary, 1 + trial % 5);
    std::optional<std::string> wrong = check(tree, adversary);
    if (!wrong) continue;
    for (bool shrunk = true; shrunk;) {
      shrunk = false;
      for (const Tree& candidate : tree.smaller())
        if (auto still = check(candidate, adversary)) {
          tree = candidate, wrong = still, shrunk = true;
          break;
        }
    }
    FAIL() << "trial " << trial << ", smallest failing expression: " << tree.text() << "\n" << *wrong;
  }
}

std::array<double, 3> somePoint(Adversary& adversary) {
  const double size = std::ldexp(1.0, adversary.below(8) - 4);
  std::array<double, 3> p;
  for (double& c : p) c = adversary.below(3) == 0 ? adversary.moderate() : adversary.dyadic(4) * size;
  return p;
}

std::string pointText(const std::array<double, 3>& p) {
  return "(" + text(p[0]) + ", " + text(p[1]) + ", " + text(p[2]) + ")";
}

constexpr int kTrials = 20000, kPoints = 12;

TEST(Facts, TheRangeContainsEverySample) {
  expectForRandomTrees(kTrials, [](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = tree.build();
    for (int i = 0; i < kPoints; ++i) {
      const auto p = somePoint(adversary);
      const double v = evaluateGraph(e, p[0], p[1], p[2]);
      if (!e.range().contains(v)) return text(v) + " at " + pointText(p) + " outside " + text(e.range());
    }
    return std::nullopt;
  });
}

TEST(Facts, TheIntervalReadingContainsEverySampleOfABox) {
  expectForRandomTrees(kTrials, [](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = tree.build();
    std::array<Interval, kVariableCount> box;
    const auto a = somePoint(adversary), b = somePoint(adversary);
    for (int i = 0; i < 3; ++i) box[i] = {std::min(a[i], b[i]), std::max(a[i], b[i])};
    const Interval range = evaluateGraph<Interval>(e, box, [](double v) { return Interval(v); });
    for (int i = 0; i < kPoints; ++i) {
      const double x = adversary.inside(box[0]), y = adversary.inside(box[1]), z = adversary.inside(box[2]);
      const double v = evaluateGraph(e, x, y, z);
      if (!range.contains(v)) return text(v) + " at " + pointText({x, y, z}) + " outside " + text(range);
    }
    return std::nullopt;
  });
}

// The values at p and q are only known as enclosures, so what is compared is the gap between those.
std::optional<std::string> steeper(const Expr& e, const std::array<double, 3>& p,
                                   const std::array<double, 3>& q, double slope) {
  const Interval a = enclosureAt(e, p), b = enclosureAt(e, q);
  if (a.nan || b.nan) return std::nullopt;
  const double gap = std::max(a.lo - b.hi, b.lo - a.hi),
               distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  if (!(gap > slope * distance * (1.0 + 4.0 * kEpsilon))) return std::nullopt;
  return "between " + pointText(p) + " and " + pointText(q) + " it changes by " + text(gap) +
         " over a distance of " + text(distance) + ", slope " + text(gap / distance) +
         " against a bound of " + text(slope);
}

TEST(Facts, TheSlopeBoundHoldsBetweenAnyTwoPoints) {
  int bounded = 0;
  expectForRandomTrees(kTrials, [&](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = tree.build();
    if (e.lipschitz() == kInf) return std::nullopt;
    ++bounded;
    for (int i = 0; i < kPoints; ++i) {
      const auto p = somePoint(adversary);
      auto q = somePoint(adversary);
      if (i % 2)  // near each other, where slopes show
        for (int k = 0; k < 3; ++k) q[k] = p[k] + std::ldexp(q[k], -12);
      if (auto wrong = steeper(e, p, q, e.lipschitz())) return wrong;
    }
    return std::nullopt;
  });
  EXPECT_GT(bounded, kTrials / 4) << "too few expressions have a bound for the test to mean much";
}

TEST(Facts, SlopesOverABoxHoldBetweenAnyTwoOfItsPoints) {
  using D = Dual<Interval, 3>;
  int bounded = 0;
  expectForRandomTrees(kTrials, [&](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = tree.build();
    std::array<D, kVariableCount> box{};
    const auto a = somePoint(adversary), b = somePoint(adversary);
    for (int i = 0; i < 3; ++i) {
      box[i].v = {std::min(a[i], b[i]), std::max(a[i], b[i])};
      box[i].d[i] = Interval(1.0);
    }
    const D r = evaluateGraph<D>(e, box, [](double v) { return constant<Interval, 3>(v); });
    const double slope = std::hypot(r.d[0].magnitude(), r.d[1].magnitude(), r.d[2].magnitude());
    if (slope == kInf) return std::nullopt;
    ++bounded;
    for (int i = 0; i < kPoints; ++i) {
      std::array<double, 3> p, q;
      for (int k = 0; k < 3; ++k) p[k] = adversary.inside(box[k].v), q[k] = adversary.inside(box[k].v);
      if (auto wrong = steeper(e, p, q, slope)) return wrong;
    }
    return std::nullopt;
  });
  EXPECT_GT(bounded, kTrials / 2) << "too few expressions have a bound for the test to mean much";
}

TEST(Facts, SlopesSurviveAMapOfKnownStretch) {
  // A rotation by the angle of the 3-4-5 triangle, scaled by 2.5 and moved: exact in doubles but for
  // rounding.
  const Expr x = Expr::variable(Variable::X), y = Expr::variable(Variable::Y),
             z = Expr::variable(Variable::Z);
  const std::array<Expr, 3> map = {x * 1.5 - y * 2.0 + 1.0, x * 2.0 + y * 1.5, z * 2.5 - 0.5};
  expectForRandomTrees(kTrials / 2, [&](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = remap(tree.build(), map, 2.5);
    if (e.lipschitz() == kInf) return std::nullopt;
    for (int i = 0; i < kPoints; ++i)
      if (auto wrong = steeper(e, somePoint(adversary), somePoint(adversary), e.lipschitz())) return wrong;
    return std::nullopt;
  });
}

TEST(Facts, PartialDerivativesEncloseTheChangeAlongEachAxis) {
  int bounded = 0;
  expectForRandomTrees(kTrials, [&](const Tree& tree, Adversary adversary) -> std::optional<std::string> {
    const Expr e = tree.build();
    for (int axis = 0; axis < 3; ++axis) {
      const double slope = e.partials()[axis].magnitude();
      if (slope == kInf) continue;
      ++bounded;
      for (int i = 0; i < kPoints; ++i) {
        const auto p = somePoint(adversary);
        auto q = p;
        q[axis] = somePoint(adversary)[axis];
        if (auto wrong = steeper(e, p, q, slope)) return wrong;
      }
    }
    return std::nullopt;
  });
  EXPECT_GT(bounded, kTrials) << "too few expressions have a bound for the test to mean much";
}

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);
constexpr double kFewRoundings = 1e-14;

TEST(Facts, SlopesAlongDifferentAxesAddAsSidesOfABox) {
  EXPECT_NEAR((sin(kX) + sin(kY) + sin(kZ)).lipschitz(), std::sqrt(3.0), kFewRoundings);
  EXPECT_NEAR((3.0 * kX - 4.0 * kY).lipschitz(), 5.0, 5.0 * kFewRoundings);
  EXPECT_NEAR((kX + kY - kX).lipschitz(), 1.0, kFewRoundings);
}

TEST(Facts, AClaimBoundsThePartialDerivatives) {
  const Expr e = (3.0 * kX - 4.0 * kY).claimLipschitz(2.0);
  EXPECT_EQ(e.lipschitz(), 2.0);
  EXPECT_EQ(e.partials()[0].lo, 2.0);
  EXPECT_EQ(e.partials()[1].hi, -2.0);
  EXPECT_EQ(e.partials()[2].magnitude(), 0.0);
}

TEST(Stretch, IsTheLargestOfScalingsAlongTheAxes) {
  EXPECT_EQ(stretchOf({kX, kY, kZ}), 1.0);
  EXPECT_NEAR(stretchOf({2.0 * kX, kY * -3.0, kZ}), 3.0, 3.0 * kFewRoundings);
  EXPECT_EQ(stretchOf({Expr(1.0), Expr(2.0), Expr(3.0)}), 0.0);
}

TEST(Stretch, OfATurnIsOneAndOfAShearItsSingularValue) {
  const Expr x = kX * 0.6 - kY * 0.8, y = kX * 0.8 + kY * 0.6;
  EXPECT_NEAR(stretchOf({x, y, kZ}), 1.0, kFewRoundings);
  EXPECT_NEAR(length(x, y, kZ).lipschitz(), 1.0, kFewRoundings);
  EXPECT_NEAR(stretchOf({kX + kY, kY, kZ}), 0.5 * (1.0 + std::sqrt(5.0)), 2.0 * kFewRoundings);
}

TEST(Stretch, BoundsWhatMapsWithoutOneDerivativeDo) {
  // By the slopes of each; by what the midpoints of the derivatives do and the most that they are off by.
  EXPECT_NEAR(stretchOf({2.0 * kX + sin(kY), 0.0, 0.0}), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(stretchOf({100.0 * kX + sin(kY), 100.0 * kY, 100.0 * kZ}), 101.0, 1e-10);
  EXPECT_EQ(stretchOf({square(kX), kY, kZ}), kInf);
}

}  // namespace lipschitz_facts_test
}  // namespace sdf
