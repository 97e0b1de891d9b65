// How surfaces meet in boolean operations.
#pragma once
#include <array>
#include <cstddef>

#include "sdf/expr/expr.h"

namespace sdf {

/// How two surfaces meet. With distances a and b, the smooth forms differ from the hard one only where |a -
/// b| < k (the exponential: everywhere, by less and less), and most where a = b: by k/4 (quadratic), k/6
/// (cubic), k ln 2 (exponential), k/2 (chamfer). Their gradients are weighted means of the operands', so none
/// is steeper than both. A k larger than the shapes is taken as it is: a union then swells by so much, which
/// closes gaps, and from an intersection or a difference so much is lost, which may be all.
struct Blend {
  enum class Kind {
    Hard,         ///< an edge
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

/// How far, in units of k, a union of n shapes blended from left to right may lie below the hard one. It is
/// less than 1 but for the exponential, whose depth is ln n.
double deepestBlend(Blend::Kind kind, std::size_t n);

/// What joins two operands of a union, x and y standing for their distances: the joint distance, the weight
/// of the second operand's attributes, and 1 where the second is no farther than the first, whose material
/// then shows.
std::array<Expr, 3> unionJoin(const Blend& blend);

}  // namespace sdf
