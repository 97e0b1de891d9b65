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

/// How two surfaces meet. With distances a and b, the smooth forms differ from the hard one only where |a -
/// b| < k (the exponential: everywhere, by less and less), and most where a = b: by k/4 (quadratic), k/6
/// (cubic), k ln 2 (exponential), k/2 (chamfer). Their gradients are weighted means of the operands', so none
/// is steeper than both. A k larger than the shapes is taken as it is: a union then swells by so much, which
/// closes gaps, and from an intersection or a difference so much is lost, which may be all.
struct Blend {
  enum class Kind {
    Hard,
    Quadratic,    ///< rounded, continuous slope (Quilez, "smooth minimum", 2013)
    Cubic,        ///< rounded, continuous curvature (Quilez 2013)
    Exponential,  ///< k log-sum-exp; does not depend on the order of the operands
    Chamfer       ///< a flat bevel where a + b = k, as hg_sdf's (Mercury 2015) but scaled to stay a bound
  };
  Kind kind = Kind::Hard;
  Expr k = 0.0;  ///< scene units, positive; may be a parameter

  static Blend hard() { return {}; }
  static Blend quadratic(Expr k) { return {Kind::Quadratic, std::move(k)}; }
  static Blend cubic(Expr k) { return {Kind::Cubic, std::move(k)}; }
  static Blend exponential(Expr k) { return {Kind::Exponential, std::move(k)}; }
  static Blend chamfer(Expr k) { return {Kind::Chamfer, std::move(k)}; }
};

/// What is in any of the shapes. Hard: a balanced tree of minima; exact outside if all operands are exact
/// outside, else a bound. Smooth: blended from left to right; a bound. Fails on an empty list and on k <= 0.
Shape unite(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape unite(const Shape& a, const Shape& b, const Blend& blend = {});

/// What is in all of the shapes. A bound.
Shape intersect(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape intersect(const Shape& a, const Shape& b, const Blend& blend = {});

/// What is in the first shape and in none of the others. A bound.
Shape subtract(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape subtract(const Shape& a, const Shape& b, const Blend& blend = {});

/// What is in an odd number of the shapes; of two: in one but not in both. A bound. Smooth: the smooth union
/// less the smooth intersection.
Shape exclude(const std::vector<Shape>& shapes, const Blend& blend = {});
Shape exclude(const Shape& a, const Shape& b, const Blend& blend = {});

inline Shape operator|(const Shape& a, const Shape& b) { return unite(a, b); }
inline Shape operator&(const Shape& a, const Shape& b) { return intersect(a, b); }
inline Shape operator-(const Shape& a, const Shape& b) { return subtract(a, b); }
inline Shape operator^(const Shape& a, const Shape& b) { return exclude(a, b); }

}  // namespace sdf
