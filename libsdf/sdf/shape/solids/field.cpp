// Formulas as shapes.
#include <algorithm>
#include <array>
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
// the nearest point of them, and is no less than the way there, times the slope: within, where the solid is,
// this is below the formula, which it leaves as it is. A point of a box moves no more than the one that it is
// nearest to.
Expr nearBounds(const Expr& formula, const Box& bounds) {
  const Box near = bounds.grown(kMargin * bounds.longestSide());
  const double slope = steepest(formula, near);
  if (slope == kInfinity) return formula;
  const double rise = slope > 0.0 ? slope : 1.0;
  return max(heldWithin(formula, near).claimLipschitz(slope), rise * *outsideBox(near));
}

// The slope at a point, of all values of the parameters.
struct SlopeAt {
  glm::dvec3 at;
  double least, most;
};

// At 125 points of a box, its corners among them.
std::vector<SlopeAt> slopesIn(const Expr& formula, const Box& box) {
  constexpr int kAlong = 5;
  const Vec3E gradient = gradientOf(formula);
  const Expr slopes[] = {gradient.x, gradient.y, gradient.z};
  IntervalReading reading(slopes);
  std::vector<SlopeAt> found;
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const glm::ivec3 at(i % kAlong, i / kAlong % kAlong, i / (kAlong * kAlong));
    SlopeAt here{box.min + glm::dvec3(at) / (kAlong - 1.0) * box.size(), 0.0, 0.0};
    reading.run({here.at, here.at});
    for (std::size_t k = 0; k < 3; ++k) {
      const Interval& slope = reading[k];
      here.least = std::hypot(here.least, slope.nan ? 0.0 : nearest(slope));
      here.most = std::hypot(here.most, slope.magnitude());
    }
    found.push_back(here);
  }
  return found;
}

// Of slopes and their bounds, which are each rounded.
constexpr double kRounding = 1.0 + 1e-6;

// Is the formula steeper than it is said to be at some points around its bounds?
bool isSteeperAround(const Expr& formula, const Box& bounds, double stated) {
  return std::ranges::any_of(slopesIn(formula, bounds.grown(bounds.longestSide())),
                             [&](const SlopeAt& slope) { return slope.most > kRounding * stated; });
}

// A formula that has the slope within the bounds. The solid is in them, so that outside the way to it is
// neither below that to the bounds nor below what the formula says at their nearest point: dividing by the
// slope never makes more than that of it.
Expr cautiousOutside(const Expr& formula, const Box& bounds, double slope) {
  const Expr most = max(heldWithin(formula, bounds).claimLipschitz(slope), slope * *outsideBox(bounds));
  return min(formula, most).claimLipschitz(slope);
}

}  // namespace

std::optional<SteepPlace> steeperThan(const Expr& formula, const Box& bounds, double lipschitz) {
  if (!bounds.finite() || lipschitz >= formula.lipschitz()) return {};
  const std::vector<SlopeAt> slopes = slopesIn(formula, bounds);
  const SlopeAt& steepest = *std::ranges::max_element(slopes, {}, &SlopeAt::least);
  if (!(steepest.least > kRounding * lipschitz)) return {};
  return SteepPlace{steepest.at, steepest.least};
}

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
