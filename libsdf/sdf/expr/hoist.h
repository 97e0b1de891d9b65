// Less work for the same values: functions that keep an order taken once after a minimum instead of once for
// each argument.
#pragma once
#include <span>

#include "sdf/expr/expr.h"

namespace sdf {

/// The expression with min(g(a), g(b)) written as g(min(a, b)), and max alike, wherever g is a square root, a
/// sum or difference with one term in common, or a product with a common factor that is never negative. A
/// union of balls of one radius then takes one root. max(a, sqrt(a^2 + ...)), the distance to a segment, is
/// written as the root, whose gradient vanishes on the segment. Values are the same to the bit (such a g
/// keeps the order of floats, too, and sqrt(a^2) is |a|, unless a^2 underflows) but for the sign of zeros and
/// for NaN, whose place is up to the reading; claims are dropped. Cost: linear in the size of the graph.
Expr hoisted(const Expr& e);

/// The number of the least value. Where two values are one function of two arguments, the arguments are
/// compared instead. If these are equal, the last of them counts; if only the function rounds to one value,
/// any of them may. There are as many numbers as values, at least one. Cost: linear in the size of the
/// graphs.
Expr indexOfMin(std::span<const Expr> values, std::span<const Expr> numbers);

}  // namespace sdf
