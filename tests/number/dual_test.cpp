// Every operation on duals: derivatives against differences, their declared values at kinks, and over
// intervals their enclosure of every difference quotient.
#include "sdf/number/dual-inl.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "number/adversary.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace dual_test {

using Numbers = std::vector<double>;

double valueOf(Op op, const Numbers& x) {
  return evaluateOp<double>(op, [&](int i) { return x[i]; });
}

/// The value and the derivative along `direction`.
Dual<double, 1> along(Op op, const Numbers& x, const Numbers& direction) {
  return evaluateOp<Dual<double, 1>>(op, [&](int i) { return Dual<double, 1>{x[i], {direction[i]}}; });
}

Numbers moved(const Numbers& x, const Numbers& direction, double t) {
  Numbers y = x;
  for (std::size_t i = 0; i < x.size(); ++i) y[i] += direction[i] * t;
  return y;
}

TEST(Dual, EqualsCentralDifferencesOffKinks) {
  constexpr int kTrials = 2000;
  const double step = std::cbrt(kEpsilon);  // balances the third derivative against rounding
  for (const Op op : operations()) {
    int compared = 0, usable = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      Adversary adversary(trial);
      Numbers x, direction;
      for (int i = 0; i < arity(op); ++i) {
        // Not so near 0 that quotients turn within a step.
        const double size = adversary.uniform(0.05, adversary.below(2) ? 0.9 : 3.0);
        x.push_back(adversary.below(3) == 0 ? -size : size);
        direction.push_back(adversary.uniform(-1.0, 1.0));
      }
      const auto difference = [&](double h) {
        return (valueOf(op, moved(x, direction, h)) - valueOf(op, moved(x, direction, -h))) / (2.0 * h);
      };
      const double coarse = difference(2.0 * step), fine = difference(step);
      if (!std::isfinite(coarse) || !std::isfinite(fine)) continue;
      ++usable;
      const Dual<double, 1> dual = along(op, x, direction);
      ASSERT_EQ(dual.v, valueOf(op, x)) << "trial " << trial << ": " << text(op, x);
      // The two differences err by 4 : 1, and each by rounding of the values and of the moved arguments.
      const double rounding = 4.0 * kEpsilon * (3.0 + std::abs(dual.v)) * (1.0 + std::abs(fine)) / step;
      const double tolerance = std::abs(coarse - fine) + rounding;
      ASSERT_NEAR(dual.d[0], fine, tolerance)
          << "trial " << trial << ": " << text(op, x) << " along " << text(op, direction);
      compared += tolerance < 1e-4 * (1.0 + std::abs(fine));
    }
    // Kinks and jumps fall between the differences in few trials only.
    EXPECT_GT(compared, 0.9 * usable) << info(op).name;
    EXPECT_GT(usable, kTrials / 5) << info(op).name;
  }
}

double slope1(Op op, double x) { return along(op, {x}, {1.0}).d[0]; }

TEST(Dual, TakesTheDeclaredSlopeAtKinks) {
  EXPECT_EQ(slope1(Op::Sqrt, 0.0), 0.0);
  EXPECT_EQ(slope1(Op::Abs, 0.0), 1.0);
  EXPECT_EQ(slope1(Op::Asin, 1.0), 0.0);
  EXPECT_EQ(slope1(Op::Asin, -1.0), 0.0);
  EXPECT_EQ(slope1(Op::Acos, 1.0), 0.0);
  EXPECT_EQ(along(Op::Pow, {0.0, 0.5}, {1.0, 0.0}).d[0], 0.0);
  EXPECT_EQ(along(Op::Pow, {0.0, 1.0}, {1.0, 0.0}).d[0], 1.0);
  EXPECT_EQ(along(Op::Pow, {0.0, 0.0}, {1.0, 0.0}).d[0], 0.0);
  EXPECT_EQ(along(Op::Pow, {-2.0, 3.0}, {1.0, 0.0}).d[0], 12.0);
  EXPECT_EQ(along(Op::Atan2, {0.0, 0.0}, {1.0, 1.0}).d[0], 0.0);
  for (const Op op : {Op::Floor, Op::Ceil, Op::Round}) EXPECT_EQ(slope1(op, 2.0), 0.0) << info(op).name;
  for (const Op op : {Op::Less, Op::LessEqual, Op::Equal})
    EXPECT_EQ(along(op, {2.0, 2.0}, {1.0, 0.0}).d[0], 0.0) << info(op).name;
}

TEST(Dual, MinAndMaxFollowTheArgumentThatGivesTheValueAndOnATieTheFirst) {
  for (const Op op : {Op::Min, Op::Max}) {
    const bool isMin = op == Op::Min;
    EXPECT_EQ(along(op, {1.0, 2.0}, {10.0, 20.0}).d[0], isMin ? 10.0 : 20.0);
    EXPECT_EQ(along(op, {2.0, 1.0}, {10.0, 20.0}).d[0], isMin ? 20.0 : 10.0);
    EXPECT_EQ(along(op, {1.0, 1.0}, {10.0, 20.0}).d[0], 10.0);
    EXPECT_EQ(along(op, {kNaN, 1.0}, {10.0, 20.0}).d[0], 20.0);
  }
}

