#include "sdf/shape/operators/pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sdf/shape/operand.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"

namespace sdf {

namespace {

// Copies of what is no steeper than a distance need not be known.
Shape settledAs(Shape s, Copies copies) {
  s = settled(std::move(s));
  if (!isOneLipschitz(slopeOf(copies.one))) s.copies = std::make_shared<Copies>(std::move(copies));
  return s;
}

// --- grids ---

constexpr double kMostCells = 3.0;

// How one axis is repeated.
struct Axis {
  bool repeated = false;
  Expr cell = 0.0;
  int count = 0;       // 0: endless
  int candidates = 1;  // copies that a point asks
  bool even = false;   // the shape is its own mirror image and fits its cell: one copy is enough
  double lo = 0.0, hi = 0.0;

  double narrowest() const { return cell.range().lo; }
  // Cells from the shape's own place to copy 0.
  double first() const { return count > 0 ? -0.5 * (count - 1) : 0.0; }
  // Copies are asked through a window of indices that jumps.
  bool windowed() const { return repeated && !even && candidates != count; }
};

Check& checkAxis(Check& check, const Shape& shape, int i, const Expr& cell, int count) {
  const std::string name = axisName(i);
  if (!check.notNegative("cell." + name, cell).ok() || cell.isConstant(0.0) || count == 1) return check;
  const double length = shape.bounds.size()[i], narrowest = cell.range().lo;
  check.that(narrowest > 0.0, "cell." + name + " must stay above 0 over its parameter's range");
  check.that(std::isfinite(length), "the shape is unbounded in " + name +
                                        "; intersect it with a box first, or set cell." + name + " to 0");
  return check.that(length <= kMostCells * narrowest, "the shape is " + shown(length) + " long in " + name +
                                                          ", more than 3 cells of " + shown(narrowest) +
                                                          "; use a larger cell");
}

Axis axisOf(const Shape& shape, int i, const Expr& cell, int count) {
  Axis a;
  a.repeated = !cell.isConstant(0.0) && count != 1;
  if (!a.repeated) return a;
  a.cell = cell;
  a.count = count;
  a.lo = shape.bounds.min[i];
  a.hi = shape.bounds.max[i];
  a.even = std::max(-a.lo, a.hi) <= a.narrowest() / 2.0 && isEven(shape.distance, i);
  if (a.even) return a;
  a.candidates = std::max(1, static_cast<int>(std::ceil((a.hi - a.lo) / a.narrowest()))) + 1;
  if (count > 0) a.candidates = std::min(a.candidates, count);
  return a;
}

// The coordinate as each candidate copy sees it.
std::vector<Expr> seenBy(const Axis& a, const Expr& x) {
  if (!a.repeated) return {x};
  Expr index = round(x * (1.0 / a.cell) - ((a.even ? 0.0 : a.hi) / a.cell + a.first()));
  if (a.count > 0) index = clamp(index, 0.0, a.count - a.candidates);
  if (a.count == a.candidates) index = 0.0;
  std::vector<Expr> seen;
  for (int k = 0; k < a.candidates; ++k)
    seen.push_back((index.isConstant(0.0) ? x : index * -a.cell + x) - (a.first() + k) * a.cell);
  return seen;
}

// At the moment a window drops a copy, the point is this far beyond that copy's bounds.
double halfCellOf(const std::array<Axis, 3>& axes) {
  double least = kInfinity;
  for (const Axis& a : axes)
    if (a.windowed()) least = std::min(least, a.narrowest() / 2.0);
  return least;
}

// The candidates' least distance with the attributes of the one that has it. Nothing is claimed: where a
// window jumps, the parts do.
Shape nearestCopy(const Shape& shape, const std::array<Axis, 3>& axes, Copies& all) {
  const Vec3E p = position();
  const bool jumps = std::ranges::any_of(axes, &Axis::windowed);
  // |x - cell round(x / cell)| is a continuous zigzag of slope 1, and all that an even distance sees.
  const auto folded = [](const Axis& a, const Expr& x) {
    return a.repeated && a.even ? abs(x).claimLipschitz(1.0) : x;
  };
  std::vector<Shape> copies;
  for (const Expr& x : seenBy(axes[0], p.x))
    for (const Expr& y : seenBy(axes[1], p.y))
      for (const Expr& z : seenBy(axes[2], p.z)) {
        Shape copy = movedTo(shape, {x, y, z}, kInfinity);
        const Vec3E& place =
            all.places.emplace_back(folded(axes[0], x), folded(axes[1], y), folded(axes[2], z));
        copy.distance = remap(shape.distance, {place.x, place.y, place.z}, jumps ? kInfinity : 1.0);
        copy.claim = {ClaimKind::Field, kInfinity};
        copies.push_back(std::move(copy));
      }
  if (jumps) all.others = halfCellOf(axes);
  return unite(copies);
}

// Where a window drops a copy, an exact distance is that of a nearer copy as well. Any other is at least half
// a cell / growth, and so hidden by a cap of that size.
double capOf(const Shape& shape, const std::array<Axis, 3>& axes) {
  return halfCellOf(axes) / growthOf(shape.claim);
}

// --- about the y axis ---

constexpr int kMostCopiedOut = 64;
constexpr int kMostCandidates = 4;  // of a shape that spans 3 sectors

// Angles from +x towards +z under which the box is seen from the y axis. It must be finite in x and z and
// clear of the axis.
Interval anglesOf(const Box& b) {
  const double middle = std::atan2(b.centre().z, b.centre().x);
  Interval seen(0.0);
  for (const double x : {b.min.x, b.max.x})
    for (const double z : {b.min.z, b.max.z})
      seen = hull(seen, Interval(std::remainder(std::atan2(z, x) - middle, 2.0 * std::numbers::pi)));
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
  for (int i = 0; i < count; ++i)
    copies.push_back(rotate(shape, Vec3E(0.0, 2.0 * std::numbers::pi * i / count, 0.0)));
  return unite(copies);
}

// Of the way to the axis: what is half a sector away is as far as this. The window drops a copy half a sector
// beyond its bounds.
double shareOf(double sector) { return std::sin(std::min(sector, std::numbers::pi) / 2.0); }

// A shape that is its own mirror image in z = 0 and keeps to the sector around +x: the copy in the point's
// own sector is the nearest. Folding space into half a sector is continuous.
Shape oneCopy(const Shape& shape, double sector, Copies& all) {
  const Vec3E p = position();
  const Expr angle = atan2(p.z, p.x), radius = length(p.x, p.z).claimLipschitz(1.0);
  const Expr inSector = round(angle * (1.0 / sector)) * -sector + angle;
  const Expr x = radius * cos(inSector), z = radius * sin(inSector);
  Shape result = movedTo(shape, {x, p.y, z}, kInfinity);
  result.distance = remap(shape.distance, {x, p.y, abs(z)}, 1.0);
  all.places = {{x, p.y, abs(z)}};
  return result;
}

// Asks `candidates` copies, from the one whose far edge comes round(…) sectors before the point.
Shape windowOfCopies(const Shape& shape, double sector, double farEdge, int candidates, Copies& all) {
  const Vec3E p = position();
  const Expr angle = atan2(p.z, p.x);
  const Expr turn = round(angle * (1.0 / sector) - farEdge / sector) * sector;
  const Expr c = cos(turn), s = sin(turn);
  Expr x = p.x * c + p.z * s, z = p.z * c - p.x * s;
  std::vector<Shape> copies;
  for (int k = 0; k < candidates; ++k) {
    const double cosine = std::cos(sector * k), sine = std::sin(sector * k);
    const Vec3E turned = k == 0 ? Vec3E(x, p.y, z) : Vec3E(x * cosine + z * sine, p.y, z * cosine - x * sine);
    all.places.push_back(turned);
    copies.push_back(movedTo(shape, turned, kInfinity));
    copies.back().claim = {ClaimKind::Field, kInfinity};
  }
  all.others = length(p.x, p.z).claimLipschitz(1.0) * shareOf(sector);
  return unite(copies);
}

}  // namespace

Shape repeatGrid(const Shape& one, const Vec3E& cell, const std::optional<glm::ivec3>& count) {
  const Shape shape = withGrowth(one);
  Check check("repeat_grid", shape);
  std::array<Axis, 3> axes;
  bool any = false;
  for (int i = 0; i < shape.dimension && check.ok(); ++i) {
    const int copies = count ? (*count)[i] : 0;
    if (count) check.integerAtLeast("count." + std::string(axisName(i)), copies, 1);
    if (!checkAxis(check, shape, i, component(cell, i), copies).ok()) break;
    axes[i] = axisOf(shape, i, component(cell, i), copies);
    any = any || !component(cell, i).isConstant(0.0);
  }
  check.that(any, "cell must not be 0 along every axis");
  if (!check.ok()) return check.failure();

  Copies copies{shape, {}, {}};
  Shape result = nearestCopy(shape, axes, copies);
  result.bounds = shape.bounds;
  bool apart = true;
  for (int i = 0; i < 3; ++i) {
    const Axis& a = axes[i];
    if (!a.repeated) continue;
    const double reach = a.count > 0 ? -a.first() * a.cell.range().hi : kInfinity;
    result.bounds.min[i] -= reach;
    result.bounds.max[i] += reach;
    apart = apart && a.hi - a.lo < a.narrowest();
  }
  const ClaimKind kind = shape.claim.kind;
  const double steepest = slopeOf(shape), cap = capOf(shape, axes);
  result.claim = {apart ? kind : weaker(kind, ClaimKind::ExactOutside), steepest, growthOf(shape.claim)};
  if (std::ranges::any_of(axes, &Axis::windowed) && kind > ClaimKind::ExactOutside) {
    const bool known = cap > 0.0 && std::isfinite(steepest);
    result.claim.lipschitz = known ? std::max(1.0, steepest) : kInfinity;
    result.claim.growth = std::max(1.0, result.claim.growth);
    if (known) {
      result.distance = min(result.distance, cap);
      if (const auto outside = outsideBox(result.bounds)) result.distance = max(result.distance, *outside);
    }
  }
  return settledAs(std::move(result), std::move(copies));
}

Shape polarRepeat(const Shape& one, int count) {
  const Shape shape = withGrowth(one);
  Check check("polar_repeat", shape);
  if (!wantsSolid(check, shape).integerAtLeast("count", count, 1).ok()) return check.failure();
  if (count == 1) return shape;
  const double sector = 2.0 * std::numbers::pi / count;
  const Box& b = shape.bounds;
  const bool clear = clearOfAxis(b);
  const Interval seen = clear ? anglesOf(b) : Interval(-std::numbers::pi, std::numbers::pi);
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

  Copies copies{shape, {}, {}};
  Shape result =
      even ? oneCopy(shape, sector, copies) : windowOfCopies(shape, sector, seen.hi, candidates, copies);
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
      const double share = shareOf(sector) / std::max(1.0, std::numbers::sqrt2 * growth);
      result.distance = max(min(result.distance, radius * share), outsideSlab(radius, inner, outer));
      if (std::isfinite(b.min.y) || std::isfinite(b.max.y))
        result.distance = max(result.distance, outsideSlab(p.y, b.min.y, b.max.y));
    }
  }
  return settledAs(std::move(result), std::move(copies));
}

}  // namespace sdf
