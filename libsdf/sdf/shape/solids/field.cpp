// Formulas as shapes.
#include <cmath>

#include "sdf/shape/calibrate/cells.h"
#include "sdf/shape/check.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

// How far beyond the bounds a formula may be asked for, as a share of their longest side: what leaves them is
// then seen to.
constexpr double kMargin = 0.5;

// The formula looked up at the nearest point of the box.
Expr heldWithin(const Expr& formula, const Box& box) {
  const Vec3E p = position();
  std::array<Expr, 3> nearest;
  for (int i = 0; i < 3; ++i) nearest[i] = clamp(component(p, i), box.min[i], box.max[i]);
  return remap(formula, nearest, 1.0);
}

double steepest(const Expr& formula, const Box& region) {
  // Some milliseconds' worth, whatever the size of the graph.
  const std::size_t mostCells =
      std::clamp<std::size_t>(10000 / topologicalOrder({&formula, 1}).size(), 1, 500);
  const auto slopesOf = [&](const Box& box) { return std::vector{heldWithin(formula, box).lipschitz()}; };
  double most = 0.0;
  for (const Cell& cell : refined(region, sizeOf(region), mostCells, slopesOf))
    most = std::max(most, cell.worst());
  return most;
}

// The formula at the nearest point of a region, which it has that slope in, and beyond a box that holds the
// region no less than the way to it: dividing it by the slope is never more than the way to its zero set. A
// point of a box moves no more than the one that it is nearest to.
Expr knownWithin(const Expr& formula, const Box& region, double slope, const Box& box) {
  return max(heldWithin(formula, region).claimLipschitz(slope), slope * *outsideBox(box));
}

// What is not known everywhere is looked up within the bounds, where it is stated, or where intervals bound
// its slope, also a little beyond. It is prolonged so far that what reaches the bounds is seen to leave them.
Expr nearBounds(const Expr& formula, const Box& bounds, double stated) {
  const Box near = bounds.grown(kMargin * bounds.longestSide());
  if (stated < kInfinity) return knownWithin(formula, bounds, stated, near);
  const double slope = steepest(formula, near);
  if (slope == kInfinity) return formula;
  return knownWithin(formula, near, slope > 0.0 ? slope : 1.0, near);
}

}  // namespace

Shape field(const Expr& distance, const Box& bounds, double lipschitz) {
  Check c("field");
  c.that(lipschitz > 0.0, "lipschitz must be positive, got " + shown(lipschitz));
  for (const Expr& e : topologicalOrder({&distance, 1}))
    c.that(e.op() != Op::Variable || e.variableIndex() <= Variable::Z,
           "distance must not depend on the normal");
  c.that(!bounds.empty(), "bounds must not be empty");
  if (!c.ok()) return c.failure();
  Shape s;
  const bool known =
      lipschitz == kInfinity ? distance.lipschitz() < kInfinity : distance.lipschitz() <= lipschitz;
  s.distance = known || !bounds.finite() ? distance.claimLipschitz(lipschitz)
                                         : nearBounds(distance, bounds, lipschitz);
  s.bounds = bounds;
  s.claim = {ClaimKind::Field, s.distance.lipschitz()};
  return s;
}

}  // namespace sdf