TEST(Dual, HasAFiniteSlopeWhereverTheValueIsFinite) {
  for (const Op op : operations())
    for (int trial = 0; trial < 5000; ++trial) {
      Adversary adversary(trial);
      Numbers x, direction;
      for (int i = 0; i < arity(op); ++i) {
        x.push_back((adversary.below(9) - 4) * 0.5);
        direction.push_back(adversary.below(3) - 1);
      }
      const Dual<double, 1> dual = along(op, x, direction);
      ASSERT_TRUE(std::isfinite(dual.d[0]) || !std::isfinite(dual.v))
          << "trial " << trial << ": " << text(op, x) << " along " << text(op, direction);
    }
}

// Straight paths x + t * direction, t in [0, 1], of numbers so short that every point of them is exact.
struct Path {
  Numbers start, direction;

  Path(Op op, Adversary& adversary) {
    for (int i = 0; i < arity(op); ++i) {
      const bool moves = i < rowArguments(op) && adversary.below(4) != 0;
      start.push_back(adversary.below(2) ? adversary.below(9) - 4 : adversary.dyadic(4));
      direction.push_back(moves ? adversary.dyadic(adversary.below(2) + 1) : 0.0);
    }
  }
  Dual<Interval, 1> over(Op op) const {
    return evaluateOp<Dual<Interval, 1>>(op, [&](int i) {
      const double end = start[i] + direction[i];
      return Dual<Interval, 1>{Interval(std::min(start[i], end), std::max(start[i], end)),
                               {Interval(direction[i])}};
    });
  }
};

TEST(Dual, OverIntervalsEnclosesEveryDifferenceQuotientJumpsIncluded) {
  for (const Op op : operations())
    for (int trial = 0; trial < 3000; ++trial) {
      Adversary adversary(trial);
      const Path path(op, adversary);
      const Dual<Interval, 1> enclosure = path.over(op);
      for (int sample = 0; sample < 30; ++sample) {
        const double s = adversary.below(1025) / 1024.0, t = adversary.below(1025) / 1024.0;
        const Numbers p = moved(path.start, path.direction, s), q = moved(path.start, path.direction, t);
        const double a = valueOf(op, p), b = valueOf(op, q), quotient = (b - a) / (t - s);
        if (s == t || std::isnan(quotient)) continue;
        // Values are off by some ulps of themselves, and by as much of the largest argument where a sum
        // cancels.
        const double size = std::abs(a) + std::abs(b);
        const double slack = size < kInf ? 16.0 * kEpsilon * (8.0 + size) / std::abs(t - s) : 0.0;
        ASSERT_TRUE(enclosure.d[0].lo <= quotient + slack && quotient - slack <= enclosure.d[0].hi)
            << "trial " << trial << ": " << text(op, p) << " = " << text(a) << "\nand " << text(op, q)
            << " = " << text(b) << "\nquotient " << text(quotient) << " outside " << text(enclosure.d[0]);
      }
    }
}

TEST(Dual, OverIntervalsEnclosesEveryDerivative) {
  for (const Op op : operations())
    for (int trial = 0; trial < 3000; ++trial) {
      Adversary adversary(trial);
      const Path path(op, adversary);
      const Dual<Interval, 1> enclosure = path.over(op);
      for (int sample = 0; sample < 20; ++sample) {
        const Numbers p = moved(path.start, path.direction, adversary.below(1025) / 1024.0);
        const Dual<double, 1> dual = along(op, p, path.direction);
        if (!std::isfinite(dual.v) || !std::isfinite(dual.d[0])) continue;
        const double slack = 16.0 * kEpsilon * (8.0 + std::abs(dual.d[0]));
        ASSERT_TRUE(enclosure.v.contains(dual.v));
        ASSERT_TRUE(enclosure.d[0].lo <= dual.d[0] + slack && dual.d[0] - slack <= enclosure.d[0].hi)
            << "trial " << trial << ": " << text(op, p) << " has slope " << text(dual.d[0]) << " outside "
            << text(enclosure.d[0]);
      }
    }
}

TEST(Dual, OverIntervalsIsTightEnoughToBeOfUse) {
  using D = Dual<Interval, 1>;
  const D x{Interval(-1.0, 1.0), {Interval(1.0)}};
  const double slack = 8.0 * kEpsilon;
  EXPECT_LE(pow(x, constant<Interval, 1>(3.0)).d[0].magnitude(), 3.0 + slack);
  EXPECT_LE(square(x).d[0].magnitude(), 2.0 + slack);
  EXPECT_LE(sin(x).d[0].hi, 1.0 + slack);
  EXPECT_LE(abs(x).d[0].magnitude(), 1.0);
  EXPECT_LE(min(x, neg(x)).d[0].magnitude(), 1.0);
  EXPECT_EQ(floor(D{Interval(0.1, 0.9), {Interval(1.0)}}).d[0].magnitude(), 0.0);
  EXPECT_EQ(mod(D{Interval(0.5, 7.5), {Interval(1.0)}}, constant<Interval, 1>(8.0)).d[0].magnitude(), 1.0);
}

TEST(Dual, WhatDoesNotMoveDoesNotJump) {
  using D = Dual<Interval, 1>;
  const D still = constant<Interval, 1>(Interval(0.0, 5.0)), x{Interval(-1.0, 1.0), {Interval(1.0)}};
  EXPECT_EQ(floor(still).d[0].magnitude(), 0.0);
  EXPECT_EQ(less(still, constant<Interval, 1>(Interval(2.0))).d[0].magnitude(), 0.0);
  EXPECT_EQ(mod(still, constant<Interval, 1>(Interval(2.0))).d[0].magnitude(), 0.0);
  EXPECT_LE(select(floor(still), x, neg(x)).d[0].magnitude(), 1.0);
}

}  // namespace dual_test
}  // namespace sdf
