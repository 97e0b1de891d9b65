// Flat shapes: dimension 2, distances in x and y that ignore z, to be extruded or revolved. Their bounds are
// infinite in z. Each is centred at the origin unless it says otherwise; where one has a direction, it points
// along +y. Units, rules and claims are as in solids.h; all are exact.
#pragma once
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "sdf/outline/outline.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// Disc. radius > 0.
Shape circle(const Expr& radius);
/// Rectangle from (-halfWidth, -halfHeight) to (halfWidth, halfHeight). Both > 0.
Shape rectangle(const Expr& halfWidth, const Expr& halfHeight);
/// The same with rounded corners. 0 <= radius <= the smaller half size.
Shape roundedRectangle(const Expr& halfWidth, const Expr& halfHeight, const Expr& radius);
/// All points within `radius` > 0 of the segment between two points, whose z is not used. They may coincide.
Shape segment(const Vec3E& from, const Vec3E& to, const Expr& radius);
/// Regular polygon, a corner on +y; radius > 0 from the centre to a corner. sides >= 3. Cost grows with the
/// logarithm of `sides`.
Shape regularPolygon(int sides, const Expr& radius);
/// Simple polygon through these points, in either direction; a last point equal to the first is left out. At
/// least three finite points; no two neighbours equal, no two edges that touch or cross. Cost: some 20
/// operations an edge, some 15 where the polygon is convex; of more than 64 edges a payload's, some log n
/// (polygon_field.h). Checking takes n log n, up to n squared where long edges lie beside one another.
Shape polygon(std::span<const glm::dvec2> points);
/// How far arcs may be from the curves that they stand for: what is computed, and what shaders draw.
struct CurveTolerance {
  double exact, drawn;
};
/// What contours of lines and Bézier curves enclose, which may lie in one another, cross and overlap; of
/// several outlines their union. Exact
/// to arcs of circles that are nowhere farther from the curves than the tolerance and have their directions
/// (arcContours); so smooth curves have no edges. `name` is whose points must be finite and enclose some
/// area. Cost: that of a polygon of more than 64 edges, with as many sides as there are arcs: of a letter
/// some 250 for a tolerance of 1e-6 of its size, and 50 for 1e-4.
Shape outline(std::span<const Outline> outlines, const CurveTolerance& tolerance,
              const std::string& name = "outline");
inline Shape outline(const Outline& curves, const CurveTolerance& tolerance,
                     const std::string& name = "outline") {
  return outline(std::span(&curves, 1), tolerance, name);
}
/// Star with `points` >= 3 tips at radius `outer`, one on +y, and as many corners at radius `inner` between
/// them. 0 < inner < outer.
Shape star(int points, const Expr& outer, const Expr& inner);
/// Band with round ends along a circle of this radius, `angle` to both sides of +y, thickness from edge to
/// edge. 0 < angle <= pi, sizes > 0. Exact outside where the band runs into itself.
Shape arc(const Expr& angle, const Expr& radius, const Expr& thickness);
/// Band about a circle of this radius, thickness from edge to edge. radius > 0, 0 < thickness < 2 * radius.
Shape ring(const Expr& radius, const Expr& thickness);
/// Ellipse with these radii along x and y, both > 0. Exact as ellipsoid() is.
Shape ellipse(const Expr& radiusX, const Expr& radiusY);
/// Trapezoid with horizontal sides of these half widths at y = -halfHeight and halfHeight. Half widths >= 0,
/// not both 0; halfHeight > 0.
Shape trapezoid(const Expr& halfBottom, const Expr& halfTop, const Expr& halfHeight);

}  // namespace sdf
