// Every operation over intervals: contains each sample, flags NaN where one is possible, and is no wider than
// it need be.
#include "sdf/number/interval.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "number/adversary.h"
#include "sdf/expr/apply-inl.h"
#include "sdf/number/scalar.h"

namespace sdf {
namespace interval_test {

double valueOf(Op op, const std::vector<double>& x) {
  return evaluateOp<double>(op, [&](int i) { return x[i]; });
}
Interval rangeOf(Op op, const std::vector<Interval>& x) {
  return evaluateOp<Interval>(op, [&](int i) { return x[i]; });
}

/// Arguments of `op`, each drawn by `draw`; those that are always constants are points.
template <class Draw>
std::vector<Interval> arguments(Op op, const Draw& draw) {
  std::vector<Interval> args;
  for (int i = 0; i < arity(op); ++i) {
    const Interval a = draw();
    args.push_back(i < rowArguments(op) ? a : Interval(a.lo));
  }
  return args;
}

TEST(Interval, ContainsTheValueOfEverySample) {
  constexpr int kTrials = 10000, kSamples = 24;
  for (const Op op : operations())
    for (int trial = 0; trial < kTrials; ++trial) {
      Adversary adversary(trial);
      const auto box = arguments(op, [&] { return adversary.hostileInterval(); });
      const Interval range = rangeOf(op, box);
      ASSERT_LE(range.lo, range.hi) << "trial " << trial << ": " << text(op, box) << " = " << text(range);
      for (int sample = 0; sample < kSamples; ++sample) {
        std::vector<double> x;
        for (const Interval& a : box) x.push_back(adversary.inside(a));
        const double y = valueOf(op, x);
        ASSERT_TRUE(range.contains(y)) << "trial " << trial << ": " << text(op, x) << " = " << text(y)
                                       << "\nover " << text(op, box) << " = " << text(range);
      }
    }
}

TEST(Interval, ContainsWhatAFusedMultiplyAddYields) {
  for (int trial = 0; trial < 100000; ++trial) {
    Adversary adversary(trial);
    const double a = adversary.hostile(), b = adversary.hostile(), c = adversary.hostile();
    ASSERT_TRUE(mulAdd(Interval(a), Interval(b), Interval(c)).contains(std::fma(a, b, c)) ||
                std::isnan(a * b + c))  // an overflow that only the rounded product has
        << "trial " << trial << ": " << text(Op::MulAdd, std::vector{a, b, c});
    ASSERT_TRUE(squareAdd(Interval(a), Interval(c)).contains(std::fma(a, a, c)) || std::isnan(a * a + c))
        << "trial " << trial << ": " << text(a) << " squared plus " << text(c);
  }
}

// Smallest and largest value among the neighbours of a point: what rounding of the arguments alone could do.
double spreadAround(Op op, const std::vector<double>& x, Adversary& adversary) {
  double lo = valueOf(op, x), hi = lo;
  for (int sample = 0; sample < 64; ++sample) {
    std::vector<double> near = x;
    for (double& v : near) v = stepped(v, adversary.below(17) - 8);
    const double y = valueOf(op, near);
    lo = std::min(lo, y), hi = std::max(hi, y);
  }
  return hi - lo;
}

TEST(Interval, OfAPointIsAsNarrowAsRounding) {
  // Each end of each operation moves by at most 2 ulp, the longest fused operation is a chain of four, and
  // mod adds 4 ulp of its first argument at either end.
  constexpr double kUlps = 16.0;
  constexpr double kLargest = 1e9;      // beyond it waves say no more than [-1, 1]
  constexpr double kSmallest = 1e-150;  // below it squares and quotients underflow, and mod is next to a jump
  for (const Op op : operations())
    for (int trial = 0; trial < 5000; ++trial) {
      Adversary adversary(trial);
      std::vector<double> x;
      std::vector<Interval> box;
      double scale = std::numeric_limits<double>::min();
      for (int i = 0; i < arity(op); ++i) {
        x.push_back(std::clamp(adversary.hostile(), -kLargest, kLargest));
        if (std::abs(x.back()) < kSmallest) x.back() = 0.0;
        box.emplace_back(x.back());
        scale = std::max(scale, std::abs(x.back()));
      }
      const double y = valueOf(op, x);
      if (!std::isfinite(y)) continue;
      const Interval range = rangeOf(op, box);
      const double spread = spreadAround(op, x, adversary);
      if (spread > std::abs(y) && spread > 1.0) continue;  // a jump or a pole is next door
      const double allowed = kUlps * kEpsilon * (scale + std::abs(y)) + 2.0 * spread;
      ASSERT_LE(range.width(), allowed) << "trial " << trial << ": " << text(op, x) << " = " << text(range);
    }
}

// Members of an interval where extremes are likely: its ends (first), what is next to them, even steps
// between, zeros, ones, crests and poles.
// In `box` lie the other arguments, whose ends matter to comparisons.
std::vector<double> candidates(const Interval& a, const std::vector<Interval>& box) {
  std::vector<double> all = {a.lo, a.hi, 0.0, -0.0};
  for (const Interval& b : box) all.push_back(b.lo), all.push_back(b.hi);
  for (int i = 1; i < 10; ++i) all.push_back(stepped(a.lo, i)), all.push_back(stepped(a.hi, -i));
  for (int i = 1; i < 24; ++i) all.push_back(a.lo + a.width() * i / 24.0);
  for (int i = -3; i <= 3; ++i)
    for (int near = -1; near <= 1; ++near) all.push_back(stepped(i * kHalfPi, near));
  for (int i = -4; i <= 4; ++i) all.push_back(i), all.push_back(stepped(i, -1));
  std::erase_if(all, [&](double x) { return !(a.lo <= x && x <= a.hi); });
  return all;
}

struct Sampled {
  double lo = kInf, hi = -kInf;
  bool nan = false;
};

// All pairs of candidates; for more arguments, so many draws, half of them among ends and zeros.
Sampled sampled(Op op, const std::vector<Interval>& box, Adversary& adversary) {
  constexpr std::size_t kDraws = 2500;
  std::vector<std::vector<double>> choices;
  for (const Interval& a : box) choices.push_back(candidates(a, box));
  std::vector<double> x(box.size());
  std::size_t pairs = choices[0].size() * (x.size() > 1 ? choices[1].size() : 1);
  Sampled s;
  for (std::size_t draw = 0; draw < (rowArguments(op) > 2 ? kDraws : pairs); ++draw) {
    x[0] = choices[0][draw % choices[0].size()];
    if (x.size() > 1) x[1] = choices[1][draw / choices[0].size() % choices[1].size()];
    for (std::size_t i = rowArguments(op) > 2 ? 0 : 2; i < x.size(); ++i) {
      const int few = std::min<int>(4, choices[i].size());
      x[i] = choices[i][adversary.below(2) ? adversary.below(few) : adversary.below(choices[i].size())];
    }
    const double y = valueOf(op, x);
    s.nan = s.nan || std::isnan(y);
    if (!std::isnan(y)) s.lo = std::min(s.lo, y), s.hi = std::max(s.hi, y);
  }
  return s;
}

// Boxes over which an operation is documented to give up.
bool isLoose(Op op, const std::vector<Interval>& box) {
  if (op == Op::Mod) return !box[1].isPoint();
  if (op != Op::Pow || box[0].lo >= 0.0) return false;
  const bool integers = std::floor(box[1].hi) >= box[1].lo && !box[1].isPoint();
  return integers || box[0].lo == -kInf || std::isinf(box[1].magnitude());
}

std::vector<double> centres(const std::vector<Interval>& box) {
  std::vector<double> x;
  for (const Interval& a : box) x.push_back(a.lo + a.width() / 2.0);
  return x;
}

TEST(Interval, IsHardlyWiderThanItsSamples) {
  constexpr double kBetweenSamples = 0.12;  // extremes may lie between 24 even steps
  constexpr double kPole = 1e15;            // no double comes nearer to a pole of tan
  for (const Op op : operations())
    for (int trial = 0; trial < (arity(op) < 3 ? 600 : 60); ++trial) {
      Adversary adversary(trial);
      const auto box =
          arguments(op, [&] { return adversary.interval([&] { return adversary.moderate(); }); });
      if (isLoose(op, box)) continue;
      const Interval range = rangeOf(op, box);
      std::vector<Interval> around = box;  // a crease next door counts as inside
      for (Interval& a : around) a = {stepped(a.lo, -4), stepped(a.hi, 4)};
      const Sampled s = sampled(op, around, adversary);
      const std::string what = "trial " + std::to_string(trial) + ": " + text(op, box) + " = " + text(range) +
                               "\nbut samples lie within " + text(Interval(s.lo, s.hi, s.nan));
      ASSERT_LE(range.nan, s.nan) << what;
      if (std::isnan(valueOf(op, centres(box)))) continue;  // a domain that ends next door is not inside
      const double slack = 16.0 * kEpsilon * (8.0 + std::abs(s.lo) + std::abs(s.hi));
      const double gap = s.hi - s.lo < kInf ? kBetweenSamples * (s.hi - s.lo) + slack : slack;
      if (s.lo <= -kPole || s.hi >= kPole) continue;
      ASSERT_GE(range.lo, s.lo - gap) << what;
      ASSERT_LE(range.hi, s.hi + gap) << what;
    }
}

TEST(Interval, FlagsNaNOnlyWhereASampleIsNaN) {
  for (const Op op : operations())
    for (int trial = 0; trial < (arity(op) < 3 ? 2000 : 200); ++trial) {
      Adversary adversary(trial);
      const auto box = arguments(op, [&] {
        Interval i = adversary.hostileInterval();
        i.nan = false;
        return i;
      });
      if (isLoose(op, box) || !rangeOf(op, box).nan) continue;
      ASSERT_TRUE(sampled(op, box, adversary).nan) << "trial " << trial << ": " << text(op, box);
    }
}

TEST(Interval, OfANaNHoldsNaNAndLetsEveryOperationGoOn) {
  const Interval nan(kNaN);
  EXPECT_TRUE(nan.contains(kNaN));
  EXPECT_FALSE(nan.isPoint());
  EXPECT_TRUE(min(nan, Interval(3.0)).contains(3.0));
  EXPECT_TRUE(max(nan, Interval(3.0)).contains(3.0));
  EXPECT_TRUE(hull(nan, Interval(3.0)).contains(3.0));
  EXPECT_TRUE(less(nan, Interval(3.0)).contains(0.0));
}

TEST(Interval, HullContainsBoth) {
  for (int trial = 0; trial < 1000; ++trial) {
    Adversary adversary(trial);
    const Interval a = adversary.hostileInterval(), b = adversary.hostileInterval();
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(hull(a, b).contains(adversary.inside(a))) << text(a) << text(b);
      ASSERT_TRUE(hull(a, b).contains(adversary.inside(b))) << text(a) << text(b);
    }
  }
}

TEST(Interval, MagnitudeIsTheLargestAbsoluteValue) {
  EXPECT_EQ(Interval(-3.0, 2.0).magnitude(), 3.0);
  EXPECT_EQ(Interval(-3.0, 5.0).magnitude(), 5.0);
  EXPECT_EQ(Interval::everything().magnitude(), kInf);
}

TEST(Interval, SelectFollowsADecidedConditionNaNIncluded) {
  const Interval a(1.0, 2.0), b(5.0, 6.0);
  EXPECT_EQ(select(Interval(1.0), a, b).hi, 2.0);
  EXPECT_EQ(select(Interval(0.0), a, b).lo, 5.0);
  // NaN differs from 0, so it selects the first.
  EXPECT_EQ(select(Interval(1.0, 3.0, true), a, b).hi, 2.0);
  EXPECT_EQ(select(Interval(0.0, 1.0), a, b).lo, 1.0);
  EXPECT_EQ(select(Interval(0.0, 1.0), a, b).hi, 6.0);
}

}  // namespace interval_test
}  // namespace sdf
