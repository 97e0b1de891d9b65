// Forms that distances are written in, found again in the graph. Private to sdf/shape.
#pragma once
#include <optional>
#include <vector>

#include "sdf/expr/vec.h"

namespace sdf {

/// Is it the same at every position?
inline bool isUniform(const Expr& e) { return e.lipschitz() == 0.0; }
inline bool isZero(const Expr& e) { return e.isConstant(0.0); }
/// max(u, 0)?
inline bool isMaxWithZero(const Expr& e) { return e.op() == Op::Max && isZero(e.arg(1)); }
/// u - clamp(u, lo, hi)?
bool isBeyond(const Expr& e);

/// The two or three x of sqrt(x^2 + y^2 + ...), else none.
std::vector<Expr> partsOfLength(const Expr& e);
/// The x of boxDistance(x, y, ...), else none.
std::vector<Expr> partsOfBox(const Expr& e);

/// The gradient of a linear function, which is uniform, or nothing.
std::optional<Vec3E> linearGradient(const Expr& e);

/// Is e the length of coordinates at right angles, the distance to a box in them, or the same of such
/// lengths less numbers? Its gradient has the length 1 then where it is positive, and the second derivative
/// is at most 1 / min(e, r): returns r, which is infinite for coordinates and no steeper than 1, else
/// nothing.
std::optional<Expr> innerRadius(const Expr& e);

}  // namespace sdf
