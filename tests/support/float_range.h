// What the batch reading may give: the interval reading with every operation widened by the rounding that
// eval/promise.h allows it. Derivatives are built of the same operations, so the type serves them too.
//
// The double reading lies inside as well (it rounds less), so the width bounds how far the two are apart.
#pragma once
#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <glm/vec3.hpp>

#include "sdf/eval/promise.h"
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
  return {a.lo >= 0.0     ? std::max(lo, 0.0)
          : lo < -FLT_MAX ? -HUGE_VAL
                          : lo,
          a.hi <= 0.0    ? std::min(hi, 0.0)
          : hi > FLT_MAX ? HUGE_VAL
                         : hi,
          a.nan};
}

/// An interval of what a lane of floats may hold.
struct FloatRange {
  Interval range;

  FloatRange() = default;
  FloatRange(const Interval& r) : range(r) {}  // NOLINT
  /// A constant: the tape holds its nearest float.
  FloatRange(double v) : range(hull(Interval(v), Interval(static_cast<float>(v)))) {}  // NOLINT
};

/// a - b floor(a / b), step by step: the rounded quotient may reach another whole number.
template <class Range>
Range moduloOf(const Range& a, const Range& b) {
  return sub(a, mul(b, floor(div(a, b))));
}

/// What the operation may give for any arguments in these ranges.
template <Op op, class... Ranges>
FloatRange promised(const Ranges&... a) {
  if constexpr (op == Op::Mod) {
    return moduloOf(a...);
  } else {
    constexpr double kUlps = promise(op).ulps;
    const Interval exact = apply<op>(a.range...);
    return kUlps == 0.0 ? exact : rounded(exact, kUlps);
  }
}

#define SDF_UNARY(name, call, ...) \
  inline FloatRange call(const FloatRange& a) { return promised<Op::name>(a); }
#define SDF_BINARY(name, call, ...) \
  inline FloatRange call(const FloatRange& a, const FloatRange& b) { return promised<Op::name>(a, b); }
#define SDF_TERNARY(name, call, ...)                                                      \
  inline FloatRange call(const FloatRange& a, const FloatRange& b, const FloatRange& c) { \
    return promised<Op::name>(a, b, c);                                                   \
  }
#include "sdf/expr/ops.def"

/// With or without rounding the product, as the instruction set has it.
inline FloatRange mulAdd(const FloatRange& a, const FloatRange& b, const FloatRange& c) {
  return add(mul(a, b), c);
}
inline FloatRange squareAdd(const FloatRange& a, const FloatRange& c) { return add(square(a), c); }
// As for numbers: each lane takes the slope of one branch.
inline FloatRange stepSlope(const FloatRange&) { return {}; }
inline FloatRange choiceSlope(const FloatRange& c, const FloatRange& a, const FloatRange& b) {
  return select(c, a, b);
}

/// What a payload states of its value; of its derivatives only their bound is promised.
inline std::array<FloatRange, 4> payloadSlopes(const PayloadPart& part, const FloatRange& a,
                                               const FloatRange& b, const FloatRange& c) {
  const Interval range = sdf::payloadAt(part, a.range, b.range, c.range);
  const glm::dvec3 farthest(a.range.magnitude(), b.range.magnitude(), c.range.magnitude());
  const double by = part.part == 0 ? part.payload->rounding(farthest) : 0.0;
  const FloatRange slope = rounded(payloadSlope(part, range), 1.0);
  return {rounded({range.lo - by, range.hi + by, range.nan}, promise(Op::Payload).ulps), slope, slope, slope};
}
inline FloatRange payloadAt(const PayloadPart& part, const FloatRange& a, const FloatRange& b,
                            const FloatRange& c) {
  return payloadSlopes(part, a, b, c)[0];
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
