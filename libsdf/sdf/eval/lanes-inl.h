// The operations of expr/ops.def on SIMD lanes of float. Re-included once per target by Highway's
// foreach_target.
#if defined(SDF_EVAL_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_EVAL_LANES_INL_H
#undef SDF_EVAL_LANES_INL_H
#else
#define SDF_EVAL_LANES_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cmath>

#include "sdf/eval/inlining-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
inline constexpr D kD{};

struct Lanes {
  V v;
  SDF_INLINE Lanes() : v(hn::Zero(kD)) {}
  SDF_INLINE Lanes(V x) : v(x) {}  // NOLINT
  SDF_INLINE explicit Lanes(double x) : v(hn::Set(kD, static_cast<float>(x))) {}
};

SDF_INLINE V splat(double x) { return hn::Set(kD, static_cast<float>(x)); }
SDF_INLINE Lanes asNumber(M m) { return hn::IfThenElseZero(m, splat(1.0)); }
SDF_INLINE M isTrue(const Lanes& c) { return hn::Not(hn::Eq(c.v, hn::Zero(kD))); }

/// Lane by lane through a scalar function: for arguments outside what the vector form covers.
template <class F>
HWY_NOINLINE V perLane(V a, V b, F f) {
  HWY_ALIGN float x[HWY_MAX_BYTES / sizeof(float)], y[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(a, kD, x);
  hn::Store(b, kD, y);
  for (std::size_t i = 0; i < hn::Lanes(kD); ++i) x[i] = static_cast<float>(f(x[i], y[i]));
  return hn::Load(kD, x);
}

SDF_INLINE Lanes neg(const Lanes& a) { return hn::Neg(a.v); }
SDF_INLINE Lanes abs(const Lanes& a) { return hn::Abs(a.v); }
SDF_INLINE Lanes sqrt(const Lanes& a) {
#if HWY_TARGET <= HWY_AVX3
  // The divider takes 12 cycles for 16 lanes; a 14-bit estimate of 1/sqrt and one Goldschmidt step (Markstein
  // 2004) take half that and land within 2 ulp. 0 and infinity, where the estimate is infinite or 0, are
  // their own roots.
  const V r = hn::ApproximateReciprocalSqrt(a.v);
  const V g = hn::Mul(a.v, r), h = hn::Mul(r, splat(0.5));
  const V root = hn::MulAdd(g, hn::NegMulAdd(g, h, splat(0.5)), g);
  const M own = hn::Or(hn::Eq(a.v, hn::Zero(kD)), hn::Eq(a.v, hn::Set(kD, HUGE_VALF)));
  return hn::IfThenElse(own, a.v, root);
#else
  return hn::Sqrt(a.v);
#endif
}
SDF_INLINE Lanes square(const Lanes& a) { return hn::Mul(a.v, a.v); }
SDF_INLINE Lanes floor(const Lanes& a) { return hn::Floor(a.v); }
SDF_INLINE Lanes ceil(const Lanes& a) { return hn::Ceil(a.v); }
SDF_INLINE Lanes round(const Lanes& a) { return hn::Round(a.v); }
SDF_INLINE Lanes add(const Lanes& a, const Lanes& b) { return hn::Add(a.v, b.v); }
SDF_INLINE Lanes sub(const Lanes& a, const Lanes& b) { return hn::Sub(a.v, b.v); }
SDF_INLINE Lanes mul(const Lanes& a, const Lanes& b) { return hn::Mul(a.v, b.v); }
SDF_INLINE Lanes div(const Lanes& a, const Lanes& b) { return hn::Div(a.v, b.v); }
SDF_INLINE Lanes mulAdd(const Lanes& a, const Lanes& b, const Lanes& c) { return hn::MulAdd(a.v, b.v, c.v); }
SDF_INLINE Lanes squareAdd(const Lanes& a, const Lanes& c) { return hn::MulAdd(a.v, a.v, c.v); }
SDF_INLINE Lanes less(const Lanes& a, const Lanes& b) { return asNumber(hn::Lt(a.v, b.v)); }
SDF_INLINE Lanes lessEqual(const Lanes& a, const Lanes& b) { return asNumber(hn::Le(a.v, b.v)); }
SDF_INLINE Lanes equal(const Lanes& a, const Lanes& b) { return asNumber(hn::Eq(a.v, b.v)); }
SDF_INLINE Lanes select(const Lanes& c, const Lanes& a, const Lanes& b) {
  return hn::IfThenElse(isTrue(c), a.v, b.v);
}
// x86's own min and max already take the second argument on a NaN; Highway's portable ones do not.
SDF_INLINE Lanes min(const Lanes& a, const Lanes& b) {
#if HWY_ARCH_X86 && HWY_TARGET < HWY_EMU128
  return hn::Min(a.v, b.v);
#else
  return hn::IfThenElse(hn::Lt(a.v, b.v), a.v, b.v);
#endif
}
SDF_INLINE Lanes max(const Lanes& a, const Lanes& b) {
#if HWY_ARCH_X86 && HWY_TARGET < HWY_EMU128
  return hn::Max(a.v, b.v);
#else
  return hn::IfThenElse(hn::Gt(a.v, b.v), a.v, b.v);
#endif
}
SDF_INLINE Lanes stepSlope(const Lanes&) { return Lanes(); }
SDF_INLINE Lanes choiceSlope(const Lanes& c, const Lanes& a, const Lanes& b) { return select(c, a, b); }

// Highway's range reduction holds to 39000; this also sends NaN and infinity to the C library.
SDF_INLINE bool reducible(V a) { return hn::AllTrue(kD, hn::Le(hn::Abs(a), splat(39000.0))); }

SDF_INLINE Lanes sin(const Lanes& a) {
  if (HWY_LIKELY(reducible(a.v))) return hn::Sin(kD, a.v);
  return perLane(a.v, a.v, [](double x, double) { return std::sin(x); });
}
SDF_INLINE Lanes cos(const Lanes& a) {
  if (HWY_LIKELY(reducible(a.v))) return hn::Cos(kD, a.v);
  return perLane(a.v, a.v, [](double x, double) { return std::cos(x); });
}
SDF_INLINE Lanes tan(const Lanes& a) {
  if (HWY_LIKELY(reducible(a.v))) return hn::Div(hn::Sin(kD, a.v), hn::Cos(kD, a.v));
  return perLane(a.v, a.v, [](double x, double) { return std::tan(x); });
}

SDF_INLINE V nanWhere(M bad, V value) { return hn::IfThenElse(bad, hn::NaN(kD), value); }
SDF_INLINE M outsideUnit(V a) { return hn::Not(hn::Le(hn::Abs(a), splat(1.0))); }

SDF_INLINE Lanes asin(const Lanes& a) { return nanWhere(outsideUnit(a.v), hn::Asin(kD, a.v)); }
SDF_INLINE Lanes acos(const Lanes& a) { return nanWhere(outsideUnit(a.v), hn::Acos(kD, a.v)); }
SDF_INLINE Lanes atan(const Lanes& a) { return nanWhere(hn::IsNaN(a.v), hn::Atan(kD, a.v)); }

SDF_INLINE Lanes exp(const Lanes& a) {
  constexpr double kOverflow = 88.722839;    // exp above it exceeds the largest float
  constexpr double kUnderflow = -103.97208;  // exp below it rounds to 0
  const V e = hn::Exp(kD, hn::Min(hn::Max(a.v, splat(-104.0)), splat(88.8)));
  const V high = hn::IfThenElse(hn::Gt(a.v, splat(kOverflow)), hn::Set(kD, HUGE_VALF), e);
  const V low = hn::IfThenZeroElse(hn::Lt(a.v, splat(kUnderflow)), high);
  return nanWhere(hn::IsNaN(a.v), low);
}
SDF_INLINE Lanes log(const Lanes& a) {
  const V inf = hn::Set(kD, HUGE_VALF);
  V r = hn::Log(kD, a.v);
  r = hn::IfThenElse(hn::Eq(a.v, inf), inf, r);
  r = hn::IfThenElse(hn::Eq(a.v, hn::Zero(kD)), hn::Neg(inf), r);
  return nanWhere(hn::Not(hn::Ge(a.v, hn::Zero(kD))), r);
}

// a - b floor(a / b), the product not rounded.
SDF_INLINE Lanes mod(const Lanes& a, const Lanes& b) {
  return hn::NegMulAdd(b.v, hn::Floor(hn::Div(a.v, b.v)), a.v);
}

// The octant's angle from atan of the smaller over the larger, then reflected into place.
SDF_INLINE Lanes atan2(const Lanes& y, const Lanes& x) {
  constexpr double kPi = 3.14159265358979323846;
  const V ax = hn::Abs(x.v), ay = hn::Abs(y.v);
  const V big = hn::Max(ax, ay), small = hn::Min(ax, ay);
  V q = hn::Div(small, big);
  q = hn::IfThenZeroElse(hn::Eq(big, hn::Zero(kD)), q);
  q = hn::IfThenElse(hn::Eq(small, hn::Set(kD, HUGE_VALF)), splat(1.0), q);
  V t = hn::Atan(kD, q);
  t = hn::IfThenElse(hn::Gt(ay, ax), hn::Sub(splat(kPi / 2), t), t);
  const V negative = hn::CopySign(splat(1.0), x.v);
  t = hn::IfThenElse(hn::Lt(negative, hn::Zero(kD)), hn::Sub(splat(kPi), t), t);
  return nanWhere(hn::Or(hn::IsNaN(x.v), hn::IsNaN(y.v)), hn::CopySign(t, y.v));
}

// a^b = exp(b log a) in double, which leaves the float result right to a rounding; what is not a positive
// finite base and a finite exponent goes to the C library.
SDF_INLINE Lanes pow(const Lanes& a, const Lanes& b) {
  const V largest = hn::Set(kD, 3.4028235e38f);
  const M plain =
      hn::And(hn::And(hn::Gt(a.v, hn::Zero(kD)), hn::Le(a.v, largest)), hn::Le(hn::Abs(b.v), largest));
  if (!HWY_LIKELY(hn::AllTrue(kD, plain)))
    return perLane(a.v, b.v, [](double x, double y) { return std::pow(x, y); });
  const hn::Rebind<float, hn::ScalableTag<double>> half;
  const hn::ScalableTag<double> wide;
  HWY_ALIGN float base[HWY_MAX_BYTES / sizeof(float)], exponent[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(a.v, kD, base);
  hn::Store(b.v, kD, exponent);
  for (std::size_t i = 0; i < hn::Lanes(kD); i += hn::Lanes(wide)) {
    const auto x = hn::PromoteTo(wide, hn::Load(half, base + i));
    const auto y = hn::PromoteTo(wide, hn::Load(half, exponent + i));
    auto e = hn::Mul(y, hn::Log(wide, x));
    // exp of +-200 is beyond every float already, and within double's range.
    e = hn::Min(hn::Max(e, hn::Set(wide, -200.0)), hn::Set(wide, 200.0));
    hn::Store(hn::DemoteTo(half, hn::Exp(wide, e)), half, base + i);
  }
  return hn::Load(kD, base);
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();
#endif  // per-target guard
