// What rays are marched through: a distance, and how steep it can be.
#pragma once
#include "sdf/base/result.h"
#include "sdf/eval/tape.h"
#include "sdf/march/rays.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// A distance f and its proven slope. Marching works with g = f / lipschitz: it changes by no more than one
/// moves, so that the open ball of radius |g| around a point holds no part of the surface.
struct MarchField {
  TapePtr distance;              ///< output 0 is f, negative inside
  double lipschitz = kInfinity;  ///< |f(p) - f(q)| <= lipschitz |p - q|; infinite where unknown

  bool hasSlope() const { return lipschitz < kInfinity; }
  /// What f is divided by: the Lipschitz constant, or 1 where there is none.
  double divisor() const { return hasSlope() ? lipschitz : 1.0; }
};

/// The shape's distance and slope as marchable() has them. Errors (Scene): a failed shape, a
/// flat one. Cost: that of making a tape.
Result<MarchField> marchField(const Shape& shape);

/// Nothing wrong if balls may be marched: the constant is known and positive. `user` begins the message.
Status checkSlope(const MarchField& field, const char* user);

/// Nothing wrong if all rows have one length, every number is finite, directions have length 1, and 0 <= tMin
/// <= tMax. The error (Usage) names the first ray that breaks it. `user` begins the message.
Status checkRays(const Rays& rays, const char* user);

}  // namespace sdf
