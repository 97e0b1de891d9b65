#include "sdf/model/float_range.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sdf/shape/catalog.h"

namespace sdf {
namespace {

// Lengths whose squares are floats end here, and begin with its inverse.
constexpr double kLargest = 0x1p63;
// Floats end before it.
constexpr double kInfinite = 0x1p128;

}  // namespace

std::optional<std::string> beyondFloats(const Box& bounds) {
  if (bounds.empty()) return std::nullopt;
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {bounds.min[axis], bounds.max[axis]})
      if (std::isfinite(side)) farthest = std::max(farthest, std::abs(side));
  if (farthest > kLargest)
    return "it reaches " + shown(farthest) + " from the origin; squares of lengths over " + shown(kLargest) +
           " are no floats: move it to the origin, or scale it down";
  const double size = bounds.longestSide();
  if (size > 0.0 && size < 1.0 / kLargest)
    return "its bounds are " + shown(size) + " long; squares of lengths below " + shown(1.0 / kLargest) +
           " are no floats: scale it up";
  return std::nullopt;
}

std::optional<std::string> beyondFloats(const Shape& shape) {
  std::vector<Expr> graphs{shape.distance};
  graphs.insert(graphs.end(), shape.surface.begin(), shape.surface.end());
  const std::vector<Expr> nodes = topologicalOrder(graphs);
  if (std::ranges::find(nodes, Op::Parameter, &Expr::op) == nodes.end())
    if (auto why = beyondFloats(shape.bounds)) return why;
  for (const Expr& e : nodes)
    if (e.isConstant() && std::isfinite(e.constantValue()) && std::abs(e.constantValue()) >= kInfinite)
      return "the number " + shown(e.constantValue()) +
             " in its formulas is none of the floats, which end at " + shown(kInfinite) +
             ": take a smaller one";
  return std::nullopt;
}

}  // namespace sdf
