#include "sdf/number/interval.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace sdf {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity(), kPi = std::numbers::pi;
constexpr int kLibraryUlps = 2;

// The next double towards +infinity (Steele & Vigna's bit trick: doubles order as their bits do).
double up(double x) {
  if (!(x < kInf)) return x;
  if (x == 0.0) return std::numeric_limits<double>::denorm_min();
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits + (bits >= 0 ? 1 : -1));
}

double upBy(double x, int ulps) {
  for (int i = 0; i < ulps; ++i) x = up(x);
  return x;
}
double downBy(double x, int ulps) { return -upBy(-x, ulps); }

Interval outward(double lo, double hi, bool nan, int ulps = 1) {
  if (lo != lo || hi != hi) return {-kInf, kInf, true};
  return {downBy(lo, ulps), upBy(hi, ulps), nan};
}

bool containsZero(const Interval& a) { return a.lo <= 0.0 && a.hi >= 0.0; }
bool touchesInfinity(const Interval& a) { return a.lo == -kInf || a.hi == kInf; }

// Is s = a + b without rounding (Knuth, TAOCP 4.2.2, theorem B)? Not where it overflows.
bool isExactSum(double s, double a, double b) {
  const double part = s - a;
  return (a - (s - part)) + (b - part) == 0.0;
}

// Are the ends 0, 1 or -1, so that products with them are exact?
bool hasUnitEnds(const Interval& a) {
  const auto isUnit = [](double x) { return x == 0.0 || x == 1.0 || x == -1.0; };
  return isUnit(a.lo) && isUnit(a.hi);
}

bool isZero(const Interval& a) { return a.lo == 0.0 && a.hi == 0.0; }

// The ends of a product or quotient, whose sign is exact even where it underflows.
Interval signedOutward(double lo, double hi, const Interval& a, const Interval& b, bool nan) {
  if (isZero(a) || isZero(b)) return {0.0, 0.0, nan};
  Interval r = outward(lo, hi, nan);
  if ((a.lo >= 0.0 && b.lo >= 0.0) || (a.hi <= 0.0 && b.hi <= 0.0)) r.lo = std::max(r.lo, 0.0);
  if ((a.lo >= 0.0 && b.hi <= 0.0) || (a.hi <= 0.0 && b.lo >= 0.0)) r.hi = std::min(r.hi, 0.0);
  return r;
}

Interval clampTo(const Interval& a, double lo, double hi) {
  return {std::clamp(a.lo, lo, hi), std::clamp(a.hi, lo, hi), a.nan};
}

// Endpoint products, where 0 · inf counts as 0 (the NaN it may be is flagged by the caller).
double product(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }

// Does one of crest + 2 pi n lie in [lo, hi]? `slack` covers the rounding of the difference, of the quotient
// and of the two constants (in turns 2^-53 + 2^-53 + 4e-17 of the quotient, and 1e-17), so that a crest near
// an end is never missed.
bool hasCrest(double lo, double hi, double crest) {
  const double a = (lo - crest) / (2.0 * kPi), b = (hi - crest) / (2.0 * kPi);
  const double slack = 3e-16 * std::max(std::abs(a), std::abs(b)) + 2e-17;
  return std::floor(b + slack) >= std::ceil(a - slack);
}

template <double (*F)(double)>
Interval wave(const Interval& a, double crest, double trough) {
  // Beyond 1e9 the slack above outgrows its purpose; the range is all that is worth saying.
  if (touchesInfinity(a)) return {-1.0, 1.0, true};
  if (a.hi - a.lo >= 2.0 * kPi || std::abs(a.lo) > 1e9 || std::abs(a.hi) > 1e9) return {-1.0, 1.0, a.nan};
  const double u = F(a.lo), v = F(a.hi);
  Interval r = outward(std::min(u, v), std::max(u, v), a.nan, kLibraryUlps);
  if (hasCrest(a.lo, a.hi, crest)) r.hi = 1.0;
  if (hasCrest(a.lo, a.hi, trough)) r.lo = -1.0;
  return clampTo(r, -1.0, 1.0);
}

