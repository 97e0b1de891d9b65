// A wide union in groups of neighbours, each of which is drawn only where it may be seen.
#pragma once
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::viewer {

/// Expressions whose minimum is the distance, each of operands that are neighbours at the parameters' present
/// values and are made alike, but for one that takes all others. In those of like operands, numbers in which
/// the union's operands differ are parameters that stand at these numbers, so that groups of one kind have
/// one shader, for there are as many in each. The distance alone if it is no minimum of many like operands.
/// Cost: a few readings of each operand.
std::vector<Expr> groupsOf(const Expr& distance);

}  // namespace sdf::viewer
