// Numbers chosen to break arithmetic, drawn anew for each trial, so that a failing trial can be run alone.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "sdf/expr/op.h"
#include "sdf/number/interval.h"

namespace sdf {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr double kHalfPi = 1.57079632679489661923;

/// Doubles in their order as integers: neighbours differ by one, and +0 follows -0.
inline std::int64_t rank(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits - 1;
}
inline double ofRank(std::int64_t r) {
  return std::bit_cast<double>(r >= 0 ? r : std::numeric_limits<std::int64_t>::min() - r - 1);
}

/// x moved by so many doubles, not beyond the infinities.
inline double stepped(double x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, kInf);
  for (; steps < 0; ++steps) x = std::nextafter(x, -kInf);
  return x;
}

/// A stream of random and of hostile numbers (splitmix64; Steele, Lea & Flood 2014).
class Adversary {
 public:
  explicit Adversary(std::uint64_t trial) : state_(trial * 0x9E3779B97F4A7C15ull) { bits(); }

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  /// A multiple of 2^-10 within [-reach, reach].
  double dyadic(int reach) { return (below(2 * 1024 * reach + 1) - 1024 * reach) / 1024.0; }

  /// Within [-4, 4], often a crease point or next to one.
  double moderate() {
    switch (below(4)) {
      case 0:
        return (below(17) - 8) * 0.5;
      case 1:
        return stepped((below(5) - 2) * kHalfPi, below(5) - 2);
      case 2:
        return stepped((below(17) - 8) * 0.5, below(5) - 2);
      default:
        return uniform(-4.0, 4.0);
    }
  }

  /// Anything but NaN.
  double hostile() {
    using Limits = std::numeric_limits<double>;
    static constexpr std::array kSpecial = {0.0,
                                            -0.0,
                                            kInf,
                                            -kInf,
                                            Limits::denorm_min(),
                                            -Limits::denorm_min(),
                                            Limits::min(),
                                            -Limits::min(),
                                            Limits::max(),
                                            -Limits::max(),
                                            kEpsilon,
                                            1e-160,
                                            1e160,
                                            -1e160,
                                            1e9,
                                            1e16};
    switch (below(6)) {
      case 0:
        return kSpecial[below(kSpecial.size())];
      case 1:  // near a crest, a trough or a pole, up to where the reduction of the argument gives up
        return stepped(below(2) * 2 - 1.0, 0) *
               stepped(std::floor(uniform(0.0, 1e9)) * kHalfPi, below(5) - 2);
      case 2:
        return ofRank(static_cast<std::int64_t>(bits() >> 1) % rank(kInf)) * (below(2) * 2 - 1);
      default:
        return moderate();
    }
  }

  template <class Number>
  Interval interval(Number number) {
    const double a = number(), b = below(4) == 0 ? stepped(a, below(4)) : below(4) == 0 ? a : number();
    return {std::min(a, b), std::max(a, b)};
  }
  Interval hostileInterval() {
    Interval i = interval([&] { return hostile(); });
    if (below(40) == 0) i = {-kInf, kInf};
    i.nan = below(8) == 0;
    return i;
  }

  /// A member of the interval: an end, a neighbour of an end, a crease inside, or a random one.
  double inside(const Interval& i) {
    if (i.nan && below(6) == 0) return kNaN;
    double x = i.lo;
    switch (below(7)) {
      case 0:
        break;
      case 1:
        x = i.hi;
        break;
      case 2:
        x = stepped(i.lo, 1 + below(2));
        break;
      case 3:
        x = moderate();
        break;
      case 4:
        x = below(2) ? 0.0 : -0.0;
        break;
      case 5:
        x = std::isfinite(i.width()) ? uniform(i.lo, i.hi) : x;
        break;
      default: {  // the ranks of everything span more than a signed integer
        const auto first = static_cast<std::uint64_t>(rank(i.lo)),
                   last = static_cast<std::uint64_t>(rank(i.hi));
        x = ofRank(static_cast<std::int64_t>(first + bits() % (last - first + 1)));
      }
    }
    return i.lo <= x && x <= i.hi ? x : i.lo;
  }

 private:
  std::uint64_t state_;
};

/// Every operation of ops.def, fused ones included.
inline std::vector<Op> operations() {
  std::vector<Op> all;
  for (int i = 0; i < kOpCount; ++i)
    if (isOperation(static_cast<Op>(i))) all.push_back(static_cast<Op>(i));
  return all;
}

inline std::string text(double x) {
  std::ostringstream out;
  out << std::hexfloat << x << std::defaultfloat << " (" << x << ")";
  return out.str();
}
inline std::string text(const Interval& i) {
  return "[" + text(i.lo) + ", " + text(i.hi) + (i.nan ? ", NaN]" : "]");
}
template <class T>
std::string text(Op op, const std::vector<T>& args) {
  std::string s = std::string(info(op).name) + "(";
  for (const T& a : args) s += (&a == args.data() ? "" : ", ") + text(a);
  return s + ")";
}

}  // namespace sdf
