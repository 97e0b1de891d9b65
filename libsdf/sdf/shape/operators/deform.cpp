// The operators that do not warp space (warp.cpp): they change the distance or sweep a flat shape.
#include "sdf/shape/operators/deform.h"

#include <algorithm>
#include <cmath>

#include "sdf/shape/calibrate/offset.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

Check& wantsFlat(Check& check, const Shape& shape) {
  return check.that(shape.dimension == 2, "the shape is solid already; give it a flat one, such as a circle");
}

bool dependsOnZ(const Expr& e) {
  return std::ranges::any_of(topologicalOrder({&e, 1}), [](const Expr& n) {
    return n.op() == Op::Variable && n.variableIndex() == Variable::Z;
  });
}

// f + offset. The solid keeps within f <= -lo, lo being the least offset.
Shape displaced(const Shape& shape, const Expr& offset) {
  Shape result = withGrowth(shape);
  const double growth = growthOf(result.claim), raised = -offset.range().lo;
  result.distance = result.distance + offset;
  if (raised > 0.0) result.bounds = grow(shape.bounds, growth * raised);
  result.claim = {ClaimKind::Field, slopeOf(result) + offset.lipschitz(), growth};
  return settled(std::move(result));
}

}  // namespace

Shape morph(const Shape& a, const Shape& b, const Expr& t) {
  Check check("morph", a.ok() ? b : a);
  check.that(a.dimension == b.dimension,
             "one shape is flat and the other solid; extrude or revolve the flat one first");
  if (check.any("t", t).ok()) {
    const double now = uniformValue(t);
    check.that(now >= 0.0 && now <= 1.0, "t must lie in 0 to 1, got " + shown(now));
  }
  if (!check.ok()) return check.failure();
  const bool inside = t.range().lo >= 0.0 && t.range().hi <= 1.0;
  const Expr share = inside ? t : clamp(t, 0.0, 1.0);
  const std::vector<Shape> both = numberedAlike({a, b});
  Shape result = both[0];
  result.distance = mix(a.distance, b.distance, share);
  result.surface = mixed(both[0].surface, both[1].surface, lessEqual(0.5, share), share);
  // A mean that is at most c has an operand that is at most c.
  result.bounds = unite(a.bounds, b.bounds);
  result.claim = {ClaimKind::Field, std::max(a.claim.lipschitz, b.claim.lipschitz),
                  std::max(growthOf(a.claim), growthOf(b.claim))};
  return settled(std::move(result));
}

Shape round(const Shape& shape, const Expr& radius) {
  Check check("round", shape);
  if (!check.notNegative("radius", radius).ok()) return check.failure();
  const Expr r = notNegative(radius);
  const bool exactOutside = shape.claim.kind <= ClaimKind::ExactOutside;
  Shape result = exactOutside ? shape : fitForOffsets(shape, {r.range().hi, 0.0});
  const double growth = growthOf(result.claim);
  result.distance = result.distance - r;
  if (r.range().hi > 0.0) result.bounds = grow(shape.bounds, growth * r.range().hi);
  // Outside, any way to the grown surface is the way to the surface less the radius. Inside, the way out
  // crosses the surface and then at least the radius. A bound that is not exact needs L <= 1 for that;
  // settled looks.
  result.claim.kind = exactOutside ? ClaimKind::ExactOutside : ClaimKind::Field;
  result.claim.growth = growth;
  return settled(std::move(result));
}

Shape shell(const Shape& shape, const Expr& thickness) {
  Check check("shell", shape);
  if (!check.positive("thickness", thickness).ok()) return check.failure();
  const Expr half = keptPositive(thickness) * 0.5;
  const bool exact = shape.claim.kind == ClaimKind::Exact;
  const double most = half.range().hi, outwards = shape.claim.kind == ClaimKind::ExactOutside ? 0.0 : most;
  Shape result = exact ? shape : fitForOffsets(shape, {outwards, most});
  const double growth = growthOf(result.claim);
  result.distance = abs(result.distance) - half;
  result.bounds = grow(shape.bounds, growth * half.range().hi);
  // What is within half of the surface: exact from both sides if the distance is.
  result.claim.kind = exact ? ClaimKind::ExactOutside : ClaimKind::Field;
  result.claim.growth = growth;
  return settled(std::move(result));
}

Shape elongate(const Shape& shape, const Vec3E& half) {
  Check check("elongate", shape);
  const int axes = shape.dimension;
  if (!check.vector("half", half, Rule::NotNegative, axes).ok()) return check.failure();
  Vec3E at = position();
  Box bounds = shape.bounds;
  for (int i = 0; i < axes; ++i) {
    const Expr h = notNegative(component(half, i));
    if (h.isConstant(0.0)) continue;
    const Expr x = component(at, i);
    component(at, i) = x - clamp(x, -h, h);
    bounds.min[i] -= h.range().hi;
    bounds.max[i] += h.range().hi;
  }
  // The map moves no two points apart: L stays, and a distance stays below the true one. It is not exact in
  // general: where the gap is, the nearest point may lie beyond the cut.
  Shape result = movedTo(shape, at, 1.0);
  result.bounds = bounds;
  result.claim = weakened(shape.claim, ClaimKind::Bound);
  return settled(std::move(result));
}

Shape displace(const Shape& shape, const Expr& offset) {
  Check check("displace", shape);
  check.that(shape.dimension == 3 || !dependsOnZ(offset), "the offset of a flat shape must not depend on z");
  if (!check.ok()) return check.failure();
  return displaced(shape, offset);
}

