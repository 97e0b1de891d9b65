// Solids from flat shapes.
#include <algorithm>

#include "sdf/shape/deform.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

Check& wantsFlat(Check& check, const Shape& shape) {
  return check.that(shape.dimension == 2, "the shape is solid already; give it a flat one, such as a circle");
}

}  // namespace

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
  const Expr corner =
      sqrt(square(max(side, 0.0)) + square(max(lid, 0.0))).claimLipschitz(std::max(1.0, side.lipschitz()));
  result.distance = corner + min(max(side, lid), 0.0);
  result.bounds.min.z = -h.range().hi;
  result.bounds.max.z = h.range().hi;
  result.claim.growth = std::max(1.0, growthOf(flat.claim));
  return settled(std::move(result));
}

Shape revolve(const Shape& flat, const Expr& offset) {
  Check check("revolve", flat);
  if (!wantsFlat(check, flat).any("offset", offset).ok()) return check.failure();
  const double left = flat.bounds.min.x + offset.range().lo, right = flat.bounds.max.x + offset.range().hi;
  check.that(!(right < 0.0), "the flat shape lies at x < 0 altogether; move it or give it an offset");
  if (!check.ok()) return check.failure();
  const Vec3E p = position();
  Shape result = movedTo(flat, {length(p.x, p.z).claimLipschitz(1.0) - offset, p.y, 0.0}, 1.0);
  result.dimension = 3;
  result.bounds = {{-right, flat.bounds.min.y, -right}, {right, flat.bounds.max.y, right}};
  // A flat shape across the axis, unless it is its own mirror image, may owe its nearest point to the side
  // that is dropped. One that touches the axis may have an edge there, which the solid has not.
  const bool even = offset.isConstant(0.0) && isEven(flat.distance, 0);
  const ClaimKind best = even || left > 0.0 ? ClaimKind::Exact
                         : left == 0.0      ? ClaimKind::ExactOutside
                                            : ClaimKind::Bound;
  result.claim = weakened(flat.claim, best);
  return settled(std::move(result));
}

}  // namespace sdf
