// What the warps of space share. Private to sdf/shape.
//
// With f the operand, La its constant, T the map from the result's space back to the operand's and L the
// largest singular value of T's Jacobian, f(T(p)) / (La L) is a bound wherever all of that holds. Two ways
// make it hold everywhere.
//
// Clamp (twist, taper): p is first projected to a convex region that contains the solid, and the result is
// max(f(T(proj p)) / (La L), d) with d 1-Lipschitz, negative inside the region and positive outside. A
// projection to a convex set moves no two points apart, so this is 1-Lipschitz; its zero set is the solid's.
//
// Cap (bend): where T tears or stretches without limit, T(p) is farther than some g from the operand's
// bounds, so that f(T(p)) > c = g / growth there. min(f(T(p)), c) is then the constant c, which hides the
// tear.
#pragma once
#include "sdf/shape/operand.h"

namespace sdf {

bool finiteAlong(const Box& b, int axis);
double farthestAlong(const Box& b, int axis);

/// The warped shape where nothing is proven of it: a field.
Shape asField(Shape warped);
/// The warped shape with a distance that is proven to be 1-Lipschitz everywhere.
Shape withProvenBound(Shape warped, const Expr& distance, double growth);

}  // namespace sdf
