#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/shape/booleans.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/pattern.h"
#include "sdf/shape/place.h"

namespace sdf {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostCopiedOut = 64;
constexpr int kMostCandidates = 4;  // of a shape that spans 3 sectors

// Angles from +x towards +z under which the box is seen from the y axis. It must be finite in x and z and
// clear of the axis.
Interval anglesOf(const Box& b) {
  const double middle = std::atan2(b.centre().z, b.centre().x);
  Interval seen(0.0);
  for (const double x : {b.min.x, b.max.x})
    for (const double z : {b.min.z, b.max.z})
      seen = hull(seen, Interval(std::remainder(std::atan2(z, x) - middle, 2.0 * kPi)));
  return {middle + seen.lo, middle + seen.hi};
}

bool clearOfAxis(const Box& b) {
  const bool finite = std::isfinite(b.size().x) && std::isfinite(b.size().z);
  return finite && (b.min.x > 0.0 || b.max.x < 0.0 || b.min.z > 0.0 || b.max.z < 0.0);
}

double nearestToAxis(const Box& b) {
  const auto nearest = [](double lo, double hi) { return lo > 0.0 ? lo : hi < 0.0 ? -hi : 0.0; };
  return std::hypot(nearest(b.min.x, b.max.x), nearest(b.min.z, b.max.z));
}

Shape copiedOut(const Shape& shape, int count) {
  std::vector<Shape> copies;
  for (int i = 0; i < count; ++i) copies.push_back(rotate(shape, Vec3E(0.0, 2.0 * kPi * i / count, 0.0)));
  return unite(copies);
}

// A shape that is its own mirror image in z = 0 and keeps to the sector around +x: the copy in the point's
// own sector is the nearest. Folding space into half a sector is continuous.
Shape oneCopy(const Shape& shape, double sector) {
  const Vec3E p = position();
  const Expr angle = atan2(p.z, p.x), radius = length(p.x, p.z).claimLipschitz(1.0);
  const Expr inSector = round(angle * (1.0 / sector)) * -sector + angle;
  const Expr x = radius * cos(inSector), z = radius * sin(inSector);
  Shape result = movedTo(shape, {x, p.y, z}, kInfinity);
  result.distance = remap(shape.distance, {x, p.y, abs(z)}, 1.0);
  return result;
}

// Asks `candidates` copies, from the one whose far edge comes round(…) sectors before the point.
Shape windowOfCopies(const Shape& shape, double sector, double farEdge, int candidates) {
  const Vec3E p = position();
  const Expr angle = atan2(p.z, p.x);
  const Expr turn = round(angle * (1.0 / sector) - farEdge / sector) * sector;
  const Expr c = cos(turn), s = sin(turn);
  Expr x = p.x * c + p.z * s, z = p.z * c - p.x * s;
  std::vector<Shape> copies;
  for (int k = 0; k < candidates; ++k) {
    const double cosine = std::cos(sector * k), sine = std::sin(sector * k);
    const Vec3E turned = k == 0 ? Vec3E(x, p.y, z) : Vec3E(x * cosine + z * sine, p.y, z * cosine - x * sine);
    copies.push_back(movedTo(shape, turned, kInfinity));
    copies.back().claim = {ClaimKind::Field, kInfinity};
  }
  return unite(copies);
}

}  // namespace

Shape polarRepeat(const Shape& shape, int count) {
  Check check("polar_repeat", shape);
  if (!wantsSolid(check, shape).integerAtLeast("count", count, 1).ok()) return check.failure();
  if (count == 1) return shape;
  const double sector = 2.0 * kPi / count;
  const Box& b = shape.bounds;
  const bool clear = clearOfAxis(b);
  const Interval seen = clear ? anglesOf(b) : Interval(-kPi, kPi);
  const bool even = clear && std::max(-seen.lo, seen.hi) <= sector / 2.0 && isEven(shape.distance, 2);
  const int candidates = static_cast<int>(std::ceil(seen.width() / sector)) + 1;
  const ClaimKind kind = shape.claim.kind;
  const double steepest = slopeOf(shape), growth = growthOf(shape.claim);
  const bool exact = kind <= ClaimKind::ExactOutside;
  if (!even && (!clear || candidates > kMostCandidates || candidates >= count)) {
    check.that(count <= kMostCopiedOut, "the shape reaches the y axis or spans more than 3 of the " +
                                            std::to_string(count) +
                                            " sectors; move it outwards or use at most 64 copies");
    return check.ok() ? copiedOut(shape, count) : check.failure();
  }

  Shape result = even ? oneCopy(shape, sector) : windowOfCopies(shape, sector, seen.hi, candidates);
  const double outer = radiusAbout(b, 1), inner = nearestToAxis(b);
  result.bounds = {{-outer, b.min.y, -outer}, {outer, b.max.y, outer}};
  const bool apart = seen.width() < sector;
  result.claim = {apart ? kind : weaker(kind, ClaimKind::ExactOutside), steepest,
                  std::max(1.0, std::numbers::sqrt2 * growth)};
  if (!even && !exact) {
    // As in a grid, but the window drops a copy half a sector beyond its bounds, which is less near the axis;
    // there the distance to the ring of copies takes over.
    const bool known = std::isfinite(steepest * growth);
    result.claim.lipschitz = known ? std::max(1.0, steepest) : kInfinity;
    if (known) {
      const Vec3E p = position();
      const Expr radius = length(p.x, p.z).claimLipschitz(1.0);
      const double share =
          std::sin(std::min(sector, kPi) / 2.0) / std::max(1.0, std::numbers::sqrt2 * growth);
      result.distance = max(min(result.distance, radius * share), outsideSlab(radius, inner, outer));
      if (std::isfinite(b.min.y) || std::isfinite(b.max.y))
        result.distance = max(result.distance, outsideSlab(p.y, b.min.y, b.max.y));
    }
  }
  return settled(std::move(result));
}

}  // namespace sdf
