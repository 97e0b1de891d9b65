// Intervals of double on SIMD lanes, rounded outward, for proofs. Re-included once per target by Highway's
// foreach_target.
//
// Contract of every operation: if each argument lies in its interval, the result lies in the returned one.
// Ends are never NaN: where nothing is known they are infinite. Ends are rounded by stepping them outward
// after round-to-nearest arithmetic, by an ulp or two and 1e-300, which covers what underflows.
#if defined(SDF_PROOF_RANGE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_PROOF_RANGE_LANES_INL_H
#undef SDF_PROOF_RANGE_LANES_INL_H
#else
#define SDF_PROOF_RANGE_LANES_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <cmath>

#include "sdf/eval/inlining-inl.h"
#include "sdf/number/interval.h"

HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
inline constexpr D kD{};
inline constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

SDF_INLINE V splat(double x) { return hn::Set(kD, x); }
SDF_INLINE V infinite() { return splat(HUGE_VAL); }

struct Range {
  V lo, hi;
  Range() = default;
  SDF_INLINE Range(V l, V h) : lo(l), hi(h) {}
  SDF_INLINE Range(double x) : lo(splat(x)), hi(splat(x)) {}  // NOLINT
  SDF_INLINE Range(double l, double h) : lo(splat(l)), hi(splat(h)) {}
};

SDF_INLINE Range everything() { return {hn::Neg(infinite()), infinite()}; }
SDF_INLINE Range where(M m, const Range& a, const Range& b) {
  return {hn::IfThenElse(m, a.lo, b.lo), hn::IfThenElse(m, a.hi, b.hi)};
}

// An ulp of x is at most |x| / 2^52, which is exact or so small that 1e-300 covers it.
SDF_INLINE V step(V x) { return hn::MulAdd(hn::Abs(x), splat(0x1p-52), splat(1e-300)); }
SDF_INLINE Range outward(V lo, V hi) {
  const V l = hn::Sub(lo, step(lo)), h = hn::Add(hi, step(hi));
  return {hn::IfThenElse(hn::IsNaN(l), hn::Neg(infinite()), l), hn::IfThenElse(hn::IsNaN(h), infinite(), h)};
}

SDF_INLINE Range neg(const Range& a) { return {hn::Neg(a.hi), hn::Neg(a.lo)}; }
SDF_INLINE Range add(const Range& a, const Range& b) {
  return outward(hn::Add(a.lo, b.lo), hn::Add(a.hi, b.hi));
}
SDF_INLINE Range sub(const Range& a, const Range& b) { return add(a, neg(b)); }
SDF_INLINE Range hull(const Range& a, const Range& b) { return {hn::Min(a.lo, b.lo), hn::Max(a.hi, b.hi)}; }
SDF_INLINE V magnitude(const Range& a) { return hn::Max(hn::Abs(a.lo), hn::Abs(a.hi)); }
/// What both contain; the first where rounding has left nothing.
SDF_INLINE Range common(const Range& a, const Range& b) {
  const Range both{hn::Max(a.lo, b.lo), hn::Min(a.hi, b.hi)};
  return where(hn::Le(both.lo, both.hi), both, a);
}
/// Of what is known to be no less than 0.
SDF_INLINE Range positivePart(const Range& a) {
  const V zero = hn::Zero(kD);
  return {hn::Max(a.lo, zero), hn::Max(a.hi, zero)};
}
SDF_INLINE Range symmetric(V most) { return {hn::Neg(most), most}; }

