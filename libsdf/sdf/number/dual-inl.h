// Dual numbers: a value and N exact partial derivatives (forward-mode differentiation; Clifford 1873, Wengert
// 1964).
//
// T is double, Interval, or a SIMD vector of lanes. At a crease one side's derivative is taken: for abs at 0
// the right one, for min and max that of the argument which gives the value, on a tie the first (so that
// max(distance, 0) keeps the distance's on its surface). Where the tangent is vertical (sqrt and powers below
// 1 at 0, asin and acos at 1) the derivative is defined as 0, so length(max(q, 0)) has a gradient everywhere.
// Over intervals the derivative encloses every derivative and every difference quotient, jumps included; over
// intervals of a function that is known not to jump those of the pieces alone.
//
// Re-included once per SIMD target by Highway's foreach_target.
#if defined(SDF_NUMBER_DUAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_NUMBER_DUAL_INL_H
#undef SDF_NUMBER_DUAL_INL_H
#else
#define SDF_NUMBER_DUAL_INL_H
#endif

#include <cmath>
#include <type_traits>

#include "sdf/number/interval.h"
#include "sdf/number/scalar.h"

#ifdef HWY_NAMESPACE
HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {
#else
namespace sdf {
#endif

template <class T, int N>
struct Dual {
  T v;
  T d[N];
};

// T, told by the other arguments.
template <class T>
using Of = std::type_identity_t<T>;

template <class D>
inline constexpr bool kIsDual = false;
template <class T, int N>
inline constexpr bool kIsDual<Dual<T, N>> = true;
template <class D>
concept AnyDual = kIsDual<D>;

/// f(a) given the value and the derivative of f at a.v.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& a, const Of<T>& value, const Of<T>& slope) {
  Dual<T, N> r{value, {}};
  for (int i = 0; i < N; ++i) r.d[i] = mul(slope, a.d[i]);
  return r;
}

/// f(a, b) given the value and both partial derivatives.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& a, const Dual<T, N>& b, const Of<T>& value, const Of<T>& slopeA,
                 const Of<T>& slopeB) {
  Dual<T, N> r{value, {}};
  for (int i = 0; i < N; ++i) r.d[i] = mulAdd(slopeA, a.d[i], mul(slopeB, b.d[i]));
  return r;
}

/// f(a, b, c) given the value and its partial derivatives.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& a, const Dual<T, N>& b, const Dual<T, N>& c, const Of<T>& value,
                 const Of<T>& slopeA, const Of<T>& slopeB, const Of<T>& slopeC) {
  Dual<T, N> r = chain(a, b, value, slopeA, slopeB);
  for (int i = 0; i < N; ++i) r.d[i] = mulAdd(slopeC, c.d[i], r.d[i]);
  return r;
}

/// Derivative of a step function with this value, given the derivatives of its arguments: 0, or over
/// intervals unbounded where it may jump. Where no argument moves there is no jump.
template <class T, class... Slopes>
T jump(const T& value, const T& first, const Slopes&... others) {
  T still = equal(first, T(0.0));
  ((still = min(still, equal(others, T(0.0)))), ...);
  return select(still, T(0.0), stepSlope(value));
}

/// A value without a slope, or of unbounded slope where it jumps.
template <class T, int N, class... Others>
Dual<T, N> step(const Of<T>& value, const Dual<T, N>& first, const Others&... others) {
  Dual<T, N> r{value, {}};
  for (int i = 0; i < N; ++i) r.d[i] = jump(value, first.d[i], others.d[i]...);
  return r;
}

/// `smooth` with the slope of a step function of this value added.
template <class T, int N, class... Args>
Dual<T, N> withJumps(Dual<T, N> smooth, const Of<T>& value, const Args&... args) {
  for (int i = 0; i < N; ++i) smooth.d[i] = add(smooth.d[i], jump(value, args.d[i]...));
  return smooth;
}

/// The value, with a's slope where `first` holds and b's elsewhere.
template <class T, int N>
Dual<T, N> either(const Of<T>& value, const Of<T>& first, const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> r{value, {}};
  for (int i = 0; i < N; ++i) r.d[i] = select(first, a.d[i], b.d[i]);
  return r;
}

/// 1 where the value is finite, 0 where it may be infinite (max takes NaN away).
template <class T>
T isFinite(const T& value) {
  return less(max(abs(value), T(0.0)), T(HUGE_VAL));
}

