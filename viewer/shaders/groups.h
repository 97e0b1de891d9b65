// A wide union in groups of neighbours, each of which is drawn only where it may be seen.
#pragma once
#include <span>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::viewer {

/// One of a union's operands, with its place among them.
struct Numbered {
  Expr distance;
  double number;
};

/// Some of a union's operands.
struct Group {
  Expr distance;  ///< the least of them
  Expr winner;    ///< the number of that one
};

/// Groups whose least distance is that of the numbered operands, each of neighbours at the parameters'
/// present values that are made alike, but for one that takes all others. In those of like operands, numbers
/// in which the operands differ are parameters that stand at these numbers, so that groups of one kind have
/// one shader, for there are as many in each. One group if there are not many alike. Cost: a few readings of
/// each operand.
std::vector<Group> groupsOf(std::span<const Numbered> operands);

}  // namespace sdf::viewer
