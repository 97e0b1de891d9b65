// The derivative of an expression as expressions, for readings that compile it instead of interpreting it.
#pragma once
#include "sdf/expr/vec.h"

namespace sdf {

/// The partial derivatives along x, y and z, written by the rules of number/dual-inl.h, so that creases and
/// vertical tangents have the slopes that the dual readings give them. Factors of 0 and 1 are left out, so a
/// slope that multiplies an infinite value by 0 is 0 here and NaN there. Cost: some times the size of the
/// graph.
Vec3E gradientOf(const Expr& e);

}  // namespace sdf