template <double (*F)(double)>
Interval increasing(const Interval& a) {
  return outward(F(a.lo), F(a.hi), a.nan, kLibraryUlps);
}

Interval truth(bool canBeFalse, bool canBeTrue) { return {canBeFalse ? 0.0 : 1.0, canBeTrue ? 1.0 : 0.0}; }

bool isInteger(double x) { return std::floor(x) == x && std::abs(x) < kInf; }
bool holdsInteger(const Interval& a) { return std::floor(a.hi) >= a.lo; }

Interval integerPower(const Interval& a, double n) {
  const bool even = std::fmod(n, 2.0) == 0.0;
  auto f = [n](double x) { return std::pow(x, n); };
  if (n == 0.0) return {1.0, 1.0};  // pow(NaN, 0) is 1
  const Interval base = even ? abs(a) : a;
  if (n < 0.0 && containsZero(a)) {
    Interval r = outward(even ? f(base.hi) : -kInf, kInf, a.nan, kLibraryUlps);
    return even ? clampTo(r, 0.0, kInf) : r;
  }
  Interval r = n > 0.0 ? outward(f(base.lo), f(base.hi), a.nan, kLibraryUlps)
                       : outward(f(base.hi), f(base.lo), a.nan, kLibraryUlps);
  if (even) r.lo = std::max(r.lo, 0.0);
  return r;
}

// For a >= 0 the power is monotone in each argument, so its extremes are at the corners, or 1 where the
// exponent's or the base's monotony turns (exponent 0, base 1); pow(0, negative) is +inf.
Interval powerOfNonNegative(const Interval& a, const Interval& b) {
  double lo = kInf, hi = 0.0;
  for (double x : {a.lo + 0.0, a.hi + 0.0, std::clamp(1.0, a.lo, a.hi)})  // -0 counts as 0
    for (double y : {b.lo, b.hi, std::clamp(0.0, b.lo, b.hi)}) {
      const double v = std::pow(x, y);
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  // pow(1, NaN) and pow(NaN, 0) are 1.
  if (a.nan || b.nan) lo = std::min(lo, 1.0), hi = std::max(hi, 1.0);
  Interval r = outward(lo, hi, a.nan || b.nan, kLibraryUlps);
  r.lo = std::max(r.lo, 0.0);
  // pow(-0, an odd negative integer) is -inf.
  if (a.lo == 0.0 && b.lo <= -1.0 && holdsInteger({b.lo, std::min(b.hi, -1.0)})) r.lo = -kInf;
  return r;
}

}  // namespace

Interval Interval::everything() { return {-kInf, kInf, true}; }
double Interval::magnitude() const { return std::max(std::abs(lo), std::abs(hi)); }

Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi), a.nan || b.nan};
}

Interval neg(const Interval& a) { return {-a.hi, -a.lo, a.nan}; }

Interval abs(const Interval& a) {
  if (a.lo >= 0.0) return a;
  if (a.hi <= 0.0) return neg(a);
  return {0.0, std::max(-a.lo, a.hi), a.nan};
}

Interval sqrt(const Interval& a) {
  if (a.hi < 0.0) return {0.0, 0.0, true};
  Interval r = outward(std::sqrt(std::max(a.lo, 0.0)), std::sqrt(a.hi), a.nan || a.lo < 0.0);
  r.lo = std::max(r.lo, 0.0);
  if (a.hi == 0.0) r.hi = 0.0;  // exact
  return r;
}

Interval square(const Interval& a) {
  const Interval m = abs(a);
  Interval r = outward(m.lo * m.lo, m.hi * m.hi, a.nan);
  r.lo = std::max(r.lo, 0.0);
  if (m.hi == 0.0) r.hi = 0.0;  // exact
  return r;
}

Interval sin(const Interval& a) { return wave<std::sin>(a, kPi / 2, -kPi / 2); }
Interval cos(const Interval& a) { return wave<std::cos>(a, 0.0, kPi); }