/// 1 / x, and 0 at 0: the slope that functions with a vertical tangent are given there.
template <class T>
T inverseOrZero(const T& x) {
  return select(less(T(0.0), x), div(T(1.0), x), T(0.0));
}

template <class T, int N>
Dual<T, N> constant(const T& value) {
  Dual<T, N> r{value, {}};
  for (int i = 0; i < N; ++i) r.d[i] = T(0.0);
  return r;
}

template <class T, int N>
Dual<T, N> neg(const Dual<T, N>& a) {
  Dual<T, N> r{neg(a.v), {}};
  for (int i = 0; i < N; ++i) r.d[i] = neg(a.d[i]);
  return r;
}
template <class T, int N>
Dual<T, N> abs(const Dual<T, N>& a) {
  return chain(a, abs(a.v), select(less(a.v, T(0.0)), T(-1.0), T(1.0)));
}
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& a) {
  const T root = sqrt(a.v);
  return chain(a, root, select(less(T(0.0), root), div(T(0.5), root), T(0.0)));
}
auto square(const AnyDual auto& a) { return chain(a, square(a.v), add(a.v, a.v)); }
auto sin(const AnyDual auto& a) { return chain(a, sin(a.v), cos(a.v)); }
auto cos(const AnyDual auto& a) { return chain(a, cos(a.v), neg(sin(a.v))); }
template <class T, int N>
Dual<T, N> tan(const Dual<T, N>& a) {
  const T t = tan(a.v);
  // Across a pole the value falls while the slope is positive on both sides.
  return withJumps(chain(a, t, add(T(1.0), square(t))), isFinite(t), a);
}
template <class T, int N>
Dual<T, N> asin(const Dual<T, N>& a) {
  return chain(a, asin(a.v), inverseOrZero(sqrt(sub(T(1.0), square(a.v)))));
}
template <class T, int N>
Dual<T, N> acos(const Dual<T, N>& a) {
  return chain(a, acos(a.v), neg(inverseOrZero(sqrt(sub(T(1.0), square(a.v))))));
}
template <class T, int N>
Dual<T, N> atan(const Dual<T, N>& a) {
  return chain(a, atan(a.v), div(T(1.0), add(T(1.0), square(a.v))));
}
template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& a) {
  const T e = exp(a.v);
  return chain(a, e, e);
}
template <class T, int N>
Dual<T, N> log(const Dual<T, N>& a) {
  return chain(a, log(a.v), div(T(1.0), a.v));
}
auto floor(const AnyDual auto& a) { return step(floor(a.v), a); }
auto ceil(const AnyDual auto& a) { return step(ceil(a.v), a); }
auto round(const AnyDual auto& a) { return step(round(a.v), a); }
template <class T, int N>
Dual<T, N> add(const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> r{add(a.v, b.v), {}};
  for (int i = 0; i < N; ++i) r.d[i] = add(a.d[i], b.d[i]);
  return r;
}
template <class T, int N>
Dual<T, N> sub(const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> r{sub(a.v, b.v), {}};
  for (int i = 0; i < N; ++i) r.d[i] = sub(a.d[i], b.d[i]);
  return r;
}
auto mul(const AnyDual auto& a, const AnyDual auto& b) { return chain(a, b, mul(a.v, b.v), b.v, a.v); }
template <class T, int N>
Dual<T, N> div(const Dual<T, N>& a, const Dual<T, N>& b) {
  const T q = div(a.v, b.v), inverse = div(T(1.0), b.v);
  return chain(a, b, q, inverse, neg(mul(q, inverse)));
}
auto min(const AnyDual auto& a, const AnyDual auto& b) {
  return either(min(a.v, b.v), lessEqual(a.v, b.v), a, b);
}
auto max(const AnyDual auto& a, const AnyDual auto& b) {
  return either(max(a.v, b.v), lessEqual(b.v, a.v), a, b);
}
template <class T, int N>
Dual<T, N> pow(const Dual<T, N>& a, const Dual<T, N>& b) {
  const T p = pow(a.v, b.v);
  // At base 0 the tangent is vertical for exponents in (0, 1), and of no use below.
  const T slopeA =
      select(min(equal(a.v, T(0.0)), less(b.v, T(1.0))), T(0.0), mul(b.v, pow(a.v, sub(b.v, T(1.0)))));
  // d/db = p ln a. Where a < 0 there is a value at whole exponents alone: one that moves can only jump.
  // pow(0, b) has a step at b = 0.
  const T noLogarithm = select(less(a.v, T(0.0)), stepSlope(b.v), stepSlope(less(T(0.0), b.v)));
  const T slopeB = select(less(T(0.0), a.v), mul(p, log(a.v)), noLogarithm);
  const T noPole = max(isFinite(p), lessEqual(T(0.0), b.v));
  return withJumps(chain(a, b, p, slopeA, slopeB), noPole, a, b);
}
template <class T, int N>
Dual<T, N> atan2(const Dual<T, N>& y, const Dual<T, N>& x) {
  const T square2 = squareAdd(x.v, square(y.v)), inverse = inverseOrZero(square2);
  Dual<T, N> r = chain(y, x, atan2(y.v, x.v), mul(x.v, inverse), neg(mul(y.v, inverse)));
  // Jumps: through the origin, and across the cut along the negative x axis, approached from below and, where
  // y only touches it, from above.
  const T left = less(x.v, T(0.0)), away = less(T(0.0), square2);
  const T below = select(left, less(y.v, T(0.0)), T(0.0)),
          above = select(left, lessEqual(y.v, T(0.0)), T(0.0));
  for (const T& side : {away, below, above}) r = withJumps(r, side, y, x);
  return r;
}
template <class T, int N>
Dual<T, N> mod(const Dual<T, N>& a, const Dual<T, N>& b) {
  const T turns = floor(div(a.v, b.v));
  return withJumps(chain(a, b, mod(a.v, b.v), T(1.0), neg(turns)), turns, a, b);
}
auto less(const AnyDual auto& a, const AnyDual auto& b) { return step(less(a.v, b.v), a, b); }
auto lessEqual(const AnyDual auto& a, const AnyDual auto& b) { return step(lessEqual(a.v, b.v), a, b); }
auto equal(const AnyDual auto& a, const AnyDual auto& b) { return step(equal(a.v, b.v), a, b); }
template <class T, int N>
Dual<T, N> select(const Dual<T, N>& c, const Dual<T, N>& a, const Dual<T, N>& b) {
  Dual<T, N> r{select(c.v, a.v, b.v), {}};
  // Branches meet where the condition does not move.
  for (int i = 0; i < N; ++i)
    r.d[i] = select(equal(c.d[i], T(0.0)), select(c.v, a.d[i], b.d[i]), choiceSlope(c.v, a.d[i], b.d[i]));
  return r;
}
auto mulAdd(const AnyDual auto& a, const AnyDual auto& b, const AnyDual auto& c) { return add(mul(a, b), c); }
template <class T, int N>
Dual<T, N> squareAdd(const Dual<T, N>& a, const Dual<T, N>& c) {
  Dual<T, N> r = add(square(a), c);
  r.v = squareAdd(a.v, c.v);
  return r;
}

