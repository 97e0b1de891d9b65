// Which operand of a union shows at a point, by its number: from it follows the surface, without distances.
#pragma once
#include <span>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::viewer {

/// What a minimum of minima takes the least of, each once, from the first to the last. The distance alone if
/// it is no minimum. Cost: linear in the number of minima.
std::vector<Expr> operandsOf(const Expr& distance);

/// A union's attributes, where `winner`, the place among operandsOf(distance) of the one that is least,
/// decides what the union chose by its operands' distances. Choices that operands or materials make stay.
/// Cost: linear in the number of minima.
std::vector<Expr> decided(std::span<const Expr> attributes, const Expr& distance, const Expr& winner);

}  // namespace sdf::viewer
