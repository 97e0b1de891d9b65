// How many operations of a graph stand upon one another.
#pragma once
#include <cstdint>

#include "sdf/expr/expr.h"

namespace sdf {

/// The longest way from the expression to a constant, a variable or a parameter, in operations; 0 for these.
/// Known of each node as it is made.
std::uint32_t depthOf(const Expr& e);

}  // namespace sdf