Shape displace(const Shape& shape, const Expr& amplitude, const Expr& frequency) {
  Check check("displace", shape);
  check.any("amplitude", amplitude).any("frequency", frequency);
  if (!wantsSolid(check, shape).ok()) return check.failure();
  const Vec3E p = position();
  // With u = sin^2 of each factor, the squared slope over w^2 is u1 u2 + u2 u3 + u3 u1 - 3 u1 u2 u3, linear
  // in each u and so greatest at a corner of [0, 1]^3, where it is 0 or 1.
  const double w = frequency.range().magnitude();
  const Expr wave = (sin(p.x * frequency) * sin(p.y * frequency) * sin(p.z * frequency)).claimLipschitz(w);
  return displaced(shape, (wave * amplitude).claimLipschitz(w * amplitude.range().magnitude()));
}

Shape extrude(const Shape& flat, const Expr& halfHeight) {
  Check check("extrude", flat);
  if (!wantsFlat(check, flat).positive("half_height", halfHeight).ok()) return check.failure();
  const Expr h = keptPositive(halfHeight);
  const Expr& side = flat.distance;
  const Expr lid = abs(position().z) - h;
  Shape result = flat;
  result.dimension = 3;
  result.claim.lipschitz = std::max(1.0, slopeOf(flat));
  // side depends on x and y, lid on z: the length of the pair is no steeper than the steeper of the two.
  result.distance = boxDistance({side, lid}, std::max(1.0, side.lipschitz()));
  result.bounds.min.z = -h.range().hi;
  result.bounds.max.z = h.range().hi;
  result.claim.growth = std::max(1.0, growthOf(flat.claim));
  return settled(std::move(result));
}

namespace {

// The flat shape's own half-plane through the y axis, as far as `half` radians to both sides of +x; beyond it
// the plane of the nearer end.
class PartOfATurn {
 public:
  /// `isCut`: does part of the flat shape lie beyond the axis, where it is dropped?
  PartOfATurn(const Expr& half, bool isCut) : half_(clamp(half, 0.0, std::numbers::pi)), isCut_(isCut) {
    const Vec3E p = position();
    const Expr s = sin(half_), c = cos(half_), z = abs(p.z);
    beyond_ = (z * c - p.x * s).claimLipschitz(1.0);
    along_ = (p.x * c + z * s).claimLipschitz(1.0);
    rho_ = length(p.x, p.z).claimLipschitz(1.0);
  }

  // Distance from the y axis, or along the end's plane, not beyond the axis where that is cut.
  Expr across() const {
    return select(less(0.0, beyond_), isCut_ ? max(along_, 0.0) : along_, rho_).claimLipschitz(1.0);
  }

  // Of the solid, from the flat shape's there, of this slope. A whole turn has no ends.
  Expr distance(const Expr& flat, double slope) const {
    const Expr toEnd = select(less(0.0, along_), beyond_, -rho_);
    const Expr within = select(lessEqual(std::numbers::pi, half_), flat, max(flat, toEnd));
    const Expr off = isCut_ ? length(beyond_, min(along_, 0.0)).claimLipschitz(1.0) : beyond_;
    return select(less(0.0, beyond_), length(max(flat, 0.0), off), within).claimLipschitz(slope);
  }

  // The angles' range of x, of what is up to `most` from the axis.
  double leastX(double most) const {
    const double widest = half_.range().hi;
    return widest < 0.5 * std::numbers::pi ? 0.0 : most * std::cos(widest);
  }
  double mostZ(double most) const {
    const double widest = half_.range().hi;
    return widest < 0.5 * std::numbers::pi ? most * std::sin(widest) : most;
  }

 private:
  Expr half_, beyond_, along_, rho_;
  bool isCut_;
};

}  // namespace

Shape revolve(const Shape& flat, const Expr& offset, const Expr& angle) {
  Check check("revolve", flat);
  wantsFlat(check, flat).any("offset", offset).angle("angle", angle, 360.0, true);
  if (!check.ok()) return check.failure();
  const double left = flat.bounds.min.x + offset.range().lo, right = flat.bounds.max.x + offset.range().hi;
  check.that(!(right < 0.0), "the flat shape lies at x < 0 altogether; move it or give it an offset");
  if (!check.ok()) return check.failure();
  const Vec3E p = position();
  const bool isWhole = angle.isConstant(2.0 * std::numbers::pi);
  const PartOfATurn part(0.5 * angle, left < 0.0);
  const Expr rho = isWhole ? length(p.x, p.z).claimLipschitz(1.0) : part.across();
  Shape result = movedTo(flat, {rho - offset, p.y, 0.0}, 1.0);
  result.dimension = 3;
  result.bounds = {{-right, flat.bounds.min.y, -right}, {right, flat.bounds.max.y, right}};
  // A flat shape across the axis, unless it is its own mirror image, may owe its nearest point to the side
  // that is dropped. One that touches the axis may have an edge there, which the solid has not.
  const bool even = offset.isConstant(0.0) && isEven(flat.distance, 0);
  const ClaimKind best = even || left > 0.0 ? ClaimKind::Exact
                         : left == 0.0      ? ClaimKind::ExactOutside
                                            : ClaimKind::Bound;
  if (isWhole) {
    result.claim = weakened(flat.claim, best);
    return settled(std::move(result));
  }
  // Inside, the plane of an end may be nearer than the end. Seen from beyond it, what is dropped may be
  // nearer.
  result.claim = weakened(flat.claim, left < 0.0 ? ClaimKind::Bound : ClaimKind::ExactOutside);
  result.claim.lipschitz = std::max(1.0, slopeOf(flat));
  result.claim.growth = std::max(1.0, growthOf(flat.claim));
  result.distance = part.distance(result.distance, std::max(1.0, result.distance.lipschitz()));
  result.bounds.min.x = part.leastX(right);
  result.bounds.max.z = part.mostZ(right), result.bounds.min.z = -result.bounds.max.z;
  return settled(std::move(result));
}

}  // namespace sdf
