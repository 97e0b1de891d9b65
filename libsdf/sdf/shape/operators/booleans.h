// Boolean operations on shapes, hard and smooth.
//
// Whose surface is seen: a union shows the operand that is nearer, and a later operand wins a tie.
// Intersection and difference keep the first operand's surface throughout, cut faces included. A smooth union
// mixes each attribute by the weight that mixes the distance, the derivative of the smooth minimum by that
// operand's distance; the material that weighs more gives its identity.
//
// All operands must be solids or all flat. A failed operand, the first of several, is passed on.
#pragma once
#include <vector>

#include "sdf/shape/shape.h"

namespace sdf {

/// All points that are in any of the shapes. Hard: a balanced tree of minima; exact outside if all operands
/// are exact outside, else a bound. Smooth: blended from left to right; a bound. Fails on an empty list and
/// on k <= 0.
Shape unite(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape unite(const Shape& a, const Shape& b, const Blend& blend = {});

/// All points that are in all of the shapes. A bound.
Shape intersect(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape intersect(const Shape& a, const Shape& b, const Blend& blend = {});

/// All points that are in the first shape and in none of the others. A bound.
Shape subtract(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape subtract(const Shape& a, const Shape& b, const Blend& blend = {});

/// All points that are in an odd number of the shapes; of two: in one but not in both. A bound. Smooth: the
/// smooth union less the smooth intersection.
Shape exclude(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape exclude(const Shape& a, const Shape& b, const Blend& blend = {});

/// An operand of a smooth operation as the blend reads it: a formula's distance is made near the true one as
/// far as the blend is wide (field() alone claims its sign and zeros only). Anything else is the shape
/// itself.
Shape readyToBlend(const Shape& shape, const Blend& blend);

inline Shape operator|(const Shape& a, const Shape& b) { return unite(a, b); }
inline Shape operator&(const Shape& a, const Shape& b) { return intersect(a, b); }
inline Shape operator-(const Shape& a, const Shape& b) { return subtract(a, b); }
inline Shape operator^(const Shape& a, const Shape& b) { return exclude(a, b); }

}  // namespace sdf
