// A wide union as the list of its operands: which of them is met, and groups of neighbours that can be read
// apart.
#pragma once
#include <span>
#include <vector>

#include "sdf/shape/shape.h"

namespace sdf {

/// One of a union's operands, with its place among them.
struct NumberedOperand {
  Expr distance;
  Box bounds;
  double number;
  double slope = 1.0;  ///< of the distance; infinite where it is not known
};

/// The operands of a hard union, numbered from `first` on; any other shape is its own only one.
std::vector<NumberedOperand> operandsOf(const Shape& shape, double first = 0.0);

/// The number of the operand that is nearest; of several the last. At least one.
Expr numberOfNearest(std::span<const NumberedOperand> operands);

/// The shape's attributes where the operand of this number, from 0 on, is the nearest: for a hard union they
/// follow from the number, without distances. Cost: linear in the number of operands.
Attributes surfaceOf(const Shape& shape, const Expr& number);

/// Some of a union's operands.
struct OperandGroup {
  Expr distance;  ///< the least of them
  Expr step;      ///< how far one may go; see Marchable
  Expr nearest;   ///< the number of that one
};

/// Whether a parameter of this name is a constant of a group, which no scene names.
bool isGroupConstant(const std::string& name);

/// Groups whose least distance is that of the operands: each of neighbours, by their bounds, that are made
/// alike, but for one that takes all others. In those of like operands, numbers in which the operands differ
/// are parameters that have these numbers as their defaults, so that groups of one kind are one formula, for
/// there are as many in each; like operands count as steep as the steepest. Operands' slopes must be known.
/// One group if there are not many alike. Cost: linear in the size of the graphs.
std::vector<OperandGroup> groupsOf(std::span<const NumberedOperand> operands);

}  // namespace sdf
