// Twist, taper and bend.
//
// With f the operand, La its constant, T the map from the result's space back to the operand's and L the
// largest singular value of T's Jacobian, f(T(p)) / (La L) is a bound wherever all of that holds. Two ways
// make it hold everywhere.
//
// Clamp (twist, taper): p is first projected to a convex region that contains the solid, and the result is
// max(f(T(proj p)) / (La L), d) with d 1-Lipschitz, negative inside the region and positive outside. A
// projection to a convex set moves no two points apart, so this is 1-Lipschitz; its zero set is the solid's.
//
// Cap (bend): where T tears or stretches without limit, T(p) is farther than some g from the operand's
// bounds, so that f(T(p)) > c = g / growth there. min(f(T(p)), c) is then the constant c, which hides the
// tear.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/deform.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

constexpr double kPi = std::numbers::pi;
// How far beyond the bounds the clamp begins, as a share of their size: near the surface the distance is f(T)
// / L alone.
constexpr double kMargin = 1.0 / 16.0;

// Largest singular value of [[a, b], [0, 1]], from the eigenvalues of its square. Like all constants here it
// is an expression: a slider that stands at a slight twist pays for a slight one.
Expr stretchOf(const Expr& a, const Expr& b) {
  const Expr sum = square(a) + square(b) + 1.0;
  return sqrt((sum + sqrt(max(square(sum) - 4.0 * square(a), 0.0))) * 0.5);
}

bool finiteAlong(const Box& b, int axis) { return b.min[axis] > -kInfinity && b.max[axis] < kInfinity; }
double farthestAlong(const Box& b, int axis) {
  return std::max(std::abs(b.min[axis]), std::abs(b.max[axis]));
}

// The warped shape where nothing is proven of it.
Shape asField(Shape warped) {
  warped.claim = {ClaimKind::Field, kInfinity};
  return settled(std::move(warped));
}

// The warped shape with a distance that is proven to be 1-Lipschitz everywhere.
Shape withProvenBound(Shape warped, const Expr& distance, double growth) {
  warped.distance = distance;
  warped.claim = {ClaimKind::Bound, 1.0, growth};
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
    if (from < quarter * kPi / 2 && quarter * kPi / 2 < to)
      take(quarter, quarter == 0 ? 1.0 : 0.0, quarter / std::numbers::sqrt2);
  return box;
}

// For any curvature: |sin(kx) / k| and |(1 - cos(kx)) / k| are at most |x|, and y is turned.
Box bentBoxForAny(const Box& b) {
  const double reach = farthestAlong(b, 0) + farthestAlong(b, 1);
  return {{-reach, -reach, b.min.z}, {reach, reach, b.max.z}};
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
  return check.that(most * half < kPi, "the ends would pass each other: the shape reaches " + shown(half) +
                                           " along x, and half a turn ends at " + shown(kPi / most) +
                                           "; use a rate nearer to 0");
}

}  // namespace

