// Pieces that several shapes' distances are made of. Private to shape/.
#pragma once
#include <glm/vec2.hpp>

#include "sdf/shape/shape.h"

namespace sdf {

/// A parameter in a size's place is held above this, so that no formula divides by 0 anywhere in its range.
inline constexpr double kSmallestSize = 1e-6;

/// Ends of an expression's range over every value of its parameters; infinite where it may be NaN.
double upper(const Expr& e);
double lower(const Expr& e);

/// The size itself where it is always positive, else held above kSmallestSize.
Expr positiveSize(const Expr& size);

/// a * factor without the product where either is 0, or the factor 1 or -1, for good. Only for finite ones:
/// the graph itself keeps 0 * x, for x may be infinite.
Expr scaled(const Expr& a, const Expr& factor);
Vec3E scaled(const Vec3E& v, const Expr& factor);
/// dot(v, weights) without the terms of weight 0.
Expr weighted(const Vec3E& v, const Vec3E& weights);

/// Length of parts whose joint map (p to (a, b)) has L = 1, coordinates along perpendicular directions for
/// instance.
Expr norm(const Expr& a, const Expr& b);
Expr norm(const Expr& a, const Expr& b, const Expr& c);

/// max(max(a, b), c).
Expr largest(const Expr& a, const Expr& b, const Expr& c);
/// a held within [0, limit], subtracted from a: how far a lies outside.
Expr beyond(const Expr& a, const Expr& limit);
/// norm(out, past), the distance to a segment from how far a point is out of its line and past its ends, with
/// the gradient of `out` on the segment, where a root's would vanish.
Expr segmentDistance(const Expr& out, const Expr& past);

/// Exact distance to a box, given how far the point lies beyond its faces along each axis.
Expr boxDistance(const Expr& x, const Expr& y);
Expr boxDistance(const Expr& x, const Expr& y, const Expr& z);
/// The same of two or three functions instead, with a slope of at most `slope`.
Expr boxDistance(const std::vector<Expr>& sides, double slope);

/// Exact signed distance in the plane to the convex corner between two half-lines, from the distances to
/// their lines, negative inside, and cosine and sine (not 0) of the angle between these lines' normals. On
/// and near the corner the gradient lies between the normals. A convex polygon's distance is the largest of
/// its corners'.
Expr cornerDistance(const Expr& a, const Expr& b, const Expr& cosine, const Expr& sine);

/// Distance of a convex solid from that to the planes of its faces, which holds inside and on the surface,
/// where the gradient of a root would vanish, and the one that holds outside.
Expr insideOr(const Expr& inside, const Expr& outside);

/// Exact distance to the ellipsoid (ellipse: two axes) with these radii, from coordinates along its axes.
Expr ellipsoidDistance(std::vector<Expr> radii, std::vector<Expr> coordinates);

/// Exact signed distance in the plane to a trapezoid with sides at |across| = bottom where along = -half, and
/// |across| = top where along = half. `across` must not be negative.
Expr trapezoidDistance(const Expr& across, const Expr& along, const Expr& bottom, const Expr& top,
                       const Expr& half);

/// The sine of a round cone's slope is held at this where one of its balls nearly holds the other.
inline constexpr double kSteepestCone = 1.0 - 1e-6;
/// Exact distance to the hull of two balls at along = -half and half, from coordinates along and across the
/// axis; where one holds the other, to the larger one. `across` must not be negative.
Expr roundConeDistance(const Expr& across, const Expr& along, const Expr& bottom, const Expr& top,
                       const Expr& half);

/// Distance in the plane to a circular arc about the origin that opens `angle` radians to both sides of the
/// axis `along`.
Expr arcDistance(const Expr& along, const Expr& across, const Expr& radius, const Expr& angle);
/// Up to which half thickness the band around that arc does not run into itself.
double arcReach(const Expr& radius, const Expr& angle);
/// Rectangle around that band: {min across, min along}, {max across, max along}.
std::pair<glm::dvec2, glm::dvec2> arcBounds(const Expr& radius, const Expr& angle, double half);
/// A tube of this radius, or a band of half this thickness, is exact while it does not run into itself, which
/// it does beyond `reach`.
ClaimKind tubeKind(const Expr& radius, double reach);

/// The plane folded by its reflections in the symmetry lines of a regular polygon with a corner on the axis
/// `along`: what is left is the wedge of angles [0, pi / sides] from that axis. An isometry on each piece.
struct Wedge {
  Expr along, across;
};
Wedge foldDihedral(const Expr& along, const Expr& across, int sides);
/// Exact signed distance in the plane to a regular polygon with a corner at along = radius.
Expr regularPolygonDistance(const Expr& along, const Expr& across, int sides, const Expr& radius);
/// Smallest rectangle around that polygon: {min across, min along}, {max across, max along}, radius 1.
std::pair<glm::dvec2, glm::dvec2> regularPolygonBounds(int sides);

/// A shape that is done, its distance claimed to have L = 1.
Shape solid(const Expr& distance, const Box& bounds, ClaimKind kind = ClaimKind::Exact);
/// The same of a flat shape, with its bounds in x and y.
Shape flat(const Expr& distance, const glm::dvec2& min, const glm::dvec2& max,
           ClaimKind kind = ClaimKind::Exact);

}  // namespace sdf
