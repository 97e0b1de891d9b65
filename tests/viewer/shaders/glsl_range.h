// What a shader may give for an expression: the interval reading with every operation widened by the rounding
// that GLSL allows it ("Range and Precision" in the specification of 4.50). That says nothing of
// trigonometric functions: see below.
//
// The double reading lies inside as well, so the width bounds how far the two are apart.
#pragma once
#include <numbers>
#include <unordered_map>

#include "support/float_range.h"

namespace sdf::test {

/// An interval of what a float in a shader may hold.
struct GlslRange {
  Interval range;

  GlslRange() = default;
  GlslRange(const Interval& r) : range(r) {}  // NOLINT
  /// A literal or a uniform: its nearest float.
  GlslRange(double v) : range(hull(Interval(v), Interval(static_cast<float>(v)))) {}  // NOLINT
};

// Which way results are rounded is not defined, and what is below the least normal number may be 0.
inline constexpr double kRoundedUlps = 1.0, kDivideUlps = 2.5;
// 1 / inversesqrt(x): 2 and 2.5 ulp.
inline constexpr double kRootUlps = 4.5;
// Of sin and cos up to pi away from 0, and then as much more as the angle has larger ulps. Vulkan asks for
// 2^-11 only; CUDA's guide states 2^-21.4 for NVIDIA's fast ones, and Mesa's are within 2^-23.
inline constexpr double kTurnError = 0x1p-20;
// Of atan (Vulkan's table of precision); Mesa's takes 350.
inline constexpr double kArcUlps = 4096.0;

inline GlslRange flushed(const Interval& r, double ulps) { return rounded(r, ulps, FLT_MIN); }
inline Interval widened(const Interval& r, double by) { return {r.lo - by, r.hi + by, r.nan}; }

#define SDF_EXACT_1(call) \
  inline GlslRange call(const GlslRange& a) { return sdf::call(a.range); }
SDF_EXACT_1(neg)
SDF_EXACT_1(abs)
SDF_EXACT_1(floor)
SDF_EXACT_1(ceil)
SDF_EXACT_1(round)
#undef SDF_EXACT_1
#define SDF_EXACT_2(call) \
  inline GlslRange call(const GlslRange& a, const GlslRange& b) { return sdf::call(a.range, b.range); }
SDF_EXACT_2(min)
SDF_EXACT_2(max)
SDF_EXACT_2(less)
SDF_EXACT_2(lessEqual)
SDF_EXACT_2(equal)
#undef SDF_EXACT_2
#define SDF_ROUNDED_2(call, ulps)                                 \
  inline GlslRange call(const GlslRange& a, const GlslRange& b) { \
    return flushed(sdf::call(a.range, b.range), ulps);            \
  }
SDF_ROUNDED_2(mul, kRoundedUlps)
SDF_ROUNDED_2(div, kDivideUlps)
#undef SDF_ROUNDED_2

// Drivers may add in another order, so that constants are added to each other first: a sum is off by an ulp
// of its larger term.
inline GlslRange sum(const Interval& exact, const GlslRange& a, const GlslRange& b) {
  const double size = std::max(a.range.magnitude(), b.range.magnitude());
  return rounded(exact, kRoundedUlps,
                 std::isinf(floatUlp(size)) ? FLT_MIN : std::max<double>(floatUlp(size), FLT_MIN));
}
inline GlslRange add(const GlslRange& a, const GlslRange& b) { return sum(sdf::add(a.range, b.range), a, b); }
inline GlslRange sub(const GlslRange& a, const GlslRange& b) { return sum(sdf::sub(a.range, b.range), a, b); }

inline GlslRange square(const GlslRange& a) { return flushed(sdf::square(a.range), kRoundedUlps); }
inline GlslRange sqrt(const GlslRange& a) { return flushed(sdf::sqrt(a.range), kRootUlps); }

inline Interval turned(const Interval& wave, const Interval& angle) {
  const double error = kTurnError * std::max(1.0, angle.magnitude() / std::numbers::pi);
  const Interval r = widened(wave, error);
  return {std::max(r.lo, -1.0 - kTurnError), std::min(r.hi, 1.0 + kTurnError), r.nan};
}
inline GlslRange sin(const GlslRange& a) { return turned(sdf::sin(a.range), a.range); }
inline GlslRange cos(const GlslRange& a) { return turned(sdf::cos(a.range), a.range); }
inline GlslRange tan(const GlslRange& a) { return div(sin(a), cos(a)); }

/// The quotient and the arc may each be flushed.
inline GlslRange atan2(const GlslRange& a, const GlslRange& b) {
  return rounded(sdf::atan2(a.range, b.range), kArcUlps, 2.0 * FLT_MIN);
}
inline GlslRange atan(const GlslRange& a) { return flushed(sdf::atan(a.range), kArcUlps); }
/// atan of a and sqrt((1 - a)(1 + a)): either is off by some of its own ulps, the arc by no more.
inline GlslRange asin(const GlslRange& a) { return flushed(sdf::asin(a.range), kArcUlps); }
inline GlslRange acos(const GlslRange& a) { return flushed(sdf::acos(a.range), kArcUlps); }

/// 3 + 2 |a| ulp.
inline GlslRange exp(const GlslRange& a) {
  return flushed(sdf::exp(a.range), 3.0 + 2.0 * std::min(a.range.magnitude(), 1e4));
}
/// 3 ulp, or 2^-21 where the argument is between a half and two.
inline GlslRange log(const GlslRange& a) {
  const bool near1 = a.range.hi >= 0.5 && a.range.lo <= 2.0;
  return near1 ? Interval(widened(rounded(sdf::log(a.range), 3.0), 0x1p-21))
               : rounded(sdf::log(a.range), 3.0);
}
/// exp2(b log2(a)): the exponent is off by log2's error times b and by its own rounding, and the result by as
/// much of itself; below 1 / 8, so that the power's growth is less than that of its tangent by half.
inline GlslRange pow(const GlslRange& a, const GlslRange& b) {
  const Interval exact = sdf::pow(a.range, b.range);
  const Interval size = sdf::abs(a.range);
  if (size.lo <= 0.0) return flushed(exact, 1e5);
  const double log2 = std::max(std::abs(std::log2(size.lo)), std::abs(std::log2(size.hi)));
  const double power = b.range.magnitude(), exponent = power * log2;
  const double off = power * std::max(3.0 * floatUlp(log2), 0x1p-21) + floatUlp(exponent);
  if (!(off < 0.125)) return Interval(-HUGE_VAL, HUGE_VAL, true);
  const double ulps = 3.0 + 2.0 * exponent + 1.1 * std::numbers::ln2 * off / 0x1p-24;
  return flushed(exact, ulps);
}
/// a - b floor(a / b): the rounded quotient may reach the next whole number.
inline GlslRange mod(const GlslRange& a, const GlslRange& b) { return sub(a, mul(b, floor(div(a, b)))); }
/// With or without rounding the product.
inline GlslRange mulAdd(const GlslRange& a, const GlslRange& b, const GlslRange& c) {
  return add(mul(a, b), c);
}
inline GlslRange squareAdd(const GlslRange& a, const GlslRange& c) { return add(square(a), c); }
inline GlslRange select(const GlslRange& c, const GlslRange& a, const GlslRange& b) {
  return sdf::select(c.range, a.range, b.range);
}

/// What a payload states of its value; of its derivatives only their bound is promised.
inline GlslRange payloadAt(const PayloadPart& part, const GlslRange& a, const GlslRange& b,
                           const GlslRange& c) {
  return flushed(payloadAt(part, FloatRange(a.range), FloatRange(b.range), FloatRange(c.range)).range,
                 kRoundedUlps);
}

/// Ranges of expressions, point by point.
class GlslReading {
 public:
  explicit GlslReading(std::span<const Expr> outputs) {
    std::unordered_map<Expr, int> place;
    for (const Expr& e : topologicalOrder(outputs)) {
      Step step{e.op(), {}, dependsOnPlace(e, place) ? 0.0 : uniformValue(e)};
      if (dependsOnPlace(e, place)) {
        if (e.op() == Op::Variable) step.in[0] = static_cast<int>(e.variableIndex());
        if (e.payloadPart()) step.payload = *e.payloadPart();
        for (int i = 0; i < arity(e.op()); ++i) step.in[i] = place.at(e.arg(i));
      } else {
        step.op = Op::Constant;
      }
      place.emplace(e, static_cast<int>(steps_.size()));
      steps_.push_back(step);
    }
    for (const Expr& e : outputs) outputs_.push_back(place.at(e));
    values_.resize(steps_.size());
  }

  std::vector<Interval> operator()(const glm::vec3& p, const glm::vec3& n) {
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const Step& s = steps_[i];
      if (s.op == Op::Variable)
        values_[i] = GlslRange(static_cast<double>(s.in[0] < 3 ? p[s.in[0]] : n[s.in[0] - 3]));
      else if (s.op == Op::Constant)
        values_[i] = GlslRange(s.value);
      else
        values_[i] = evaluateOp<GlslRange>(s.op, s.payload.payload ? &s.payload : nullptr,
                                           [&](int k) { return values_[s.in[k]]; });
    }
    std::vector<Interval> result;
    for (const int i : outputs_) result.push_back(values_[i].range);
    return result;
  }

 private:
  struct Step {
    Op op;
    std::array<int, 3> in;
    double value;
    PayloadPart payload{};
  };
  bool dependsOnPlace(const Expr& e, const std::unordered_map<Expr, int>& place) const {
    if (e.op() == Op::Variable) return true;
    for (int i = 0; i < arity(e.op()); ++i)
      if (steps_[place.at(e.arg(i))].op != Op::Constant) return true;
    return false;
  }

  std::vector<Step> steps_;
  std::vector<GlslRange> values_;
  std::vector<int> outputs_;
};

}  // namespace sdf::test
