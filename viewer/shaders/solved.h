// Operands that a ray meets where an equation in t is solved, instead of being marched to.
#pragma once
#include <optional>

#include "sdf/model/groups.h"

namespace sdf::viewer {

/// A HalfSpace is an operand that rays meet by division.
struct HalfSpace {
  NumberedOperand operand;
  Expr height;  ///< the distance divided by its slope
  Expr climb;   ///< how the height changes along the direction in normal()
};

/// A Ball is a shape that rays meet by a square root.
struct Ball {
  Vec3E centre;
  Expr squaredRadius;  ///< negative if there is no ball at these parameters' values
};

/// The shape, which is this operand, as a half space, if its distance is a linear function.
std::optional<HalfSpace> halfSpaceOf(const Shape& shape, const NumberedOperand& operand);

/// The shape as a ball, if its distance is a root of |p - c|^2 + e, times and plus what does not depend on
/// space: a ball moved, turned, scaled and offset, or a rounded point.
std::optional<Ball> ballOf(const Shape& shape);

}  // namespace sdf::viewer
