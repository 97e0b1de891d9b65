// What is added to the position, gathered: so that a graph may be read near the origin, wherever it lies.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf {

/// The same functions of the position less `origin`: each gives at p - origin what it gave at p. What is
/// added to coordinates on the way is gathered, in double, and parameters' share with it, so that a large
/// origin and a large shift leave their difference alone in the graph. Offsets pass sums, multiples, min,
/// max, select and comparisons as they are, floor, ceil and round but for whole numbers, and sin, cos, tan
/// and mod but for whole periods. Elsewhere they are added before. The values are those of `graphs` but for
/// rounding. Claims are kept. Cost: the size of the graphs.
std::vector<Expr> relativeTo(std::span<const Expr> graphs, const glm::dvec3& origin);

}  // namespace sdf
