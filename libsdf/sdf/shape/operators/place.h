// Moving, turning, scaling and mirroring. Attributes move along with their shape. Angles in radians; turns
// follow the right-hand rule. On a flat shape the z parts are ignored where they can mean nothing, and
// refused where they would tilt it. A failed operand is passed on; numbers must be finite and must not depend
// on the position.
#pragma once
#include <glm/vec3.hpp>

#include "sdf/shape/shape.h"

namespace sdf {

/// Moved by `offset`. The claim stays.
Shape translate(const Shape& shape, const Vec3E& offset);
/// Moved by -origin, finite, and written so that a large origin and the shape's own shifts cancel in double
/// (expr/offsets.h): what lies far from the origin is read in floats as well as at it. The claim stays.
Shape relativeTo(const Shape& shape, const glm::dvec3& origin);

/// Turned about the x axis, then about y, then about z (the axes stay fixed). The claim stays. A rotation
/// matrix entry within 1e-15 of 0 or 1 is taken as that number, so that quarter turns cost nothing.
Shape rotate(const Shape& shape, const Vec3E& angles);
/// Turned by `angle` about the axis through the origin. Fails on the axis (0, 0, 0).
Shape rotateAbout(const Shape& shape, const Vec3E& axis, const Expr& angle);

/// Scaled about the origin; a negative factor also reflects. The distance is multiplied by |factor|: the
/// claim stays. Fails on 0.
Shape scale(const Shape& shape, const Expr& factor);
/// Scaled along each axis. With unequal factors the distance is calibrated, see deform.h: exact where it is
/// that to a box, near the true one of what is round by a radius, else off by up to the root of the factors'
/// ratio.
Shape scale(const Shape& shape, const Vec3E& factors);

/// What the shape's distance is elsewhere, at a place that may depend on the position: a number for other
/// formulas, negative inside. A flat shape's z says nothing. Its slope is known where the place's is.
/// Precondition: shape.ok().
Expr distanceAt(const Shape& shape, const Vec3E& place);

/// The shape united with its mirror image in the plane through the origin across `normal`. Where the bounds
/// show that the shape keeps to one side, it is evaluated once, and an exact distance stays exact.
Shape mirror(const Shape& shape, const Vec3E& normal);

}  // namespace sdf
