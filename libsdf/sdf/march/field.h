// The field that rays are marched through: a distance, and the step that one may go.
#pragma once
#include "sdf/base/result.h"
#include "sdf/eval/tape.h"
#include "sdf/march/rays.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// A distance f for two ends. How far it is: f itself, which light and occlusion read. How far one may go:
/// the step g, which changes by no more than one moves, so that the open ball of radius |g| around a point
/// holds no part of the surface; it has f's sign and zero set.
struct MarchField {
  TapePtr distance;              ///< output 0 is f, negative inside; output 1 is g, f itself without a slope
  double lipschitz = kInfinity;  ///< |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown

  bool hasSlope() const { return lipschitz < kInfinity; }
};

/// The shape's distance, step and slope as marchable() has them. Errors (Scene): a failed shape, a flat one.
/// Cost: that of making a tape.
Result<MarchField> marchField(const Shape& shape);
/// A distance whose slope is at most this everywhere: the step is distance / lipschitz. What is wrong with a
/// slope that is not positive, checkSlope says.
MarchField marchField(const Expr& distance, double lipschitz);

/// Nothing wrong if balls may be marched: the constant is known and positive. `user` begins the message.
Status checkSlope(const MarchField& field, const char* user);

/// Nothing wrong if all rows have one length, every number is finite, directions have length 1, and 0 <= tMin
/// <= tMax. The error (Usage) names the first ray that breaks it. `user` begins the message.
Status checkRays(const Rays& rays, const char* user);

}  // namespace sdf