Interval tan(const Interval& a) {
  if (touchesInfinity(a)) return Interval::everything();
  // Poles lie at pi/2 + n pi, which is a crest or a trough of the sine.
  const bool pole = a.hi - a.lo >= kPi || a.magnitude() > 1e9 || hasCrest(a.lo, a.hi, kPi / 2) ||
                    hasCrest(a.lo, a.hi, -kPi / 2);
  if (pole) return {-kInf, kInf, a.nan};
  return increasing<std::tan>(a);
}

Interval asin(const Interval& a) {
  if (a.hi < -1.0 || a.lo > 1.0) return {0.0, 0.0, true};
  Interval r = increasing<std::asin>(clampTo(a, -1.0, 1.0));
  r.nan = a.nan || a.lo < -1.0 || a.hi > 1.0;
  return r;
}

Interval acos(const Interval& a) {
  if (a.hi < -1.0 || a.lo > 1.0) return {0.0, 0.0, true};
  const Interval c = clampTo(a, -1.0, 1.0);
  Interval r = outward(std::acos(c.hi), std::acos(c.lo), a.nan || a.lo < -1.0 || a.hi > 1.0, kLibraryUlps);
  r.lo = std::max(r.lo, 0.0);
  return r;
}

Interval atan(const Interval& a) { return increasing<std::atan>(a); }

Interval exp(const Interval& a) {
  Interval r = increasing<std::exp>(a);
  r.lo = std::max(r.lo, 0.0);
  return r;
}

Interval log(const Interval& a) {
  if (a.hi < 0.0) return {0.0, 0.0, true};
  return increasing<std::log>({std::max(a.lo, 0.0), a.hi, a.nan || a.lo < 0.0});
}

Interval floor(const Interval& a) { return {std::floor(a.lo), std::floor(a.hi), a.nan}; }
Interval ceil(const Interval& a) { return {std::ceil(a.lo), std::ceil(a.hi), a.nan}; }
Interval round(const Interval& a) { return {std::nearbyint(a.lo), std::nearbyint(a.hi), a.nan}; }

Interval add(const Interval& a, const Interval& b) {
  const bool cancel = (a.lo == -kInf && b.hi == kInf) || (a.hi == kInf && b.lo == -kInf);
  double lo = a.lo + b.lo, hi = a.hi + b.hi;
  // Exact sums stay: those with 0 (so that sums of squares do not stray below it), those of small integers.
  lo = lo != lo ? -kInf : isExactSum(lo, a.lo, b.lo) ? lo : -up(-lo);
  hi = hi != hi ? kInf : isExactSum(hi, a.hi, b.hi) ? hi : up(hi);
  return {lo, hi, a.nan || b.nan || cancel};
}

Interval sub(const Interval& a, const Interval& b) { return add(a, neg(b)); }

Interval mul(const Interval& a, const Interval& b) {
  const bool zeroTimesInf =
      (containsZero(a) && touchesInfinity(b)) || (containsZero(b) && touchesInfinity(a));
  const double p = product(a.lo, b.lo), q = product(a.lo, b.hi);
  const double r = product(a.hi, b.lo), s = product(a.hi, b.hi);
  const double lo = std::min({p, q, r, s}), hi = std::max({p, q, r, s});
  const bool nan = a.nan || b.nan || zeroTimesInf;
  // Slopes of abs, min and max stay exact.
  if (hasUnitEnds(a) || hasUnitEnds(b)) return {lo, hi, nan};
  return signedOutward(lo, hi, a, b, nan);
}

Interval div(const Interval& a, const Interval& b) {
  const bool infOverInf = touchesInfinity(a) && touchesInfinity(b);
  if (containsZero(b) && isZero(a)) return {0.0, 0.0, true};
  if (containsZero(b)) return {-kInf, kInf, a.nan || b.nan || containsZero(a) || infOverInf};
  if (infOverInf) return Interval::everything();
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  return signedOutward(std::min({p, q, r, s}), std::max({p, q, r, s}), a, b, a.nan || b.nan);
}

// min(a, b) is b where a is NaN, and NaN where b is.
Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), a.nan ? b.hi : std::min(a.hi, b.hi), b.nan};
}
Interval max(const Interval& a, const Interval& b) {
  return {a.nan ? b.lo : std::max(a.lo, b.lo), std::max(a.hi, b.hi), b.nan};
}

