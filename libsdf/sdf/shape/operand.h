// Shared by the operators: guards for parameters, boxes, and the rules by which claims carry over.
// Private to sdf/shape.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "sdf/shape/check.h"
#include "sdf/shape/shape.h"

namespace sdf {

inline const char* axisName(int axis) { return axis == 0 ? "x" : axis == 1 ? "y" : "z"; }

inline Expr& component(Vec3E& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
inline const Expr& component(const Vec3E& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Refuses a flat shape where only a solid will do.
Check& wantsSolid(Check& check, const Shape& shape);

/// The expression, kept at or above 0 (or away from 0 by a hair) where its parameters' ranges would let it go
/// there. A slider may then touch a value that a call would refuse, without a NaN or a false claim.
Expr notNegative(const Expr& e);
Expr keptPositive(const Expr& e);
Expr keptFromZero(const Expr& e);

bool isEverything(const Box& b);
/// Box grown on every side; everything for an infinite amount.
Box grow(const Box& b, double by);
/// The box that lies in both; where they are apart, the gap between them. It contains the (then empty)
/// intersection of the solids and also what rounding may make of it, as growth demands.
Box overlap(const Box& a, const Box& b);
/// The products of an interval and the range [lo, hi], with 0 times infinity being 0.
Interval timesRange(const Interval& a, double lo, double hi);
/// Largest distance of the box from the origin, and from the axis through it.
double radiusOf(const Box& b);
double radiusAbout(const Box& b, int axis);

/// The box's longest side that ends; 1 where none does.
double sizeOf(const Box& b);

/// How far a coordinate lies outside [lo, hi], negative inside; one of the ends must be finite.
Expr outsideSlab(const Expr& x, double lo, double hi);
/// The greatest outsideSlab over the box's axes that have a finite end, which never exceeds the distance to
/// the box; or nothing where there is none.
std::optional<Expr> outsideBox(const Box& b);

/// Up to rounding, the distance changes no faster than the position: |f| then never exceeds the distance to
/// its zero set.
bool isOneLipschitz(double lipschitz);
/// The claim at a kind that may be weaker.
inline Claim weakened(const Claim& c, ClaimKind kind) {
  return {weaker(c.kind, kind), c.lipschitz, growthOf(c), c.calibrated, c.uncalibrated};
}
/// Makes claim and graph tell each other what they know: a global constant goes to the graph, a better
/// derived one to the claim, and a field that is 1-Lipschitz everywhere is a bound. What was a list of
/// operands is one shape.
Shape settled(Shape s);

/// The same solid with a growth that is known, where its bounds are: outside of them the distance is no less
/// than most of the way there.
Shape withGrowth(Shape s);

/// The shape with its distance and attributes looked up at another position; `stretch` as in remap. Bounds
/// and claim are still the shape's.
Shape movedTo(const Shape& s, const Vec3E& position, double stretch);
/// Does the expression keep its value when x, y or z changes sign, provably by the way it is written (as
/// functions of |x| or x^2 do)?
bool isEven(const Expr& e, int axis);
/// Each attribute mixed by `weight`, or b's where `second` holds, a's elsewhere: so where no weight is given,
/// and always the material's identity.
Attributes mixed(const Attributes& a, const Attributes& b, const Expr& second,
                 const std::optional<Expr>& weight);

/// The list of a union with something done to each operand; nothing where the shape is no union.
std::shared_ptr<const Union> mappedUnion(const Shape& shape,
                                         const std::function<Shape(const Shape&)>& operation);

/// The copies that a shape is made of, looked up at another position, to which the way changes by no more
/// than one moves. Where it is not made of copies it is the only one if it is steeper than 1 and the position
/// depends on inputs: what is known of it by place holds wherever it is moved to.
std::shared_ptr<const Copies> movedCopies(const Shape& shape, const Vec3E& position);

/// The shapes with their materials numbered alike: each MaterialId is a place in the first shape's list,
/// which holds the materials of all by first appearance.
std::vector<Shape> numberedAlike(std::vector<Shape> shapes);

}  // namespace sdf
