// Bend; the method is described in warp.h.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/deform.h"
#include "sdf/shape/warp.h"

namespace sdf {

namespace {

constexpr double kPi = std::numbers::pi;
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

Shape bend(const Shape& shape, const Expr& curvature) {
  if (!shape.ok()) return shape;
  Check check("bend");
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
