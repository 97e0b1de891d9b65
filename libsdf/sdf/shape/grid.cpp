#include <algorithm>
#include <array>
#include <cmath>

#include "sdf/shape/booleans.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/pattern.h"

namespace sdf {

namespace {

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

// The candidates' least distance with the attributes of the one that has it. Nothing is claimed: where a
// window jumps, the parts do.
Shape nearestCopy(const Shape& shape, const std::array<Axis, 3>& axes) {
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
        copy.distance = remap(shape.distance, {folded(axes[0], x), folded(axes[1], y), folded(axes[2], z)},
                              jumps ? kInfinity : 1.0);
        copy.claim = {ClaimKind::Field, kInfinity};
        copies.push_back(std::move(copy));
      }
  return unite(copies);
}

// At the moment a window drops a copy, the point is half a cell beyond that copy's bounds. An exact distance
// is then that of a nearer copy as well. Any other is at least half a cell / growth, and so hidden by a cap
// of that size.
double capOf(const Shape& shape, const std::array<Axis, 3>& axes) {
  double least = kInfinity;
  for (const Axis& a : axes)
    if (a.windowed()) least = std::min(least, a.narrowest() / 2.0);
  return least / growthOf(shape.claim);
}

}  // namespace

Shape repeatGrid(const Shape& shape, const Vec3E& cell, const std::optional<glm::ivec3>& count) {
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

  Shape result = nearestCopy(shape, axes);
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
  return settled(std::move(result));
}

}  // namespace sdf
