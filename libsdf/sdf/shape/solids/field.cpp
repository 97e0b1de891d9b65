// Formulas as shapes.
#include <cmath>

#include "sdf/expr/gradient.h"
#include "sdf/shape/calibrate/cells.h"
#include "sdf/shape/check.h"
#include "sdf/shape/operand.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

// How far beyond the bounds the formula is taken as it is, as a share of their longest side: what leaves them
// is then seen to.
constexpr double kMargin = 0.5;

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

// The formula where it is asked for near its bounds, which alone has a slope: elsewhere it is looked up at
// the nearest point of them, and is no less than the way there. A point of a box moves no more than the one
// that it is nearest to.
Expr nearBounds(const Expr& formula, const Box& bounds) {
  const Box near = bounds.grown(kMargin * bounds.longestSide());
  const double slope = steepest(formula, near);
  if (slope == kInfinity) return formula;
  return max(heldWithin(formula, near).claimLipschitz(slope), *outsideBox(near));
}

// Is the formula steeper than it is said to be at some points around its bounds?
bool isSteeperAround(const Expr& formula, const Box& bounds, double stated) {
  constexpr int kAlong = 5;
  constexpr double kRounding = 1.0 + 1e-6;
  const Vec3E gradient = gradientOf(formula);
  const Expr slopes[] = {gradient.x, gradient.y, gradient.z};
  IntervalReading reading(slopes);
  const Box around = bounds.grown(bounds.longestSide());
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const glm::ivec3 at(i % kAlong, i / kAlong % kAlong, i / (kAlong * kAlong));
    const glm::dvec3 p = around.min + glm::dvec3(at) / (kAlong - 1.0) * around.size();
    reading.run({p, p});
    double square = 0.0;
    for (std::size_t k = 0; k < 3; ++k) square += std::pow(std::max(-reading[k].lo, reading[k].hi), 2);
    if (square > std::pow(kRounding * stated, 2)) return true;
  }
  return false;
}

// A formula that has the slope within the bounds. The solid is in them, so that outside the way to it is
// neither below that to the bounds nor below what the formula says at their nearest point: dividing by the
// slope never makes more than that of it.
Expr cautiousOutside(const Expr& formula, const Box& bounds, double slope) {
  const Expr most = max(heldWithin(formula, bounds).claimLipschitz(slope), slope * *outsideBox(bounds));
  return min(formula, most).claimLipschitz(slope);
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
  s.distance = distance.claimLipschitz(lipschitz);
  if (bounds.finite() && lipschitz < distance.lipschitz() && isSteeperAround(distance, bounds, lipschitz))
    s.distance = cautiousOutside(distance, bounds, lipschitz);
  if (s.distance.lipschitz() == kInfinity && bounds.finite()) s.distance = nearBounds(distance, bounds);
  s.bounds = bounds;
  s.claim = {ClaimKind::Field, s.distance.lipschitz()};
  return s;
}

}  // namespace sdf
