// What the batch reading may give: the interval reading with every operation widened by the rounding that
// eval/batch.h promises for it. Derivatives are built of the same operations, so the type serves them too.
//
// The double reading lies inside as well (it rounds less), so the width bounds how far the two are apart.
#pragma once
#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <glm/vec3.hpp>

#include "sdf/eval/scalar_reading.h"

namespace sdf::test {

/// Distance of the floats around x; infinite beyond the largest float.
inline double floatUlp(double x) {
  const float v = std::abs(static_cast<float>(x));
  if (!std::isfinite(v)) return HUGE_VAL;
  return static_cast<double>(std::nextafter(v, HUGE_VALF)) - v;
}

/// The interval with every value moved by up to `ulps` of its own, and by `least` where that is more. No
/// rounding changes a sign.
inline Interval rounded(const Interval& a, double ulps, double least = 0.0) {
  const auto reach = [&](double x) { return std::max(ulps * floatUlp(x), least); };
  const auto below = [&](double x) {
    return x == -HUGE_VAL || reach(x) == HUGE_VAL ? -HUGE_VAL : x - reach(x);
  };
  const auto above = [&](double x) {
    return x == HUGE_VAL || reach(x) == HUGE_VAL ? HUGE_VAL : x + reach(x);
  };
  // A float beyond the largest is infinite, one short of it may be.
  const double lo = a.lo > FLT_MAX ? FLT_MAX : std::min(below(a.lo), below(a.hi));
  const double hi = a.hi < -FLT_MAX ? -FLT_MAX : std::max(above(a.hi), above(a.lo));
  return {a.lo >= 0.0 ? std::max(lo, 0.0) : lo, a.hi <= 0.0 ? std::min(hi, 0.0) : hi, a.nan};
}

/// An interval of what a lane of floats may hold.
struct FloatRange {
  Interval range;

  FloatRange() = default;
  FloatRange(const Interval& r) : range(r) {}  // NOLINT
  /// A constant: the tape holds its nearest float.
  FloatRange(double v) : range(hull(Interval(v), Interval(static_cast<float>(v)))) {}  // NOLINT
};

// eval/batch.h: 4 ulp for each operation, tan 8, pow and mod 2; exp and pow flush what is below the least
// normal float.
inline constexpr double kPlainUlps = 4.0, kTanUlps = 8.0, kPowUlps = 2.0, kModUlps = 2.0;

inline FloatRange plain(const Interval& r) { return rounded(r, kPlainUlps); }

#define SDF_EXACT_1(call) \
  inline FloatRange call(const FloatRange& a) { return sdf::call(a.range); }
SDF_EXACT_1(neg)
SDF_EXACT_1(abs)
SDF_EXACT_1(floor)
SDF_EXACT_1(ceil)
SDF_EXACT_1(round)
#undef SDF_EXACT_1
#define SDF_EXACT_2(call) \
  inline FloatRange call(const FloatRange& a, const FloatRange& b) { return sdf::call(a.range, b.range); }
SDF_EXACT_2(min)
SDF_EXACT_2(max)
SDF_EXACT_2(less)
SDF_EXACT_2(lessEqual)
SDF_EXACT_2(equal)
#undef SDF_EXACT_2
#define SDF_PLAIN_1(call) \
  inline FloatRange call(const FloatRange& a) { return plain(sdf::call(a.range)); }
SDF_PLAIN_1(sqrt)
SDF_PLAIN_1(square)
SDF_PLAIN_1(sin)
SDF_PLAIN_1(cos)
SDF_PLAIN_1(asin)
SDF_PLAIN_1(acos)
SDF_PLAIN_1(atan)
SDF_PLAIN_1(log)
#undef SDF_PLAIN_1
#define SDF_PLAIN_2(call)                                            \
  inline FloatRange call(const FloatRange& a, const FloatRange& b) { \
    return plain(sdf::call(a.range, b.range));                       \
  }
SDF_PLAIN_2(add)
SDF_PLAIN_2(sub)
SDF_PLAIN_2(mul)
SDF_PLAIN_2(div)
SDF_PLAIN_2(atan2)
#undef SDF_PLAIN_2

inline FloatRange tan(const FloatRange& a) { return rounded(sdf::tan(a.range), kTanUlps); }
inline FloatRange exp(const FloatRange& a) { return rounded(sdf::exp(a.range), kPlainUlps, FLT_MIN); }
inline FloatRange pow(const FloatRange& a, const FloatRange& b) {
  return rounded(sdf::pow(a.range, b.range), kPowUlps, FLT_MIN);
}
/// a - b floor(a / b): the rounded quotient may reach the next whole number.
inline FloatRange mod(const FloatRange& a, const FloatRange& b) {
  const Interval turns = sdf::floor(div(a, b).range);
  return rounded(sdf::sub(a.range, sdf::mul(b.range, turns)), kModUlps, floatUlp(a.range.magnitude()));
}
/// With or without rounding the product, as the instruction set has it.
inline FloatRange mulAdd(const FloatRange& a, const FloatRange& b, const FloatRange& c) {
  return add(mul(a, b), c);
}
inline FloatRange squareAdd(const FloatRange& a, const FloatRange& c) { return add(square(a), c); }
inline FloatRange select(const FloatRange& c, const FloatRange& a, const FloatRange& b) {
  return sdf::select(c.range, a.range, b.range);
}
// As for numbers: each lane takes the slope of one branch.
inline FloatRange stepSlope(const FloatRange&) { return {}; }
inline FloatRange choiceSlope(const FloatRange& c, const FloatRange& a, const FloatRange& b) {
  return select(c, a, b);
}

using FloatVariables = std::array<FloatRange, kVariableCount>;

inline FloatVariables floatVariables(const glm::vec3& p) {
  return {FloatRange(p.x), FloatRange(p.y), FloatRange(p.z), {}, {}, {}};
}

/// Contains the batch reading's value of output 0 at p, and the double reading's.
inline Interval floatRange(const Tape& tape, const glm::vec3& p) {
  ScalarReading<FloatRange> reading;
  reading.run(tape, floatVariables(p));
  return reading.output().range;
}

/// The same of the derivatives along x, y and z. At a kink they contain both sides'.
inline std::array<Interval, 3> floatGradientRange(const Tape& tape, const glm::vec3& p) {
  using D = Dual<FloatRange, 3>;
  std::array<D, kVariableCount> variables{};
  for (int i = 0; i < 3; ++i) {
    variables[i].v = FloatRange(p[i]);
    variables[i].d[i] = FloatRange(1.0);
  }
  ScalarReading<D> reading;
  reading.run(tape, variables);
  const D r = reading.output();
  return {r.d[0].range, r.d[1].range, r.d[2].range};
}

}  // namespace sdf::test
