// A warped shape's distance, calibrated: divided by its slope at the point, not by its largest slope
// anywhere. Private to sdf/shape.
#pragma once
#include <functional>

#include "sdf/shape/shape.h"

namespace sdf {

/// A smooth map that carries a shape's points elsewhere, given by its inverse T, with T's Jacobian J. Members
/// about J are expressions at position(), a point of the shape's own space.
struct Warp {
  Vec3E back;  ///< T(p): where the result's point p is looked up
  /// J^T n up to a rotation, linear in n: a function with the gradient n has the slope |J^T n| in the result.
  std::function<Vec3E(const Vec3E& n)> pulled;
  Expr usual;                ///< a typical |J^T n| for unit n
  Expr shear;                ///< an upper bound of |J^T n| / usual
  Expr least;                ///< a lower bound of |J^T n| / usual
  Box region;                ///< where these hold and the result's slope matters
  Expr beyond;               ///< where this is positive they need not hold
  double size;               ///< of the shape
  double reach = kInfinity;  ///< how far from curved parts their slope matters
  double cap = kInfinity;    ///< a result that is no less than this may be steeper

  Expr stretchAlong(const Vec3E& n) const;  ///< |J^T n|
  Expr climb(const Expr& s) const;          ///< |J^T grad log s|
};

/// The shape's distance f after the warp: it has the sign of f(T(p)), a slope of about 1 near its zeros, and
/// a proven constant. Near a smooth zero the distance is f(T) / |J^T grad f| (Taubin 1994). To keep it
/// continuous, f is taken apart where it is the least or greatest of functions, the distance to a box in
/// them, or their length, and each is calibrated by itself: a linear one, such as a face's, by its own slope;
/// a curved one, such as a sphere, by its own as far as its radius allows (curved.h), unless there are
/// dozens; any other by the usual one, for which it may be off by the shear. The constant is bounded by
/// intervals over cells of the region; it is infinite where the shape's own is.
Expr calibrated(const Expr& distance, const Warp& warp);

}  // namespace sdf
