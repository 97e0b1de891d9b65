// Which operand of a union shows at a point, by its number: from it follows the surface, without distances.
#pragma once
#include <span>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::viewer {

/// What a minimum of minima takes the least of, each once, from the first to the last. The distance alone if
/// it is no minimum. Cost: linear in the number of minima.
std::vector<Expr> operandsOf(const Expr& distance);

/// The outputs, where `winner`, the place of the least in `operands`, decides all comparisons between two of
/// them, or two minima of some that stand in a row. It must stand where it does at the point of each reading.
/// Cost: linear in the size of the graph.
std::vector<Expr> decided(std::span<const Expr> outputs, std::span<const Expr> operands, const Expr& winner);

}  // namespace sdf::viewer
