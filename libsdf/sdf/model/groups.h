// A wide union as the list of its operands: the operand that is met, the formulas that operands share, and
// groups of neighbours that can be read apart.
#pragma once
#include <span>
#include <vector>

#include "sdf/expr/alike.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// One of a union's operands, with its place among them.
struct NumberedOperand {
  Expr distance;
  Box bounds;
  double growth;  ///< see Claim
  double number;
  double slope = 1.0;                      ///< of the distance; infinite where it is not known
  std::shared_ptr<const Copies> copies{};  ///< see Shape
};

/// Is it the least of several operands, not blended?
bool isHardUnion(const Shape& shape);

/// The operands of a hard union, numbered from `first` on; any other shape is its own only one.
std::vector<NumberedOperand> operandsOf(const Shape& shape, double first = 0.0);

/// The number of the operand that is nearest; of several the last. At least one.
Expr numberOfNearest(std::span<const NumberedOperand> operands);

/// Formulas with parameters that no scene names, and rows of numbers to read them with, none of which depends
/// on space.
struct NumberRows {
  std::vector<Expr> parameters;
  std::vector<std::vector<Expr>> numbers;  ///< of each row, by parameter
};

/// Groups of some of a union's operands, as many in each, that differ only in numbers.
struct OperandKind {
  Expr distance;  ///< of a group: the least of its operands'
  Expr step;      ///< how far one may go; see Marchable
  Expr nearest;   ///< the number of the nearest operand
  Expr gap;       ///< where positive, no more than the way to the group's bounds; -infinity if it has none
  double slope = 0.0;       ///< of the distance
  double growth = 0.0;      ///< outside of the bounds the distance is no less than gap / growth
  double stepGrowth = 0.0;  ///< the same of the step
  NumberRows groups;
  std::size_t gapNumbers = 0;  ///< how many parameters `gap` has, the first ones
  /// Each group is one operand, of many operations, within these bounds by group, which are finite; empty:
  /// groups are of several, or not all have bounds.
  std::vector<Box> singles;
};

/// A union's operands, sorted by what is read together.
struct Kinds {
  std::vector<OperandKind> many;        ///< operands whose formulas are worth sharing
  std::vector<NumberedOperand> others;  ///< the rest
};

/// How the operands of a kind are put into groups.
enum class Grouping {
  Neighbours,  ///< a group that is quick to read takes several neighbours; all groups are read in turn
  Singles      ///< each operand is a group; a list names the groups that are read (model/cells.h)
};

/// Sorts operands into kinds. A kind's formula is shared as soon as that saves some hundred operations.
/// Operands of a kind count as steep as the steepest; slopes must be known. Cost: linear in the size of the
/// graphs.
Kinds kindsOf(std::span<const NumberedOperand> operands, Grouping grouping = Grouping::Neighbours);

/// A union's attributes, those of like operands written once.
struct OperandSurfaces {
  Attributes attributes;  ///< where the operand of the given number is the nearest, with parameters of rows
  NumberRows operands;    ///< by operand; without parameters where nothing is worth to be shared
};

/// The shape's attributes where the operand of this number, from 0 on, is the nearest: for a hard union they
/// follow from the number, without distances. They are written once if that may be, and saves some hundred
/// operations. Cost: linear in the size of the graphs.
OperandSurfaces surfaceOf(const Shape& shape, const Expr& number, bool mayShare);

}  // namespace sdf