template <class T>
T lengthOf(const T& a, const T& b) {
  return sqrt(squareAdd(a, square(b)));
}
template <class T>
T lengthOf(const T& a, const T& b, const T& c) {
  return sqrt(squareAdd(a, squareAdd(b, square(c))));
}

/// Over intervals a length changes by no more than its parts together do, and by the share that each has of
/// it: also where it may be 0, where the root's slope says nothing.
template <AnyInterval T, int N, class... Parts>
Dual<T, N> lengthOfParts(const Parts&... parts) {
  Dual<T, N> r{lengthOf<Interval>(parts.v...), {}};
  for (int i = 0; i < N; ++i) {
    Interval along(0.0);
    ((along = mulAdd(shareOf(parts.v, r.v), parts.d[i], along)), ...);
    const double most = lengthOf<Interval>(parts.d[i]...).hi;
    r.d[i] =
        along.nan ? Interval::everything() : Interval(std::max(along.lo, -most), std::min(along.hi, most));
  }
  return r;
}
template <AnyInterval T, int N>
Dual<T, N> lengthOf(const Dual<T, N>& a, const Dual<T, N>& b) {
  return lengthOfParts<T, N>(a, b);
}
template <AnyInterval T, int N>
Dual<T, N> lengthOf(const Dual<T, N>& a, const Dual<T, N>& b, const Dual<T, N>& c) {
  return lengthOfParts<T, N>(a, b, c);
}

#ifdef HWY_NAMESPACE
}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();
#else
}  // namespace sdf
#endif
#endif  // per-target guard