Shape twist(const Shape& shape, const Expr& rate) {
  Check check("twist", shape);
  if (!wantsSolid(check, shape).any("rate", rate).ok()) return check.failure();
  if (rate.isConstant(0.0)) return shape;
  const Vec3E p = position();
  const double radius = radiusAbout(shape.bounds, 1) * (1.0 + kMargin);
  const double steepest = slopeOf(shape);
  const bool known = radius > 0.0 && std::isfinite(radius) && std::isfinite(steepest);
  const Expr r = length(p.x, p.z).claimLipschitz(1.0);
  const Expr inward = known ? Expr(radius) / max(r, radius) : Expr(1.0);
  const Expr angle = p.y * rate, c = cos(angle), s = sin(angle);
  const Expr x = p.x * inward, z = p.z * inward;
  const Expr stretch = known ? stretchOf(1.0, rate * radius) : Expr(kInfinity);
  Shape warped = movedTo(shape, {x * c - z * s, p.y, x * s + z * c}, stretch.range().hi);
  const Box& b = shape.bounds;
  warped.bounds = {{-radius, b.min.y, -radius}, {radius, b.max.y, radius}};
  if (!known) return asField(std::move(warped));
  const Expr slope = max(stretch * steepest, 1.0);
  return withProvenBound(warped, max(warped.distance * (1.0 / slope), r - radius),
                         std::max(1.0, growthOf(shape.claim) * slope.range().hi));
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
  const double margin = kMargin * std::min(b.max.y - b.min.y, least / steepness);
  const double bottom = b.min.y - margin, top = b.max.y + margin;
  const Expr atBottom = rate * bottom + 1.0, atTop = rate * top + 1.0;
  const Expr narrowest = min(atBottom, atTop);
  const Expr radius = max(atBottom, atTop) * (radiusAbout(b, 1) * (1.0 + kMargin));
  const double steepest = slopeOf(shape), widest = radius.range().hi;
  const bool known = radius.range().lo > 0.0 && std::isfinite(widest) && std::isfinite(steepest);
  const Expr stretch =
      known ? stretchOf(1.0 / narrowest, radius * rate / square(narrowest)) : Expr(kInfinity);
  const Vec3E p = position();
  const Expr y = clamp(p.y, bottom, top), factor = rate * y + 1.0;
  const Expr r = length(p.x, p.z).claimLipschitz(1.0);
  const Expr inward = known ? radius / (max(r, radius) * factor) : 1.0 / factor;
  Shape warped = movedTo(shape, {p.x * inward, y, p.z * inward}, stretch.range().hi);
  warped.bounds = {{-widest, bottom, -widest}, {widest, top, widest}};
  if (!known) return asField(std::move(warped));
  const Expr slope = max(stretch * steepest, 1.0);
  const Expr outside = max(r - radius, outsideSlab(p.y, bottom, top));
  return withProvenBound(warped, max(warped.distance * (1.0 / slope), outside), 1.0);
}

Shape bend(const Shape& shape, const Expr& curvature) {
  Check check("bend", shape);
  if (!wantsSolid(check, shape).any("curvature", curvature).ok()) return check.failure();
  if (curvature.isConstant() && std::abs(curvature.constantValue()) < kSlightest) return shape;
  const Box& b = shape.bounds;
  const double most = curvature.range().magnitude();
  const double folding = std::max(0.0, timesRange(curvature.range(), b.min.y, b.max.y).hi);
  if (!checkBend(check, b, most, folding).ok()) return check.failure();

  const Expr k = keptFromZero(curvature);
  const Vec3E p = position();
  const Expr across = p.x * k, up = 1.0 - p.y * k;
  const Expr ratio = sqrt(square(across) + square(up));  // distance from the bend's centre, in radii
  const Expr x = atan2(across, up) * (1.0 / k);
  // (1 - ratio) / k without the cancellation that a slight bend would suffer.
  const Expr y = ((p.y * 2.0 - (square(p.x) + square(p.y)) * k) / (ratio + 1.0)).claimLipschitz(1.0);
  Shape warped = movedTo(shape, {x, y, p.z}, kInfinity);
  warped.bounds = curvature.isConstant() ? bentBox(b, curvature.constantValue()) : bentBoxForAny(b);

  const double growth = growthOf(shape.claim), steepest = slopeOf(shape);
  if (!std::isfinite(growth * steepest)) return asField(std::move(warped));
  const double gap = std::min(kPi / most - farthestAlong(b, 0), 0.25 * (1.0 - folding) / most);
  Expr fold = abs(k) * gap;
  for (const double end : {b.min.y, b.max.y})
    if (std::isfinite(end)) fold = max(fold, abs(k) * gap + k * end);
  const Expr slope = max(steepest / (1.0 - fold), 1.0);
  const double steep = slope.range().hi;
  const double cap = gap / growth;
  Expr distance = min(warped.distance, cap) * (1.0 / slope);
  for (const auto& [e, axis] : {std::pair(y, 1), std::pair(p.z, 2)})
    if (b.min[axis] > -kInfinity || b.max[axis] < kInfinity)
      distance = max(distance, outsideSlab(e, b.min[axis], b.max[axis]));
  // Below the cap the operand lies within growth * slope * c of its bounds, at a radius of at most `outer`;
  // above it anywhere in the ring.
  const double outer = 1.0 / most + farthestAlong(b, 1) + cap;
  const double turned = (1.0 + most * outer) * growth * steep;
  const double swelling =
      curvature.isConstant() ? std::max(turned + 1.0, 2.0 * outer * steep / cap + 1.0) : kInfinity;
  return withProvenBound(warped, distance, swelling);
}

}  // namespace sdf