Interval pow(const Interval& a, const Interval& b) {
  if (b.isPoint() && isInteger(b.lo)) return integerPower(a, b.lo);
  if (a.lo >= 0.0) return powerOfNonNegative(a, b);
  // A negative base has a power for integer exponents, and an infinite one (of either) for any.
  if (holdsInteger(b) || a.lo == -kInf || touchesInfinity(b)) return {-kInf, kInf, true};
  if (a.hi < 0.0) return {0.0, b.nan ? 1.0 : 0.0, true};
  Interval r = powerOfNonNegative({0.0, a.hi, a.nan}, b);
  r.nan = true;
  return r;
}

Interval atan2(const Interval& y, const Interval& x) {
  const bool nan = y.nan || x.nan;
  const Interval full = outward(-kPi, kPi, nan, kLibraryUlps);
  // The branch cut is the negative x axis; the origin is undefined enough to give up on.
  if (x.lo <= 0.0 && containsZero(y)) return full;
  // Off the cut the angle is monotone in each argument, the infinities included.
  double lo = kInf, hi = -kInf;
  for (double v : {y.lo, y.hi})
    for (double u : {x.lo, x.hi}) {
      const double t = std::atan2(v, u);
      lo = std::min(lo, t);
      hi = std::max(hi, t);
    }
  return outward(lo, hi, nan, kLibraryUlps);
}

Interval mod(const Interval& a, const Interval& b) {
  if (isZero(b)) return {0.0, 0.0, true};
  // Within one period of a fixed divisor the remainder is a - b * floor(a / b) with the floor known.
  const Interval turns = floor(div(a, b));
  const Interval plain = sub(a, mul(b, turns));
  // Where the plain form is infinite the quotient may have overflowed, and the remainder with it.
  if (turns.isPoint() || !b.isPoint() || touchesInfinity(plain)) return plain;
  // The computed remainder may leave [0, b) by the rounding of a / b and of b * floor(a / b): an ulp of a
  // each, or what a quotient that underflows loses.
  const double far = b.lo;
  const double slack = a.magnitude() * 0x1p-51 + std::abs(far) * 0x1p-1074;
  return {std::max(plain.lo, std::min(0.0, far) - slack), std::min(plain.hi, std::max(0.0, far) + slack),
          plain.nan};
}

Interval less(const Interval& a, const Interval& b) {
  return truth(a.hi >= b.lo || a.nan || b.nan, a.lo < b.hi);
}
Interval lessEqual(const Interval& a, const Interval& b) {
  return truth(a.hi > b.lo || a.nan || b.nan, a.lo <= b.hi);
}
Interval equal(const Interval& a, const Interval& b) {
  return truth(!(a.isPoint() && b.isPoint() && a.lo == b.lo), a.lo <= b.hi && b.lo <= a.hi);
}

Interval select(const Interval& c, const Interval& a, const Interval& b) {
  if (!containsZero(c)) return a;  // NaN differs from 0, too
  return c.isPoint() ? b : hull(a, b);
}

Interval mulAdd(const Interval& a, const Interval& b, const Interval& c) { return add(mul(a, b), c); }
Interval squareAdd(const Interval& a, const Interval& c) { return add(square(a), c); }

Interval shareOf(const Interval& a, const Interval& length) {
  if (a.nan || length.nan || touchesInfinity(length)) return {-1.0, 1.0};
  if (!(length.lo > 0.0)) return {a.lo < 0.0 ? -1.0 : 0.0, a.hi > 0.0 ? 1.0 : 0.0};
  const Interval share = div(a, length);
  return {std::max(share.lo, -1.0), std::min(share.hi, 1.0)};
}

Interval stepSlope(const Interval& step) { return step.isPoint() ? Interval(0.0) : Interval::everything(); }
Interval choiceSlope(const Interval& c, const Interval& a, const Interval& b) {
  const bool decided = !containsZero(c) || c.isPoint();
  return decided ? select(c, a, b) : Interval::everything();
}

}  // namespace sdf
