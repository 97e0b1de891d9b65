// Twist and taper; the method is described in warp.h.
#include "sdf/shape/warp.h"

#include <algorithm>
#include <cmath>

#include "sdf/shape/deform.h"

namespace sdf {

namespace {

// How far beyond the bounds the clamp begins, as a share of their size: near the surface the distance is f(T)
// / L alone.
constexpr double kMargin = 1.0 / 16.0;

// Largest singular value of [[a, b], [0, 1]], from the eigenvalues of its square. Like all constants here it
// is an expression: a slider that stands at a slight twist pays for a slight one.
Expr stretchOf(const Expr& a, const Expr& b) {
  const Expr sum = square(a) + square(b) + 1.0;
  return sqrt((sum + sqrt(max(square(sum) - 4.0 * square(a), 0.0))) * 0.5);
}

}  // namespace

bool finiteAlong(const Box& b, int axis) { return b.min[axis] > -kInfinity && b.max[axis] < kInfinity; }
double farthestAlong(const Box& b, int axis) {
  return std::max(std::abs(b.min[axis]), std::abs(b.max[axis]));
}

Shape asField(Shape warped) {
  warped.claim = {ClaimKind::Field, kInfinity};
  return settled(std::move(warped));
}

Shape withProvenBound(Shape warped, const Expr& distance, double growth) {
  warped.distance = distance;
  warped.claim = {ClaimKind::Bound, 1.0, growth};
  return settled(std::move(warped));
}

Shape twist(const Shape& shape, const Expr& rate) {
  if (!shape.ok()) return shape;
  Check check("twist");
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
  if (!shape.ok()) return shape;
  Check check("taper");
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

}  // namespace sdf
