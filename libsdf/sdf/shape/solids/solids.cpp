#include "sdf/shape/solids/solids.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"

namespace sdf {

namespace {

glm::dvec3 upper(const Vec3E& v) { return {sdf::upper(v.x), sdf::upper(v.y), sdf::upper(v.z)}; }
glm::dvec3 lower(const Vec3E& v) { return {sdf::lower(v.x), sdf::lower(v.y), sdf::lower(v.z)}; }

Expr smallest(const Vec3E& v) { return min(v.x, min(v.y, v.z)); }

// Distance from the y axis.
Expr radial(const Vec3E& p) { return norm(p.x, p.z); }

Box roundBounds(double radius, double bottom, double top) {
  return {{-radius, bottom, -radius}, {radius, top, radius}};
}

}  // namespace

Shape sphere(const Expr& radius) {
  if (Check c("sphere"); !c.positive("radius", radius).ok()) return c.failure();
  return solid(norm(position().x, position().y, position().z) - radius,
               Box::centred(glm::dvec3(upper(radius))));
}

Shape box(const Vec3E& half) {
  if (Check c("box"); !c.vector("half", half, Rule::Positive).ok()) return c.failure();
  const Vec3E q = abs(position()) - half;
  return solid(boxDistance(q.x, q.y, q.z), Box::centred(upper(half)));
}

Shape roundBox(const Vec3E& half, const Expr& radius) {
  Check c("round_box");
  c.vector("half", half, Rule::Positive).notNegative("radius", radius);
  if (!c.atMost("radius", radius, "the smallest half size", smallest(half)).ok()) return c.failure();
  // Where the ranges would let the radius pass the smallest half size, it is held at it.
  const Expr r = min(radius, smallest(half));
  const Vec3E q = abs(position()) - (half - Vec3E(r));
  return solid(boxDistance(q.x, q.y, q.z) - r, Box::centred(upper(half)));
}

Shape boxFrame(const Vec3E& half, const Expr& thickness) {
  Check c("box_frame");
  c.vector("half", half, Rule::Positive).positive("thickness", thickness);
  if (!c.atMost("thickness", thickness, "the smallest half size", smallest(half)).ok()) return c.failure();
  // Half of what the beams take of each half size. Beams as thick as that meet in the middle: there they are
  // one, for two that only touch would have a distance of 0 within the solid.
  const auto part = [&](const Expr& size) { return select(less(thickness, size), 0.5 * thickness, size); };
  const Vec3E e{part(half.x), part(half.y), part(half.z)};
  const Vec3E p = abs(position()) - half;
  const Vec3E q = abs(p + e) - e;
  const Expr beams =
      min(min(boxDistance(p.x, q.y, q.z), boxDistance(q.x, p.y, q.z)), boxDistance(q.x, q.y, p.z));
  return solid(beams, Box::centred(upper(half)), ClaimKind::ExactOutside);
}

Shape torus(const Expr& major, const Expr& minor) {
  if (Check c("torus"); !c.positive("major", major).positive("minor", minor).ok()) return c.failure();
  const Vec3E p = position();
  const double r = upper(minor), reach = upper(major) + r;
  return solid(norm(radial(p) - major, p.y) - minor, roundBounds(reach, -r, r),
               tubeKind(minor, lower(major)));
}

Shape cappedTorus(const Expr& angle, const Expr& major, const Expr& minor) {
  Check c("capped_torus");
  c.angle("angle", angle, 180.0, true).positive("major", major).positive("minor", minor);
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr a = clamp(angle, 0.0, std::numbers::pi);
  const double r = upper(minor);
  const auto [lo, hi] = arcBounds(major, a, r);
  return solid(norm(arcDistance(p.z, p.x, major, a), p.y) - minor, {{lo.x, -r, lo.y}, {hi.x, r, hi.y}},
               tubeKind(minor, arcReach(major, a)));
}

Shape link(const Expr& halfLength, const Expr& major, const Expr& minor) {
  Check c("link");
  c.notNegative("half_length", halfLength).positive("major", major).positive("minor", minor);
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr y = max(abs(p.y) - max(halfLength, 0.0), 0.0);
  const double side = upper(major) + upper(minor), end = std::max(upper(halfLength), 0.0) + side;
  return solid(norm(norm(p.x, y) - major, p.z) - minor, Box::centred({side, end, upper(minor)}),
               tubeKind(minor, lower(major)));
}

Shape cylinder(const Expr& radius, const Expr& halfHeight) {
  Check c("cylinder");
  if (!c.positive("radius", radius).positive("half_height", halfHeight).ok()) return c.failure();
  const Vec3E p = position();
  const double h = upper(halfHeight);
  return solid(boxDistance(radial(p) - radius, abs(p.y) - halfHeight), roundBounds(upper(radius), -h, h));
}

Shape infiniteCylinder(const Expr& radius) {
  if (Check c("infinite_cylinder"); !c.positive("radius", radius).ok()) return c.failure();
  return solid(radial(position()) - radius, roundBounds(upper(radius), -kInfinity, kInfinity));
}

Shape capsule(const Vec3E& from, const Vec3E& to, const Expr& radius) {
  Check c("capsule");
  c.vector("from", from, Rule::Any).vector("to", to, Rule::Any).positive("radius", radius);
  if (!c.ok()) return c.failure();
  const Vec3E axis = to - from, p = position() - from;
  // Ends closer than the square root of this count as one point.
  constexpr double kSmallestSquare = 1e-30;
  const Expr along = clamp(weighted(p, axis * (1.0 / max(dot(axis, axis), kSmallestSquare))), 0.0, 1.0);
  const auto off = [&](const Expr& coordinate, const Expr& extent) {
    return coordinate - scaled(along, extent);
  };
  const Expr distance = norm(off(p.x, axis.x), off(p.y, axis.y), off(p.z, axis.z)) - radius;
  const Box ends{glm::min(lower(from), lower(to)), glm::max(upper(from), upper(to))};
  return solid(distance, ends.grown(upper(radius)));
}

Shape cone(const Expr& radius, const Expr& halfHeight) {
  Check c("cone");
  if (!c.positive("radius", radius).positive("half_height", halfHeight).ok()) return c.failure();
  return cappedCone(radius, 0.0, halfHeight);
}

Shape cappedCone(const Expr& radiusBottom, const Expr& radiusTop, const Expr& halfHeight) {
  Check c("capped_cone");
  c.notNegative("radius_bottom", radiusBottom).notNegative("radius_top", radiusTop);
  c.positive("half_height", halfHeight);
  if (c.ok())
    c.that(uniformValue(max(radiusBottom, radiusTop)) > 0.0,
           "radius_bottom and radius_top must not both be 0");
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr h = positiveSize(halfHeight), bottom = max(radiusBottom, 0.0), top = max(radiusTop, 0.0);
  return solid(trapezoidDistance(radial(p), p.y, bottom, top, h),
               roundBounds(std::max(upper(bottom), upper(top)), -upper(h), upper(h)));
}

Shape roundCone(const Expr& radiusBottom, const Expr& radiusTop, const Expr& halfHeight) {
  Check c("round_cone");
  c.positive("radius_bottom", radiusBottom).positive("radius_top", radiusTop);
  c.positive("half_height", halfHeight);
  if (c.ok())
    c.that(uniformValue(abs(radiusBottom - radiusTop) - 2.0 * halfHeight) < 0.0,
           "radius_bottom and radius_top must differ by less than 2 half_height, " +
               shown(2.0 * uniformValue(halfHeight)) + ", or one ball holds the other");
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr h = positiveSize(halfHeight);
  const Expr distance = roundConeDistance(radial(p), p.y, radiusBottom, radiusTop, h);
  const double bottom = upper(radiusBottom),
               top = upper(max(radiusTop, radiusBottom - kSteepestCone * (h + h)));
  return solid(distance, roundBounds(std::max(bottom, top), -upper(h) - bottom, upper(h) + top));
}

Shape plane(const Vec3E& normal, const Expr& offset) {
  Check c("plane");
  c.vector("normal", normal, Rule::Any).any("offset", offset);
  if (c.ok()) c.that(uniformValue(length(normal)) > 0.0, "normal must not be {0, 0, 0}");
  if (!c.ok()) return c.failure();
  const Vec3E unit = normal * (1.0 / positiveSize(length(normal)));
  Box bounds = Box::everything();
  const std::array<const Expr*, 3> parts{&unit.x, &unit.y, &unit.z};
  for (int i = 0; i < 3; ++i) {
    if (!parts[(i + 1) % 3]->isConstant(0.0) || !parts[(i + 2) % 3]->isConstant(0.0)) continue;
    if (lower(*parts[i]) > 0.0) bounds.max[i] = upper(offset);
    if (upper(*parts[i]) < 0.0) bounds.min[i] = -upper(offset);
  }
  return solid(weighted(position(), unit) - offset, bounds);
}

Shape ellipsoid(const Vec3E& radii) {
  if (Check c("ellipsoid"); !c.vector("radii", radii, Rule::Positive).ok()) return c.failure();
  const Vec3E r{positiveSize(radii.x), positiveSize(radii.y), positiveSize(radii.z)}, p = position();
  return solid(ellipsoidDistance({r.x, r.y, r.z}, {p.x, p.y, p.z}), Box::centred(upper(r)));
}

Shape ellipsoidBound(const Vec3E& radii) {
  if (Check c("ellipsoid_bound"); !c.vector("radii", radii, Rule::Positive).ok()) return c.failure();
  const Vec3E r{positiveSize(radii.x), positiveSize(radii.y), positiveSize(radii.z)}, p = position();
  // k = |p / r| is 1 on the surface and has L = 1 / smallest radius, so (k - 1) * smallest has L = 1. The
  // usual k (k - 1) / |p / r^2| comes closer but passes the distance inside, and is 0 / 0 at the centre.
  const Expr least = smallest(r);
  Shape s = solid(norm(p.x * (least / r.x), p.y * (least / r.y), p.z * (least / r.z)) - least,
                  Box::centred(upper(r)), ClaimKind::Bound);
  // (k - 1) * smallest <= c means |p| <= r + c r / smallest along each axis.
  const glm::dvec3 most = upper(r);
  s.claim.growth = glm::max(most.x, glm::max(most.y, most.z)) / lower(least);
  return s;
}

Shape solidAngle(const Expr& angle, const Expr& radius) {
  Check c("solid_angle");
  if (!c.angle("angle", angle, 180.0, false).positive("radius", radius).ok()) return c.failure();
  const Vec3E p = position();
  const Expr a = clamp(angle, 0.0, std::numbers::pi), s = sin(a), k = cos(a), rho = radial(p);
  // The frame of the cone's side: along it, and out of it.
  const Expr along = (rho * s + p.y * k).claimLipschitz(1.0), out = (rho * k - p.y * s).claimLipschitz(1.0);
  const Expr side = segmentDistance(out, beyond(along, radius));
  // Beyond the rim the ball's distance is no less than along - radius, which keeps this from jumping there.
  const Expr toSide = select(less(out, 0.0), max(-side, along - radius), side).claimLipschitz(1.0);
  const Expr distance = max(norm(p.x, p.y, p.z) - radius, toSide);
  const double r = upper(radius), widest = upper(a);
  return solid(distance, roundBounds(widest < std::numbers::pi / 2 ? r * std::sin(widest) : r,
                                     std::min(0.0, r * std::cos(widest)), r));
}

Shape cutSphere(const Expr& radius, const Expr& height) {
  Check c("cut_sphere");
  c.positive("radius", radius).any("height", height);
  if (c.ok())
    c.that(uniformValue(radius - abs(height)) > 0.0, "height must lie between -radius and radius, " +
                                                         shown(uniformValue(radius)) + ", got " +
                                                         shown(uniformValue(height)));
  if (!c.ok()) return c.failure();
  const Vec3E p = position();
  const Expr r = positiveSize(radius), h = clamp(height, -r, r), rim = sqrt(square(r) - square(h));
  const Expr rho = radial(p), x = rho - rim, y = h - p.y;
  // Nearest is the rim where the point lies beyond it both as seen from the ball and from the flat face;
  // elsewhere the farther of ball and half-space, inside included.
  const Expr nearRim = less(0.0, min(x, scaled(rho, h) - p.y * rim));
  const Expr distance = select(nearRim, norm(x, y), max(norm(p.x, p.y, p.z) - r, y));
  const double top = upper(r), bottom = lower(h);
  return solid(distance,
               roundBounds(bottom > 0.0 ? std::sqrt(top * top - bottom * bottom) : top, bottom, top));
}

}  // namespace sdf
