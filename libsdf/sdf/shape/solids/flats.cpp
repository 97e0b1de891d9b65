#include "sdf/shape/solids/flats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"

namespace sdf {

namespace {

glm::dvec2 both(const Expr& e) { return glm::dvec2(upper(e)); }

}  // namespace

Shape circle(const Expr& radius) {
  if (Check c("circle"); !c.positive("radius", radius).ok()) return c.failure();
  const Vec3E p = position();
  return flat(norm(p.x, p.y) - radius, -both(radius), both(radius));
}

Shape rectangle(const Expr& halfWidth, const Expr& halfHeight) {
  Check c("rectangle");
  if (!c.vector("half", {halfWidth, halfHeight, 0.0}, Rule::Positive, 2).ok()) return c.failure();
  const Vec3E p = abs(position());
  const glm::dvec2 corner(upper(halfWidth), upper(halfHeight));
  return flat(boxDistance(p.x - halfWidth, p.y - halfHeight), -corner, corner);
}

Shape roundedRectangle(const Expr& halfWidth, const Expr& halfHeight, const Expr& radius) {
  Check c("rounded_rectangle");
  const Expr smaller = min(halfWidth, halfHeight);
  c.vector("half", {halfWidth, halfHeight, 0.0}, Rule::Positive, 2).notNegative("radius", radius);
  if (!c.atMost("radius", radius, "the smaller half size", smaller).ok()) return c.failure();
  const Vec3E p = abs(position());
  const Expr r = min(radius, smaller);
  const glm::dvec2 corner(upper(halfWidth), upper(halfHeight));
  return flat(boxDistance(p.x - (halfWidth - r), p.y - (halfHeight - r)) - r, -corner, corner);
}

Shape segment(const Vec3E& from, const Vec3E& to, const Expr& radius) {
  Check c("segment");
  c.vector("from", from, Rule::Any, 2).vector("to", to, Rule::Any, 2).positive("radius", radius);
  if (!c.ok()) return c.failure();
  const Expr ex = to.x - from.x, ey = to.y - from.y;
  const Expr x = position().x - from.x, y = position().y - from.y;
  // Ends closer than the square root of this count as one point.
  constexpr double kSmallestSquare = 1e-30;
  const Expr inverse = 1.0 / max(square(ex) + square(ey), kSmallestSquare);
  const Expr along = clamp(scaled(x, ex * inverse) + scaled(y, ey * inverse), 0.0, 1.0);
  const glm::dvec2 lo(std::min(lower(from.x), lower(to.x)), std::min(lower(from.y), lower(to.y)));
  const glm::dvec2 hi(std::max(upper(from.x), upper(to.x)), std::max(upper(from.y), upper(to.y)));
  return flat(norm(x - scaled(along, ex), y - scaled(along, ey)) - radius, lo - both(radius),
              hi + both(radius));
}

Shape regularPolygon(int sides, const Expr& radius) {
  Check c("regular_polygon");
  if (!c.integerAtLeast("sides", sides, 3).positive("radius", radius).ok()) return c.failure();
  const auto [lo, hi] = regularPolygonBounds(sides);
  return flat(regularPolygonDistance(position().y, position().x, sides, radius), lo * upper(radius),
              hi * upper(radius));
}

Shape star(int points, const Expr& outer, const Expr& inner) {
  Check c("star");
  c.integerAtLeast("points", points, 3).positive("outer", outer).positive("inner", inner);
  if (!c.below("inner", inner, "outer", outer).ok()) return c.failure();
  const Expr tip = positiveSize(outer), notch = min(positiveSize(inner), tip);
  const Wedge w = foldDihedral(position().y, position().x, points);
  // The one edge in the wedge, from the tip to the notch, and its frame.
  const double s = std::sin(std::numbers::pi / points), k = std::cos(std::numbers::pi / points);
  const Expr ex = notch * k - tip, ey = notch * s, edge = length(ex, ey);
  const Expr x = w.along - tip;
  const Expr along = (x * (ex / edge) + w.across * (ey / edge)).claimLipschitz(1.0);
  const Expr out = (x * (ey / edge) - w.across * (ex / edge)).claimLipschitz(1.0);
  const Expr distance = segmentDistance(out, beyond(along, edge));
  return flat(select(less(out, 0.0), -distance, distance), -both(tip), both(tip));
}

Shape arc(const Expr& angle, const Expr& radius, const Expr& thickness) {
  Check c("arc");
  c.angle("angle", angle, 180.0, true).positive("radius", radius).positive("thickness", thickness);
  if (!c.ok()) return c.failure();
  const Expr a = clamp(angle, 0.0, std::numbers::pi), half = 0.5 * thickness;
  const auto [lo, hi] = arcBounds(radius, a, upper(half));
  return flat(arcDistance(position().y, position().x, radius, a) - half, lo, hi,
              tubeKind(half, arcReach(radius, a)));
}

Shape ring(const Expr& radius, const Expr& thickness) {
  Check c("ring");
  c.positive("radius", radius).positive("thickness", thickness);
  if (!c.below("thickness", thickness, "twice the radius", 2.0 * radius).ok()) return c.failure();
  const Expr half = min(0.5 * thickness, radius);
  return flat(abs(norm(position().x, position().y) - radius) - half, -both(radius + half),
              both(radius + half));
}

Shape ellipse(const Expr& radiusX, const Expr& radiusY) {
  Check c("ellipse");
  if (!c.vector("radii", {radiusX, radiusY, 0.0}, Rule::Positive, 2).ok()) return c.failure();
  const Expr x = positiveSize(radiusX), y = positiveSize(radiusY);
  const Vec3E p = position();
  const glm::dvec2 corner(upper(x), upper(y));
  return flat(ellipsoidDistance({x, y}, {p.x, p.y}), -corner, corner);
}

Shape trapezoid(const Expr& halfBottom, const Expr& halfTop, const Expr& halfHeight) {
  Check c("trapezoid");
  c.notNegative("half_bottom", halfBottom).notNegative("half_top", halfTop);
  c.positive("half_height", halfHeight);
  if (c.ok())
    c.that(uniformValue(max(halfBottom, halfTop)) > 0.0, "half_bottom and half_top must not both be 0");
  if (!c.ok()) return c.failure();
  const Expr h = positiveSize(halfHeight), bottom = max(halfBottom, 0.0), top = max(halfTop, 0.0);
  const glm::dvec2 corner(std::max(upper(bottom), upper(top)), upper(h));
  return flat(trapezoidDistance(abs(position().x), position().y, bottom, top, h), -corner, corner);
}

}  // namespace sdf
