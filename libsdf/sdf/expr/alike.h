// Expressions that differ only in numbers, written once.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf {

/// Begins the names of parameters that no scene has. Readings give them a value of their own at each place,
/// so that they are no numbers here.
inline constexpr char kOwnName = '\x01';

/// Lists of expressions that are alike: each is the common one with a row of numbers in its parameters'
/// places. A number is an expression that does not depend on space, such as a formula of the scene's
/// parameters.
struct Alike {
  std::vector<std::size_t> places;      ///< of the lists among all, ascending
  std::vector<Expr> common;             ///< with parameters where not all have one number
  std::vector<Expr> parameters;         ///< these, by the order of a row
  std::vector<std::vector<Expr>> rows;  ///< by list
};

/// A new parameter, with a range that holds all these numbers.
Expr numberAmong(const std::string& name, std::span<const Expr> numbers);

/// Groups lists of expressions that differ only in numbers, in the order of each group's first. Parameters
/// are named `prefix` and a count, over all groups. Claims are dropped. Constants that are one number
/// `asFloats` are not told apart: the first one stands for all. Cost: linear in the size of the graphs.
std::vector<Alike> groupByStructure(std::span<const std::vector<Expr>> lists, const std::string& prefix,
                                    bool asFloats = false);

/// Operations that a reading of the expressions takes, each once; numbers cost none.
std::size_t operationsOf(std::span<const Expr> expressions);

}  // namespace sdf