// 0 times infinity is NaN, which outward turns into an infinite end; min and max would hide it.
SDF_INLINE Range mul(const Range& a, const Range& b) {
  const V p = hn::Mul(a.lo, b.lo), q = hn::Mul(a.lo, b.hi), r = hn::Mul(a.hi, b.lo), s = hn::Mul(a.hi, b.hi);
  const Range product = outward(hn::Min(hn::Min(p, q), hn::Min(r, s)), hn::Max(hn::Max(p, q), hn::Max(r, s)));
  const M unknown = hn::Or(hn::Or(hn::IsNaN(p), hn::IsNaN(q)), hn::Or(hn::IsNaN(r), hn::IsNaN(s)));
  return where(unknown, everything(), product);
}
SDF_INLINE Range scale(double k, const Range& a) { return mul(Range(k), a); }
SDF_INLINE Range mulAdd(const Range& a, const Range& b, const Range& c) { return add(mul(a, b), c); }
SDF_INLINE Range square(const Range& a) {
  const V lo = hn::Abs(a.lo), hi = hn::Abs(a.hi), most = hn::Max(lo, hi), least = hn::Min(lo, hi);
  const M across = hn::And(hn::Le(a.lo, hn::Zero(kD)), hn::Ge(a.hi, hn::Zero(kD)));
  const V from = hn::IfThenZeroElse(across, least);
  return positivePart(outward(hn::Mul(from, from), hn::Mul(most, most)));
}
/// Of what is known to be no less than 0.
SDF_INLINE Range sqrt(const Range& a) {
  const Range p = positivePart(a);
  return positivePart(outward(hn::Sqrt(p.lo), hn::Sqrt(p.hi)));
}
SDF_INLINE M hasZero(const Range& a) {
  return hn::And(hn::Le(a.lo, hn::Zero(kD)), hn::Ge(a.hi, hn::Zero(kD)));
}
SDF_INLINE Range inverse(const Range& a) {
  const V one = splat(1.0);
  return where(hasZero(a), everything(), outward(hn::Div(one, a.hi), hn::Div(one, a.lo)));
}
SDF_INLINE Range div(const Range& a, const Range& b) { return mul(a, inverse(b)); }
SDF_INLINE Range abs(const Range& a) {
  const V lo = hn::Abs(a.lo), hi = hn::Abs(a.hi);
  return {hn::IfThenZeroElse(hasZero(a), hn::Min(lo, hi)), hn::Max(lo, hi)};
}
SDF_INLINE Range min(const Range& a, const Range& b) { return {hn::Min(a.lo, b.lo), hn::Min(a.hi, b.hi)}; }
SDF_INLINE Range max(const Range& a, const Range& b) { return {hn::Max(a.lo, b.lo), hn::Max(a.hi, b.hi)}; }
SDF_INLINE M isFinite(const Range& a) {
  return hn::And(hn::Lt(hn::Neg(infinite()), a.lo), hn::Lt(a.hi, infinite()));
}

/// Highway's cosine and sine are within 3 ulps (of values up to 1) for arguments up to 39000; elsewhere
/// nothing is said. The slope is at most 1: value in the middle, and the distance from there.
template <class F>
SDF_INLINE Range wave(const Range& a, const F& f) {
  const V middle = hn::Mul(splat(0.5), hn::Add(a.lo, a.hi));
  const V reach = hn::Add(hn::Max(hn::Sub(a.hi, middle), hn::Sub(middle, a.lo)), step(magnitude(a)));
  const V most = hn::Add(reach, splat(0x1p-49));
  const V value = f(middle);
  const Range near = outward(hn::Sub(value, most), hn::Add(value, most));
  const Range unit(-1.0, 1.0);
  return where(hn::Lt(magnitude(a), splat(30000.0)), common(unit, near), unit);
}
SDF_INLINE Range sinOf(const Range& a) {
  return wave(a, [](V x) { return hn::Sin(kD, x); });
}
SDF_INLINE Range cosOf(const Range& a) {
  return wave(a, [](V x) { return hn::Cos(kD, x); });
}

SDF_INLINE Interval laneOf(const Range& a, std::size_t k) {
  HWY_ALIGN double lo[kMostLanes], hi[kMostLanes];
  hn::Store(a.lo, kD, lo);
  hn::Store(a.hi, kD, hi);
  return {lo[k], hi[k]};
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();
#endif  // per-target guard
