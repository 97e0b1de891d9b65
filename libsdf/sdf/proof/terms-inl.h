// What proofs know of an instruction's value over prisms or boxes, one in each lane, and each operation on
// it. Re-included once per target by Highway's foreach_target.
#if defined(SDF_PROOF_TERMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_PROOF_TERMS_INL_H
#undef SDF_PROOF_TERMS_INL_H
#else
#define SDF_PROOF_TERMS_INL_H
#endif

#include "sdf/proof/range_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf {
namespace HWY_NAMESPACE {

// Over a prism. Unknown curvature and unknown slopes are infinite.
struct PrismTerm {
  static constexpr bool kFlat = true;
  static constexpr int kPoints = 3;
  Range c[3];  // at the triangle's corners
  Range m;     // over the triangle
  Range s[2];  // slopes over the triangle along its first two sides, from corner 0
  Range h[3];  // second derivatives there: 00, 01, 11
  Range v;     // over the prism
  Range d[3];  // slopes over the prism along the corners' offsets; along o(l) their mean by l
};

struct BoxTerm {
  static constexpr bool kFlat = false;
  static constexpr int kPoints = 1;
  Range c[1];  // at the centre
  Range v;     // over the box
  Range d[3];  // slopes along half its sides
};

template <class T>
T constantTerm(double x) {
  T t{};
  for (Range& c : t.c) c = Range(x);
  t.v = Range(x);
  if constexpr (T::kFlat) t.m = Range(x);
  return t;
}

inline bool isPoint(const Range& a) { return hn::AllTrue(kD, hn::Eq(a.lo, a.hi)); }

// Values over a triangle from those at its corners. For weights l at p, the mean of the corners' values less
// f(p) is half the mean of f's second derivatives along p_i - p, times their squares, taken somewhere
// between. Were they constant, that would be half the sum of l_i l_j q_ij over its sides, q the second
// derivative along a side, and the l_i l_j add up to 1/3 at most; what they differ from their middle by adds
// an eighth of that each way, since the variance of a weight is 1/4 at most.
SDF_INLINE Range bentHull(const PrismTerm& t) {
  const V half = splat(0.5);
  Range middle[3], apart[3];
  for (int k = 0; k < 3; ++k) {
    const V c = hn::Mul(half, hn::Add(t.h[k].lo, t.h[k].hi));
    middle[k] = {c, c};
    const V r = hn::Max(hn::Sub(t.h[k].hi, c), hn::Sub(c, t.h[k].lo));
    apart[k] = {hn::Zero(kD), hn::Add(r, step(magnitude(t.h[k])))};
  }
  const Range third = add(add(middle[0], middle[2]), scale(-2.0, middle[1]));
  const Range most = hull(hull(middle[0], middle[2]), hull(third, Range(0.0)));
  const V more = scale(0.125, add(add(apart[0], apart[2]), scale(2.0, apart[1]))).hi;
  const Range below = add(scale(1.0 / 6.0 * (1.0 + 1e-15), most), symmetric(more));
  const Range bent = sub(hull(hull(t.c[0], t.c[1]), t.c[2]), below);
  const M curved = hn::And(hn::And(isFinite(t.h[0]), isFinite(t.h[1])), isFinite(t.h[2]));
  return where(curved, bent, everything());
}

SDF_INLINE V mostOf(const Range (&d)[3]) {
  return hn::Max(hn::Max(magnitude(d[0]), magnitude(d[1])), magnitude(d[2]));
}

SDF_INLINE void narrow(PrismTerm& t) {
  t.m = common(t.m, bentHull(t));
  t.m = common(t.m, hull(t.c[0], hull(add(t.c[0], t.s[0]), add(t.c[0], t.s[1]))));
  t.v = common(t.v, add(t.m, symmetric(mostOf(t.d))));
}
SDF_INLINE void narrow(BoxTerm& t) {
  const Range way =
      add(symmetric(magnitude(t.d[0])), add(symmetric(magnitude(t.d[1])), symmetric(magnitude(t.d[2]))));
  t.v = common(t.v, add(t.c[0], way));
}

// Each value of r from those of a, and of b and c: f(r's, a's, …) for corners, triangle and prism alike.
template <class T, class F>
SDF_INLINE void eachValue(T& r, const F& f, const T& a) {
  for (int k = 0; k < T::kPoints; ++k) r.c[k] = f(a.c[k]);
  if constexpr (T::kFlat) r.m = f(a.m);
  r.v = f(a.v);
}
template <class T, class F>
SDF_INLINE void eachValue(T& r, const F& f, const T& a, const T& b) {
  for (int k = 0; k < T::kPoints; ++k) r.c[k] = f(a.c[k], b.c[k]);
  if constexpr (T::kFlat) r.m = f(a.m, b.m);
  r.v = f(a.v, b.v);
}
// Each derivative alike: for what is linear.
template <class T, class F>
SDF_INLINE void eachSlope(T& r, const F& f, const T& a, const T& b) {
  for (int k = 0; k < 3; ++k) r.d[k] = f(a.d[k], b.d[k]);
  if constexpr (T::kFlat) {
    for (int k = 0; k < 2; ++k) r.s[k] = f(a.s[k], b.s[k]);
    for (int k = 0; k < 3; ++k) r.h[k] = f(a.h[k], b.h[k]);
  }
}

SDF_INLINE Range addKeepingSign(const Range& a, const Range& b) {
  const Range r = add(a, b);
  const V zero = hn::Zero(kD);
  const M positive = hn::And(hn::Ge(a.lo, zero), hn::Ge(b.lo, zero));
  return {hn::IfThenElse(positive, hn::Max(r.lo, zero), r.lo), r.hi};
}

template <class T>
T negated(const T& a) {
  T r;
  eachValue(
      r, [](const Range& x) { return neg(x); }, a);
  eachSlope(
      r, [](const Range& x, const Range&) { return neg(x); }, a, a);
  return r;
}

template <class T>
T sum(const T& a, const T& b) {
  T r;
  eachValue(r, addKeepingSign, a, b);
  eachSlope(
      r, [](const Range& x, const Range& y) { return add(x, y); }, a, b);
  narrow(r);
  return r;
}

// a less a constant.
template <class T>
T lessConstant(T a, double k) {
  if (k == 0.0) return a;
  eachValue(
      a, [&](const Range& x) { return sub(x, Range(k)); }, T(a));
  return a;
}

constexpr int kFirst[3] = {0, 0, 1}, kSecond[3] = {0, 1, 1};  // of a second derivative

template <class T>
T product(const T& a, const T& b) {
  T r;
  eachValue(
      r, [](const Range& x, const Range& y) { return mul(x, y); }, a, b);
  for (int k = 0; k < 3; ++k) r.d[k] = add(mul(a.v, b.d[k]), mul(b.v, a.d[k]));
  if constexpr (T::kFlat) {
    for (int k = 0; k < 2; ++k) r.s[k] = add(mul(a.m, b.s[k]), mul(b.m, a.s[k]));
    for (int k = 0; k < 3; ++k) {
      const int i = kFirst[k], j = kSecond[k];
      r.h[k] = add(add(mul(a.m, b.h[k]), mul(b.m, a.h[k])), add(mul(a.s[i], b.s[j]), mul(a.s[j], b.s[i])));
    }
  }
  narrow(r);
  return r;
}

// g(a), given g, g' and g'' over ranges.
template <class T, class G, class G1, class G2>
T chained(const T& a, const G& g, const G1& first, const G2& second) {
  T r;
  eachValue(r, g, a);
  const Range overAll = first(a.v);
  for (int k = 0; k < 3; ++k) r.d[k] = mul(overAll, a.d[k]);
  if constexpr (T::kFlat) {
    const Range slope = first(a.m), bend = second(a.m);
    for (int k = 0; k < 2; ++k) r.s[k] = mul(slope, a.s[k]);
    for (int k = 0; k < 3; ++k) {
      const int i = kFirst[k], j = kSecond[k];
      const Range squared = i == j ? square(a.s[i]) : mul(a.s[i], a.s[j]);
      r.h[k] = add(mul(slope, a.h[k]), mul(bend, squared));
    }
  }
  narrow(r);
  return r;
}

template <class T>
T squareOf(const T& a) {
  return chained(
      a, [](const Range& x) { return square(x); }, [](const Range& x) { return scale(2.0, x); },
      [](const Range&) { return Range(2.0); });
}
template <class T>
T sineOf(const T& a) {
  return chained(a, sinOf, cosOf, [](const Range& x) { return neg(sinOf(x)); });
}
template <class T>
T cosineOf(const T& a) {
  const auto minusSin = [](const Range& x) { return neg(sinOf(x)); };
  return chained(a, cosOf, minusSin, [](const Range& x) { return neg(cosOf(x)); });
}
template <class T>
T inverseOf(const T& a) {
  const auto first = [](const Range& x) { return neg(square(inverse(x))); };
  const auto second = [](const Range& x) { return scale(2.0, mul(inverse(x), square(inverse(x)))); };
  return chained(a, inverse, first, second);
}
template <class T>
T rootOf(const T& a) {
  const auto first = [](const Range& x) { return scale(0.5, inverse(sqrt(x))); };
  const auto second = [](const Range& x) {
    const Range root = sqrt(x);
    return scale(-0.25, inverse(mul(root, x)));
  };
  return chained(
      a, [](const Range& x) { return sqrt(x); }, first, second);
}

// x where `first` holds, y where `second` does, and what may be either elsewhere.
SDF_INLINE Range choose(M first, M second, const Range& x, const Range& y, const Range& either) {
  return where(first, x, where(second, y, either));
}

// The slopes of what is a in some places and b in others.
template <class T>
void chooseSlopes(M firstAll, M secondAll, M firstFlat, M secondFlat, const T& a, const T& b, T& r) {
  for (int k = 0; k < 3; ++k) r.d[k] = choose(firstAll, secondAll, a.d[k], b.d[k], hull(a.d[k], b.d[k]));
  if constexpr (T::kFlat) {
    for (int k = 0; k < 2; ++k) r.s[k] = choose(firstFlat, secondFlat, a.s[k], b.s[k], hull(a.s[k], b.s[k]));
    for (int k = 0; k < 3; ++k) r.h[k] = choose(firstFlat, secondFlat, a.h[k], b.h[k], everything());
  }
}

template <class T>
const Range& flatValue(const T& t) {
  if constexpr (T::kFlat)
    return t.m;
  else
    return t.v;
}

SDF_INLINE M below(const Range& a, const Range& b) { return hn::Lt(a.hi, b.lo); }

template <class T>
T smaller(const T& a, const T& b) {
  T r;
  eachValue(
      r, [](const Range& x, const Range& y) { return min(x, y); }, a, b);
  const Range &am = flatValue(a), &bm = flatValue(b);
  chooseSlopes(below(a.v, b.v), below(b.v, a.v), below(am, bm), below(bm, am), a, b, r);
  return r;
}
template <class T>
T larger(const T& a, const T& b) {
  T r;
  eachValue(
      r, [](const Range& x, const Range& y) { return max(x, y); }, a, b);
  const Range &am = flatValue(a), &bm = flatValue(b);
  chooseSlopes(below(b.v, a.v), below(a.v, b.v), below(bm, am), below(am, bm), a, b, r);
  return r;
}
template <class T>
T absolute(const T& a) {
  return larger(a, negated(a));
}

// Of a vector q that is not 0 for sure, whose length is known: q / |q|, one component.
SDF_INLINE Range shareOf(const Range& q, const Range& inverseLength) {
  const V zero = hn::Zero(kD), one = splat(1.0);
  const Range sign{hn::IfThenElse(hn::Ge(q.lo, zero), zero, hn::Neg(one)),
                   hn::IfThenElse(hn::Le(q.hi, zero), zero, one)};
  return common(sign, mul(q, inverseLength));
}

// Slopes of |q| along a direction in which q changes by dq: w · dq with w = q / |q|. They are no larger than
// |dq|, and where all w_i dq_i >= 0 no less than the least |dq_i|, for the |w_i| add up to 1 at least. Where
// w is nearly dq / z, 2 w · dq = z + (|dq|² - |z w - dq|²) / z is the tighter form.
template <int N>
SDF_INLINE Range lengthSlope(const Range (&q)[3], const Range (&dq)[3], const Range& inverseLength) {
  Range along(0.0), squared(0.0), share[3];
  const V zero = hn::Zero(kD);
  V least = infinite();
  for (int i = 0; i < N; ++i) {
    share[i] = shareOf(q[i], inverseLength);
    along = add(along, mul(share[i], dq[i]));
    squared = add(squared, square(dq[i]));
    const V part = hn::IfThenElse(hn::Ge(q[i].lo, zero), dq[i].lo,
                                  hn::IfThenElse(hn::Le(q[i].hi, zero), hn::Neg(dq[i].hi), zero));
    const M none = hn::And(hn::Eq(share[i].lo, zero), hn::Eq(share[i].hi, zero));
    least = hn::IfThenElse(none, least, hn::Min(least, part));
  }
  const V most = sqrt(squared).hi;
  Range apart(0.0);
  const Range z{most, most};
  for (int i = 0; i < N; ++i) apart = add(apart, square(sub(mul(z, share[i]), dq[i])));
  Range r = common(along, symmetric(most));
  r = common(r, scale(0.5, add(z, mul(sub(squared, apart), inverse(z)))));
  const M rises = hn::And(hn::Gt(least, zero), hn::Lt(least, infinite()));
  r.lo = hn::IfThenElse(rises, hn::Max(r.lo, least), r.lo);
  return r;
}

template <int N>
SDF_INLINE Range lengthOf(const Range (&q)[3]) {
  Range squares = square(q[0]);
  for (int i = 1; i < N; ++i) squares = addKeepingSign(squares, square(q[i]));
  return sqrt(squares);
}

struct Components {
  Range q[3];
};

// |q|; `values` are its components, `slopes` what their derivatives are taken from.
template <int N, class T>
T lengthTerm(const T* const (&values)[3], const T* const (&slopes)[3]) {
  T r;
  const auto of = [](const T* const(&all)[3], const auto& member) {
    Components c;
    for (int i = 0; i < N; ++i) c.q[i] = member(*all[i]);
    return c;
  };
  for (int k = 0; k < T::kPoints; ++k) r.c[k] = lengthOf<N>(of(values, [&](const T& t) { return t.c[k]; }).q);
  const auto all = of(values, [](const T& t) { return t.v; });
  r.v = lengthOf<N>(all.q);
  const Range inverseAll = inverse(r.v);
  for (int k = 0; k < 3; ++k)
    r.d[k] = lengthSlope<N>(all.q, of(slopes, [&](const T& t) { return t.d[k]; }).q, inverseAll);
  if constexpr (T::kFlat) {
    const auto flat = of(values, [](const T& t) { return t.m; });
    r.m = lengthOf<N>(flat.q);
    const Range one = inverse(r.m);
    for (int k = 0; k < 2; ++k)
      r.s[k] = lengthSlope<N>(flat.q, of(slopes, [&](const T& t) { return t.s[k]; }).q, one);
    for (int k = 0; k < 3; ++k) {
      const int i = kFirst[k], j = kSecond[k];
      Range dots(0.0), bends(0.0);
      for (int n = 0; n < N; ++n) {
        dots = add(dots, i == j ? square(slopes[n]->s[i]) : mul(slopes[n]->s[i], slopes[n]->s[j]));
        bends = add(bends, mul(shareOf(flat.q[n], one), slopes[n]->h[k]));
      }
      const Range turned = sub(dots, i == j ? square(r.s[i]) : mul(r.s[i], r.s[j]));
      r.h[k] = add(mul(turned, one), bends);
    }
  }
  narrow(r);
  return r;
}

template <class T>
struct BoxParts {
  T outside, inside, most;  // |max(p, 0)|, min(most, 0), the largest p
  T parts[3], clipped[3];   // p and max(p, 0), as far as they are in the length
  bool isInside[3];         // is the part one of those that `most` is the largest of?
  T others[3];              // what it is the largest of besides
  int otherCount;
};

// A box's distance, |max(p, 0)| + min(most, 0): the length where `most` is positive, and that elsewhere;
// where all but one p are below 0 and below that one, it is that one. The sum of the two knows nothing of
// this, and would have slopes from 0 to twice their own.
template <int N, class T>
T boxDistance(const BoxParts<T>& box) {
  T r = sum(box.outside, box.inside);
  const T* const parts[3] = {&box.parts[0], &box.parts[1], &box.parts[2]};
  const T* const clipped[3] = {&box.clipped[0], &box.clipped[1], &box.clipped[2]};
  const T length = lengthTerm<N>(clipped, parts);
  const V zero = hn::Zero(kD);
  const auto isIn = [&](const Range& v) { return hn::Lt(v.hi, zero); };
  const auto isOut = [&](const Range& v) { return hn::Gt(v.lo, zero); };
  // What is in one of the two only must be proven to have no part in the length here.
  M holds = isIn(Range(-1.0)), holdsFlat = holds;
  for (int i = 0; i < N; ++i)
    if (!box.isInside[i]) {
      holds = hn::And(holds, isIn(parts[i]->v));
      holdsFlat = hn::And(holdsFlat, isIn(flatValue(*parts[i])));
    }
  for (int i = 0; i < box.otherCount; ++i) {
    holds = hn::And(holds, isIn(box.others[i].v));
    holdsFlat = hn::And(holdsFlat, isIn(flatValue(box.others[i])));
  }
  T better = r;
  const Range& flat = flatValue(box.most);
  chooseSlopes(isOut(box.most.v), isIn(box.most.v), isOut(flat), isIn(flat), length, box.most, better);
  chooseSlopes(holds, hn::Not(holds), holdsFlat, hn::Not(holdsFlat), better, T(r), r);
  for (int i = 0; i < N; ++i) {
    if (!box.isInside[i]) continue;
    const T& one = *parts[i];
    M alone = holds, aloneFlat = holdsFlat;
    const auto beat = [&](const T& other) {
      const auto loses = [&](const Range& p, const Range& by) { return hn::And(isIn(p), below(p, by)); };
      alone = hn::And(alone, loses(other.v, one.v));
      aloneFlat = hn::And(aloneFlat, loses(flatValue(other), flatValue(one)));
    };
    for (int j = 0; j < N; ++j)
      if (j != i && box.isInside[j]) beat(*parts[j]);
    for (int j = 0; j < box.otherCount; ++j) beat(box.others[j]);
    r.v = where(alone, common(one.v, r.v), r.v);
    chooseSlopes(alone, hn::Not(alone), aloneFlat, hn::Not(aloneFlat), one, T(r), r);
    if constexpr (T::kFlat) r.m = where(aloneFlat, common(one.m, r.m), r.m);
  }
  narrow(r);
  return r;
}

// Narrows the distance d to a corner with the sides x and y and the cosine c: it is x, y, or where p =
// (min(x, y) - c max(x, y)) / s is positive the root of max(x, y)² + p², whose slope is (x' (x - c y) + y' (y
// - c x)) / (s² d). Neither weight is negative there, and they add up to 1 at least and sqrt(2 / (1 + c)) at
// most.
template <class T>
void narrowCorner(double c, const T& x, const T& y, T& r) {
  constexpr double kLess = 1.0 - 1e-9, kMore = 1.0 + 1e-9;  // c and s are off by 1e-10 at most
  const double most = std::sqrt(2.0 / (1.0 + c)) * kMore;
  const V zero = hn::Zero(kD);
  const auto within = [&](const Range& a, const Range& b) {
    const Range h = hull(a, b), larger = scale(most, h), smaller = scale(kLess, h);
    return Range(hn::IfThenElse(hn::Ge(h.lo, zero), smaller.lo, larger.lo),
                 hn::IfThenElse(hn::Le(h.hi, zero), smaller.hi, larger.hi));
  };
  for (int k = 0; k < 3; ++k) r.d[k] = common(r.d[k], within(x.d[k], y.d[k]));
  if constexpr (T::kFlat)
    for (int k = 0; k < 2; ++k) r.s[k] = common(r.s[k], within(x.s[k], y.s[k]));
  narrow(r);
}

// Narrows by what is proven of the slope over all of space; `ways` are the lengths of the slopes' directions.
template <class T>
void narrowSlopes(double slope, const V (&ways)[3], const V (&sides)[2], T& r) {
  const V most = splat(slope);
  for (int k = 0; k < 3; ++k) r.d[k] = common(r.d[k], symmetric(hn::Mul(most, ways[k])));
  if constexpr (T::kFlat)
    for (int k = 0; k < 2; ++k) r.s[k] = common(r.s[k], symmetric(hn::Mul(most, sides[k])));
  narrow(r);
}

// Narrows a quadratic blend of x and y by what its slope is, the mean w dx + (1 - w) dy, and its curvature,
// w d²x + (1 - w) d²y + w' (dx - dy)², where w falls from 1 to 0 (rises, of a maximum) by 1 / 2k as x - y
// goes from -k to k.
template <class T>
void narrowBlend(double k, bool isMin, const T& x, const T& y, T& r) {
  const Range steep = inverse(Range(2.0 * k));
  const auto unclamped = [&](const Range& a, const Range& b) {
    const Range t = mul(steep, sub(a, b));
    return isMin ? sub(Range(0.5), t) : add(Range(0.5), t);
  };
  // Of the constants' rounding; w itself never leaves 0 to 1 by more.
  const V slack = splat(0x1p-40), zero = hn::Zero(kD), one = splat(1.0);
  const auto clamped = [&](const Range& w) {
    const auto unit = [&](V v) { return hn::Min(hn::Max(v, zero), one); };
    return Range(hn::Sub(unit(w.lo), slack), hn::Add(unit(w.hi), slack));
  };
  // Linear in w for all a and b: the extremes are at its ends.
  const auto mix = [](const Range& w, const Range& a, const Range& b) {
    const auto at = [&](V share) {
      const Range part{share, share};
      return add(mul(part, a), mul(sub(Range(1.0), part), b));
    };
    return hull(at(w.lo), at(w.hi));
  };
  const Range all = clamped(unclamped(x.v, y.v));
  for (int i = 0; i < 3; ++i) r.d[i] = common(r.d[i], mix(all, x.d[i], y.d[i]));
  if constexpr (T::kFlat) {
    const Range raw = unclamped(x.m, y.m), w = clamped(raw);
    for (int i = 0; i < 2; ++i) r.s[i] = common(r.s[i], mix(w, x.s[i], y.s[i]));
    // Between its ends the blend bends all over, beyond them nowhere.
    const M always = hn::And(hn::Gt(raw.lo, slack), hn::Lt(raw.hi, hn::Sub(one, slack)));
    const M ever = hn::And(hn::Ge(raw.hi, hn::Neg(slack)), hn::Le(raw.lo, hn::Add(one, slack)));
    const Range share{hn::IfThenElse(always, one, zero), hn::IfThenElse(ever, one, zero)};
    const Range bend = mul(isMin ? neg(share) : share, steep);
    for (int n = 0; n < 3; ++n) {
      const int i = kFirst[n], j = kSecond[n];
      const Range di = sub(x.s[i], y.s[i]), dj = sub(x.s[j], y.s[j]);
      r.h[n] = add(mix(w, x.h[n], y.h[n]), mul(bend, i == j ? square(di) : mul(di, dj)));
    }
  }
  narrow(r);
}

}  // namespace HWY_NAMESPACE
}  // namespace sdf
HWY_AFTER_NAMESPACE();
#endif  // per-target guard
