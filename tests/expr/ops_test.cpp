// What ops.def says of the operations, held to their values.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "number/adversary.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace ops_test {

using Arguments = std::array<double, kMaxArity>;

double valueOf(Op op, const Arguments& x) {
  return evaluateOp<double>(op, [&](int i) { return x[i]; });
}

/// Within [-4, 4], and often a multiple of a half.
double plain(Adversary& random) {
  return random.below(2) == 0 ? (random.below(17) - 8) * 0.5 : random.uniform(-4.0, 4.0);
}
Arguments allPlain(Adversary& random) {
  Arguments x;
  for (double& a : x) a = plain(random);
  return x;
}
/// Infinities, NaN and all.
Arguments hostile(Adversary& random) {
  Arguments x;
  for (double& a : x) a = random.below(8) == 0 ? kNaN : random.hostile();
  return x;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Does it hold in every trial?
template <class Holds>
bool always(const Holds& holds) {
  for (int trial = 0; trial < 2000; ++trial) {
    Adversary random(trial);
    if (!holds(random)) return false;
  }
  return true;
}

TEST(Ops, EachHasARow) {
  std::set<std::string_view> names;
  for (const OpInfo& row : kOps) EXPECT_TRUE(names.insert(row.name).second) << row.name;
  EXPECT_FALSE(names.contains(""));
  for (const Op op : operations()) {
    EXPECT_GE(rowArguments(op), 1) << info(op).name;
    EXPECT_LE(arity(op), kMaxArity) << info(op).name;
  }
}

TEST(Ops, GlslNamesEachArgument) {
  for (const Op op : operations()) {
    const OpInfo& row = info(op);
    EXPECT_EQ(row.glsl.empty(), row.fused) << row.name;
    std::set<int> named, all;
    for (std::size_t at = row.glsl.find('$'); at != std::string_view::npos; at = row.glsl.find('$', at + 1))
      named.insert(row.glsl.at(at + 1) - '0');
    for (int i = 0; i < row.arity && !row.fused; ++i) all.insert(i);
    EXPECT_EQ(named, all) << row.name;
  }
}

// Does the slope along the `place`-th axis jump nowhere, or only where several arguments are 0? Where it
// jumps, it does over any distance.
bool isSmooth(Op op, int place) {
  return always([&](Adversary& random) {
    const int rows = rowArguments(op);
    Arguments x = allPlain(random);
    for (int i = rows; i < arity(op); ++i) x[i] = random.uniform(-4.0, 4.0);
    const auto at = [&](double step) {
      Arguments moved = x;
      moved[place] += step;
      return valueOf(op, moved);
    };
    const auto bend = [&](double step) { return std::abs(at(step) - 2.0 * at(0.0) + at(-step)) / step; };
    const bool isZero =
        rows > 1 && std::all_of(x.begin(), x.begin() + rows, [](double a) { return std::abs(a) < 1e-3; });
    return isZero || !std::isfinite(at(0.0)) || !(bend(1e-5) > 0.01) || bend(1e-6) < 0.5 * bend(1e-5);
  });
}

TEST(Ops, SmoothOnesHaveNoKinks) {
  for (const Op op : operations())
    for (int i = 0; i < rowArguments(op) && info(op).smoothness == Smoothness::Smooth; ++i)
      EXPECT_TRUE(isSmooth(op, i)) << info(op).name;
  for (const Op op : {Op::Abs, Op::Floor, Op::Round, Op::Min, Op::Max, Op::Mod, Op::AbsMinus})
    EXPECT_FALSE(isSmooth(op, 0)) << info(op).name;
}

// Is the value a sum of multiples of the arguments from `first` to `last` while the others are held?
bool isLinear(Op op, int first, int last) {
  return always([&](Adversary& random) {
    const Arguments x = allPlain(random);
    Arguments y = x, sum = x;
    const double s = random.uniform(-2.0, 2.0), t = random.uniform(-2.0, 2.0);
    for (int i = first; i <= last; ++i) {
      y[i] = plain(random);
      sum[i] = s * x[i] + t * y[i];
    }
    const double expected = s * valueOf(op, x) + t * valueOf(op, y), got = valueOf(op, sum);
    return !(std::abs(got - expected) > 1e-9 * (1.0 + std::abs(expected)));
  });
}

TEST(Ops, LinearityIsWhatTheValuesHave) {
  for (const Op op : operations()) {
    const bool isBinary = arity(op) == 2 && !info(op).fused;
    const bool inFirst = isBinary && isLinear(op, 0, 0), inSecond = isBinary && isLinear(op, 1, 1);
    const Linearity measured = isLinear(op, 0, arity(op) - 1) ? Linearity::Linear
                               : inFirst && inSecond          ? Linearity::Bilinear
                               : inFirst                      ? Linearity::LinearInFirst
                                                              : Linearity::Nonlinear;
    EXPECT_EQ(measured, info(op).linearity) << info(op).name;
  }
}

TEST(Ops, IncreasingOnesNeverFall) {
  for (const Op op : operations()) {
    const Increasing increasing = info(op).increasing;
    if (increasing == Increasing::Unstated) continue;
    for (int place = 0; place < (increasing == Increasing::First ? 1 : 2); ++place)
      EXPECT_TRUE(always([&](Adversary& random) {
        Arguments x = allPlain(random);
        if (increasing == Increasing::BothIfPositive) x[1 - place] = std::abs(x[1 - place]);
        const double before = valueOf(op, x);
        x[place] += random.uniform(0.0, 1.0);
        return !(valueOf(op, x) < before);
      })) << info(op).name;
  }
}

TEST(Ops, NonexpansiveOnesAndChoicesHaveASlopeOfOneAtMost) {
  for (const Op op : operations()) {
    if (info(op).slope != Slope::Nonexpansive && !isMinOrMax(op)) continue;
    EXPECT_TRUE(always([&](Adversary& random) {
      const Arguments x = allPlain(random), y = allPlain(random);
      double most = 0.0;
      for (int i = 0; i < arity(op); ++i) most = std::max(most, std::abs(x[i] - y[i]));
      return std::abs(valueOf(op, x) - valueOf(op, y)) <= most;
    })) << info(op).name;
  }
}

TEST(Ops, EvenOnesDoNotSeeTheSign) {
  for (const Op op : operations()) {
    if (info(op).parity != Parity::Even) continue;
    EXPECT_TRUE(always([&](Adversary& random) {
      const double x = hostile(random)[0];
      return same(valueOf(op, {x}), valueOf(op, {-x})) && same(valueOf(op, {x}), valueOf(op, {std::abs(x)}));
    })) << info(op).name;
  }
}

TEST(Ops, NeutralOnesLeaveTheFirstArgument) {
  for (const Op op : operations()) {
    const double neutral = info(op).neutral;
    if (std::isnan(neutral)) continue;
    EXPECT_TRUE(always([&](Adversary& random) {
      const double x = hostile(random)[0];
      return same(valueOf(op, {x, neutral}), x);
    })) << info(op).name;
  }
}

TEST(Ops, SymmetryIsWhatTheValuesHave) {
  for (const Op op : operations()) {
    const bool measured = arity(op) == 2 && always([&](Adversary& random) {
                            const Arguments x = hostile(random);
                            return same(valueOf(op, x), valueOf(op, {x[1], x[0]}));
                          });
    EXPECT_EQ(measured, info(op).symmetry == Symmetry::Symmetric) << info(op).name;
  }
}

TEST(Ops, ChoicesAreWhatTheValuesShow) {
  const auto shows = [](Choice choice, const Arguments& x, double value) {
    const auto [a, b, c] = std::array{x[0], x[1], x[2]};
    return choice == Choice::Least      ? value == std::min(a, b)
           : choice == Choice::Greatest ? value == std::max(a, b)
           : choice == Choice::Selected ? value == (a != 0.0 ? b : c)
           : choice == Choice::IsLess   ? a == b || value == (a < b ? 1.0 : 0.0)
                                        : value == (a == b ? 1.0 : 0.0);
  };
  for (const Op op : operations())
    for (const Choice choice :
         {Choice::Least, Choice::Greatest, Choice::Selected, Choice::IsLess, Choice::IsEqual}) {
      const bool measured = always([&](Adversary& random) {
        const Arguments x = allPlain(random);
        return shows(choice, x, valueOf(op, x));
      });
      EXPECT_EQ(measured, choiceOf(op) == choice) << info(op).name;
    }
}

}  // namespace ops_test
}  // namespace sdf
