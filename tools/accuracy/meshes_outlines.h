// The flat shapes' outlines from their definitions. Lengths in scene units, angles in radians.
#pragma once
#include "meshes.h"

namespace sdf::accuracy {

Outline circleOutline(double radius);
Outline ellipseOutline(double radiusX, double radiusY);
/// Its half x >= 0.
Outline halfEllipseOutline(double radiusX, double radiusY);
/// Rectangle with these half sizes, its corners rounded with this radius, which may be 0.
Outline rectangleOutline(double halfWidth, double halfHeight, double radius);
/// All points within `radius` of the segment.
Outline segmentOutline(const glm::dvec2& from, const glm::dvec2& to, double radius);
/// Corners at `outer` from the origin, one on +y; with `inner` > 0 as many at that distance between them.
Outline starOutline(int points, double outer, double inner = 0.0);
Outline polygonOutline(std::span<const glm::dvec2> points);
/// All points within `half` of the arc of this radius, `angle` to both sides of +y; only the outer boundary
/// where the band overlaps itself.
Tessellation bentBand(double angle, double radius, double half);

}  // namespace sdf::accuracy
