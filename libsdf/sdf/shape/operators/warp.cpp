// Twist, taper and bend.
//
// With f the operand and T the map from the result's space back to the operand's, f(T(p)) has the right sign
// and zeros; calibrated() makes a distance of it wherever T is tame. Two ways keep it so everywhere.
//
// Project (twist, taper): p is first moved to a convex region around the solid, and the way there is the side
// of a box whose other side is the distance from there. A projection to a convex set and the way to it move
// no two points apart, so this is no steeper; its zero set is the solid's.
//
// Cap (bend): where T tears or stretches without limit, T(p) is farther than some g from the operand's
// bounds, so that f(T(p)) > g / growth there. The least of the distance and a constant that it exceeds
// wherever that holds hides the tear.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/calibrate/calibrate.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/operators/deform.h"

namespace sdf {

namespace {

// How far beyond the bounds the projection begins, as a share of their size.
constexpr double kMargin = 0.5;

// Largest singular value of [[a, b], [0, c]], from the eigenvalues of its square.
Expr largestSingular(const Expr& a, const Expr& b, const Expr& c) {
  const Expr sum = square(a) + square(b) + square(c);
  return sqrt((sum + sqrt(max(square(sum) - 4.0 * square(a * c), 0.0))) * 0.5);
}
Expr stretchOf(const Expr& a, const Expr& b) { return largestSingular(a, b, 1.0); }

bool finiteAlong(const Box& b, int axis) { return b.min[axis] > -kInfinity && b.max[axis] < kInfinity; }
double farthestAlong(const Box& b, int axis) {
  return std::max(std::abs(b.min[axis]), std::abs(b.max[axis]));
}

// The heights of the bounds and `margin` beyond, where they end.
Interval heightsAround(const Box& b, double margin) { return {b.min.y - margin, b.max.y + margin}; }
Expr clampedTo(const Expr& x, const Interval& ends) {
  const Expr above = ends.lo > -kInfinity ? max(x, ends.lo) : x;
  return ends.hi < kInfinity ? min(above, ends.hi) : above;
}
Expr outsideOf(const Expr& x, const Interval& ends) {
  const bool ended = ends.lo > -kInfinity || ends.hi < kInfinity;
  return ended ? outsideSlab(x, ends.lo, ends.hi) : Expr(-kInfinity);
}

// The warped shape where nothing is proven of it.
Shape asField(Shape warped) {
  warped.claim = {ClaimKind::Field, kInfinity};
  return settled(std::move(warped));
}

// The warped shape from its distance at the nearest point of a convex region, the last of `sides`, and how
// far a point is beyond that, the others. The nearest point of a convex set and the way to it are 1-Lipschitz
// together, so that the length of both is no steeper than the one; `shear` says how much steeper where points
// are moved otherwise. Far outside the solid is no nearer than `outside` and its bounds say.
Shape within(Shape warped, const std::vector<Expr>& sides, double shear, const std::optional<Expr>& outside) {
  std::vector<Expr> all;
  for (const Expr& side : sides)
    if (!side.isConstant(-kInfinity)) all.push_back(side);
  const double slope = std::max(1.0, all.back().lipschitz()) * shear;
  Expr distance = all.size() == 1 ? all[0] : boxDistance(all, slope);
  // Calibrated distances fall short beside edges: a bound of full slope would cut what is rounded there.
  constexpr double kShare = 0.75;
  const auto keepBeyond = [&](const Expr& out) { distance = max(distance, min(out, out * kShare)); };
  if (outside) keepBeyond(*outside);
  const Vec3E p = position();
  const Box& b = warped.bounds;
  for (int i = 0; i < 3; ++i)
    if ((!outside || i == 1) && (b.min[i] > -kInfinity || b.max[i] < kInfinity))
      keepBeyond(outsideSlab(component(p, i), b.min[i], b.max[i]));
  warped.distance = distance;
  warped.claim = {ClaimKind::Field, slope, 1.0 / kShare, true};
  return settled(std::move(warped));
}

// Below it the bend is less than what rounding moves, and its radius more than a float can be.
constexpr double kSlightest = 1e-30;

// The box around the bent box: around the centre (0, 1/k), the sector of angles u = k [x0, x1] and radii 1/k
// - [y0, y1]. A point of it is (sin u / k - y sin u, (1 - cos u) / k + y cos u); 1 - cos u is written as 2
// sin^2 (u / 2), or a slight bend would leave nothing of y.
Box bentBox(const Box& b, double k) {
  const double from = std::min(k * b.min.x, k * b.max.x), to = std::max(k * b.min.x, k * b.max.x);
  Box box{glm::dvec3(kInfinity, kInfinity, b.min.z), glm::dvec3(-kInfinity, -kInfinity, b.max.z)};
  const auto take = [&](double sine, double cosine, double halfSine) {
    for (const double y : {b.min.y, b.max.y}) {
      const auto along = [&](double u) { return u == 0.0 ? 0.0 : u * y; };
      const glm::dvec3 q(sine / k - along(sine), 2.0 * halfSine * halfSine / k + along(cosine), b.min.z);
      box = {glm::min(box.min, q), glm::max(box.max, glm::dvec3(q.x, q.y, b.max.z))};
    }
  };
  for (const double end : {from, to}) take(std::sin(end), std::cos(end), std::sin(0.5 * end));
  for (int quarter = -1; quarter <= 1; ++quarter)  // the extremes of sine and cosine within a turn
    if (from < quarter * std::numbers::pi / 2 && quarter * std::numbers::pi / 2 < to)
      take(quarter, quarter == 0 ? 1.0 : 0.0, quarter / std::numbers::sqrt2);
  return box;
}

// For any curvature: |sin(kx) / k| and |(1 - cos(kx)) / k| are at most |x|, and y is turned.
Box bentBoxForAny(const Box& b) {
  const double reach = farthestAlong(b, 0) + farthestAlong(b, 1);
  return {{-reach, -reach, b.min.z}, {reach, reach, b.max.z}};
}

// A lower bound of what the expression is where the coordinates keep within the box, and are numbers whose
// squares are: at infinity gradients are not.
double leastOver(const Expr& e, const Box& box) {
  constexpr double kFarthest = 1e30;
  Vec3E p = position();
  for (int i = 0; i < 3; ++i)
    component(p, i) =
        clampedTo(component(p, i), {std::max(box.min[i], -kFarthest), std::min(box.max[i], kFarthest)});
  const Interval range = remap(e, {p.x, p.y, p.z}, kInfinity).range();
  return range.nan ? 0.0 : range.lo;
}

// A lower bound of a distance to what is to be bent, told where it is straight, over all that lies half a
// turn away or as close to the centre as `fold`. Far on the other side the map shrinks to nothing, so that
// side is taken apart.
double leastWhereTorn(const Expr& straight, const Box& b, double k, double fold) {
  const double end = std::numbers::pi / std::abs(k),
               away = k > 0.0 ? b.min.y - sizeOf(b) : b.max.y + sizeOf(b);
  Box centre = Box::everything(), outer = centre;
  (k > 0.0 ? centre.min : centre.max).y = fold / k;
  (k > 0.0 ? outer.max : outer.min).y = away;
  Box left{glm::dvec3(-kInfinity), glm::dvec3(-end, kInfinity, kInfinity)};
  (k > 0.0 ? left.min : left.max).y = away;
  Box right = left;
  right.min.x = end, right.max.x = kInfinity;
  double least = kInfinity;
  for (const Box& torn : {centre, outer, left, right}) least = std::min(least, leastOver(straight, torn));
  return least;
}

// What makes the bend impossible over the curvature's range. `folding` is the largest curvature y within the
// bounds.
Check& checkBend(Check& check, const Box& b, double most, double folding) {
  const double half = farthestAlong(b, 0);
  check.that(finiteAlong(b, 0), "the shape is unbounded in x; intersect it with a box first");
  check.that(folding < kInfinity,
             "the shape is unbounded in y, where it would fold; intersect it with a box first");
  check.that(folding < 1.0, "the shape would fold: it reaches the circle's centre, " + shown(1.0 / most) +
                                " from the x axis; use a rate nearer to 0 or make it thinner");
  return check.that(most * half < std::numbers::pi, "the ends would pass each other: the shape reaches " +
                                                        shown(half) + " along x, and half a turn ends at " +
                                                        shown(std::numbers::pi / most) +
                                                        "; use a rate nearer to 0");
}

}  // namespace

Shape twist(const Shape& shape, const Expr& rate) {
  Check check("twist", shape);
  if (!wantsSolid(check, shape).any("rate", rate).ok()) return check.failure();
  if (rate.isConstant(0.0)) return shape;
  const Box& b = shape.bounds;
  const double radius = radiusAbout(b, 1), reach = radius * (1.0 + kMargin);
  const bool known = radius > 0.0 && std::isfinite(radius) && std::isfinite(slopeOf(shape));
  const Interval ends = heightsAround(b, radius);
  const Vec3E p = position();
  const Expr y = known ? clampedTo(p.y, ends) : p.y;
  const Expr r = length(p.x, p.z).claimLipschitz(1.0);
  const Expr inward = known ? Expr(reach) / max(r, reach) : Expr(1.0);
  const Expr angle = y * rate, c = cos(angle), s = sin(angle);
  const Expr x = p.x * inward, z = p.z * inward;
  const Vec3E back{x * c - z * s, y, x * s + z * c};
  Shape warped = movedTo(shape, back, kInfinity);
  warped.bounds = {{-radius, b.min.y, -radius}, {radius, b.max.y, radius}};
  if (!known) return asField(std::move(warped));
  const auto pulled = [=](const Vec3E& n) -> Vec3E {
    return {n.x, n.y + rate * (scaled(p.x, n.z) - scaled(p.z, n.x)), n.z};
  };
  const Box region{{-reach, ends.lo, -reach}, {reach, ends.hi, reach}};
  const Expr most = stretchOf(1.0, rate * min(r, reach));
  const Expr d =
      calibrated(shape.distance, {back, pulled, 1.0, most, 1.0 / most, region, r - reach, sizeOf(b)});
  return within(std::move(warped), {r - reach, outsideOf(p.y, ends), d}, 1.0, r - radius);
}

Shape taper(const Shape& shape, const Expr& rate) {
  Check check("taper", shape);
  wantsSolid(check, shape).any("rate", rate);
  const Box& b = shape.bounds;
  check.that(finiteAlong(b, 1), "the shape is unbounded in y; intersect it with a box first");
  if (!check.ok()) return check.failure();
  if (rate.isConstant(0.0)) return shape;
  const Interval& range = rate.range();
  const auto factors = [&](double lo, double hi) {
    const Interval change = hull(timesRange(range, lo, lo), timesRange(range, hi, hi));
    return Interval(1.0 + change.lo, 1.0 + change.hi);
  };
  const double least = factors(b.min.y, b.max.y).lo, steepness = range.magnitude();
  const double end = 1.0 + range.lo * b.max.y < 1.0 + range.hi * b.min.y ? b.max.y : b.min.y;
  check.that(least > 0.0, "the cross section shrinks to nothing before y = " + shown(end) +
                              ", within the shape; use a rate nearer to 0");
  if (!check.ok()) return check.failure();
  const double radius = radiusAbout(b, 1), reach = radius * (1.0 + kMargin);
  const Interval ends = heightsAround(b, std::min(radius, 0.5 * least / steepness));
  const bool known = radius > 0.0 && std::isfinite(radius) && std::isfinite(slopeOf(shape));
  const auto factorAt = [&](const Expr& y) { return rate * y + 1.0; };
  const Vec3E p = position();
  const Expr y = clampedTo(p.y, ends), factor = factorAt(y);
  const Expr r = length(p.x, p.z).claimLipschitz(1.0), side = factor * reach;
  const Expr inward = known ? reach / max(r, side) : 1.0 / factor;
  const Vec3E back{p.x * inward, y, p.z * inward};
  Shape warped = movedTo(shape, back, kInfinity);
  const Expr widest = max(factorAt(b.min.y), factorAt(b.max.y)) * radius;
  const double most = widest.range().hi;
  warped.bounds = {{-most, b.min.y, -most}, {most, b.max.y, most}};
  if (!known) return asField(std::move(warped));
  const Expr once = 1.0 / factorAt(p.y);
  const auto pulled = [=](const Vec3E& n) -> Vec3E {
    return {scaled(once, n.x), n.y - rate * once * (scaled(p.x, n.x) + scaled(p.z, n.z)), scaled(once, n.z)};
  };
  const Box region{{-reach, ends.lo, -reach}, {reach, ends.hi, reach}};
  const Expr sheared = largestSingular(1.0, rate * min(r, reach), factorAt(p.y));
  const Expr d = calibrated(
      shape.distance, {back, pulled, once, sheared, factorAt(p.y) / sheared, region, r - reach, sizeOf(b)});
  // Across the cone of this slope points are moved to it along the radius, not along its normal: a shear.
  const Expr slope = rate * reach, aside = 1.0 / sqrt(square(slope) + 1.0);
  const double shear = stretchOf(1.0, slope).range().hi;
  return within(std::move(warped), {(r - side) * aside, outsideOf(p.y, ends), d}, shear, r - widest);
}

Shape bend(const Shape& straight, const Expr& curvature) {
  Check check("bend", straight);
  if (!wantsSolid(check, straight).any("curvature", curvature).ok()) return check.failure();
  if (curvature.isConstant() && std::abs(curvature.constantValue()) < kSlightest) return straight;
  const Shape shape = withGrowth(straight);
  const Box& b = shape.bounds;
  const double most = curvature.range().magnitude();
  const double folding = std::max(0.0, timesRange(curvature.range(), b.min.y, b.max.y).hi);
  if (!checkBend(check, b, most, folding).ok()) return check.failure();

  const Expr k = keptFromZero(curvature);
  const Vec3E p = position();
  const Expr sideways = p.x * k, up = 1.0 - p.y * k;
  const Expr ratio = sqrt(square(sideways) + square(up));  // distance from the bend's centre, in radii
  const Expr x = atan2(sideways, up) * (1.0 / k);
  // (1 - ratio) / k without the cancellation that a slight bend would suffer.
  const Expr y = ((p.y * 2.0 - (square(p.x) + square(p.y)) * k) / (ratio + 1.0)).claimLipschitz(1.0);
  const Vec3E back{x, y, p.z};
  Shape warped = movedTo(shape, back, kInfinity);
  warped.bounds = curvature.range().isPoint() ? bentBox(b, k.range().lo) : bentBoxForAny(b);

  const double growth = growthOf(shape.claim);
  if (!std::isfinite(growth * slopeOf(shape))) return asField(std::move(warped));
  const double gap = std::min(std::numbers::pi / most - farthestAlong(b, 0), 0.5 * (1.0 - folding) / most);
  Expr fold = abs(k) * gap;
  for (const double end : {b.min.y, b.max.y})
    if (std::isfinite(end)) fold = max(fold, abs(k) * gap + k * end);
  const Expr steepest = 1.0 / (1.0 - fold);
  const Expr across = 1.0 / max(1.0 - p.y * k, 1.0 - fold);
  const auto pulled = [=](const Vec3E& n) -> Vec3E { return {scaled(across, n.x), n.y, n.z}; };
  const auto bent = [&](const Vec3E& from, double reach, double cap) {
    Box region = grow(b, reach);
    if (k.range().isPoint()) {
      const double centre = fold.range().lo / k.range().lo;
      (centre > 0.0 ? region.max : region.min).y = centre;
    }
    return calibrated(shape.distance, {from, pulled, 1.0, max(across, 1.0), min(across, 1.0), region, -1.0,
                                       sizeOf(b), gap, cap});
  };
  // The operand's distance is at least gap / growth where T tears or stretches without limit, so that the
  // result's is at least that much less stretched; or what it is over all that lies there.
  const double stretch = steepest.range().hi;
  double cap = gap / growth / stretch;
  const auto upTo = [&](double most) { return bent(back, most * growth * stretch, most); };
  Expr d = upTo(cap);
  if (k.range().isPoint() && std::isfinite(farthestAlong(b, 1))) {
    // As far as may be, or at least as far as offsets are wanted, unless its slope is the price.
    constexpr double kModerate = 6.0, kMuchSteeper = 2.0, kWanted = 0.1;
    const double least = leastWhereTorn(bent(p, gap, kInfinity), b, k.range().lo, fold.range().lo);
    for (const double most : {least, std::min(least, kWanted * sizeOf(b))}) {
      if (most <= cap) continue;
      const Expr farther = upTo(most);
      if (farther.lipschitz() > std::max(kModerate, kMuchSteeper * d.lipschitz())) continue;
      d = farther, cap = most;
      break;
    }
  }
  return within(std::move(warped), {min(d, cap)}, 1.0, {});
}

}  // namespace sdf
