// Intervals of double, rounded outward, that carry "may be NaN" (the idea is libfive's).
//
// Contract of every operation: if each argument lies in its interval (or is NaN and the interval says so),
// the result lies in the returned interval, or is NaN and the returned interval says so. Rounding is done by
// stepping the ends outward after round-to-nearest arithmetic, so the rounding mode is never touched. Ends of
// library functions are stepped by kLibraryUlps, glibc's documented error for double being under one ulp for
// each function used here.
#pragma once
#include <concepts>

namespace sdf {

struct Interval {
  double lo = 0.0;
  double hi = 0.0;
  bool nan = false;  ///< the value may be NaN

  Interval() = default;
  /// A number is an interval; NaN is [0, 0] or NaN, for the ends are numbers always.
  Interval(double v) : lo(v == v ? v : 0.0), hi(lo), nan(v != v) {}  // NOLINT
  Interval(double l, double h, bool n = false) : lo(l), hi(h), nan(n) {}

  static Interval everything();
  /// True where x is in [lo, hi], or x is NaN and the interval admits NaN.
  bool contains(double x) const { return x != x ? nan : lo <= x && x <= hi; }
  bool isPoint() const { return lo == hi && !nan; }
  double width() const { return hi - lo; }
  /// Largest absolute value.
  double magnitude() const;
};

/// An interval in the reading of a function that is known to be continuous: what its parts jump by does not
/// show in it, so that almost everywhere it has the slope of one of their pieces.
struct IntervalOfContinuous : Interval {
  IntervalOfContinuous() = default;
  IntervalOfContinuous(double v) : Interval(v) {}           // NOLINT
  IntervalOfContinuous(const Interval& i) : Interval(i) {}  // NOLINT
};

template <class T>
concept AnyInterval = std::derived_from<T, Interval>;

/// Smallest interval around both.
Interval hull(const Interval& a, const Interval& b);

Interval neg(const Interval& a);
Interval abs(const Interval& a);
Interval sqrt(const Interval& a);
Interval square(const Interval& a);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval tan(const Interval& a);
Interval asin(const Interval& a);
Interval acos(const Interval& a);
Interval atan(const Interval& a);
Interval exp(const Interval& a);
Interval log(const Interval& a);
Interval floor(const Interval& a);
Interval ceil(const Interval& a);
Interval round(const Interval& a);
Interval add(const Interval& a, const Interval& b);
Interval sub(const Interval& a, const Interval& b);
Interval mul(const Interval& a, const Interval& b);
Interval div(const Interval& a, const Interval& b);
Interval min(const Interval& a, const Interval& b);
Interval max(const Interval& a, const Interval& b);
Interval pow(const Interval& a, const Interval& b);
Interval atan2(const Interval& a, const Interval& b);
Interval mod(const Interval& a, const Interval& b);
Interval less(const Interval& a, const Interval& b);
Interval lessEqual(const Interval& a, const Interval& b);
Interval equal(const Interval& a, const Interval& b);
Interval select(const Interval& c, const Interval& a, const Interval& b);
Interval mulAdd(const Interval& a, const Interval& b, const Interval& c);
Interval squareAdd(const Interval& a, const Interval& c);
/// Encloses a / length for a length with `a` as a part, and 0 for a length of 0.
Interval shareOf(const Interval& a, const Interval& length);

/// Derivative of a step function whose value over the box is `step`: 0 where it does not jump, unbounded
/// where it may.
Interval stepSlope(const Interval& step);
/// Derivative of select(c, ., .): unbounded unless c is decided, for the branches may not meet.
Interval choiceSlope(const Interval& c, const Interval& a, const Interval& b);
inline IntervalOfContinuous stepSlope(const IntervalOfContinuous& /*step*/) { return 0.0; }
inline IntervalOfContinuous choiceSlope(const IntervalOfContinuous& c, const IntervalOfContinuous& a,
                                        const IntervalOfContinuous& b) {
  return select(c, a, b);
}

}  // namespace sdf
