// Round tubes along lines in space, as unions of pieces: segments, arcs, and cones between balls.
//
// Numbers must be finite and must not depend on the position. Distances are exact outside.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "sdf/shape/shape.h"

namespace sdf {

/// All points within `radius` > 0 of the line that leads straight from point to point, and back to the first
/// one where it is closed. Two points or more, three if it is closed.
Shape tube(const std::vector<Vec3E>& points, const Expr& radius, bool closed = false);

/// The hulls of neighbouring balls about such points, each with a radius > 0 of its own. Neighbours must be
/// different.
Shape taperedTube(const std::vector<glm::dvec3>& points, const std::vector<Expr>& radii, bool closed = false);

/// The tube along a smooth curve through the points. From one to the next lead two arcs of circles, tangent
/// where they meet (biarcs: Bolton 1975; in space: Sharrock 1987). At each point the curve goes the way of
/// the circle through it and its neighbours, but no more than 90 degrees off the ways to these: points of a
/// circle, neighbours less than half of it apart, give that circle. Neighbours must be different.
Shape curvedTube(const std::vector<glm::dvec3>& points, const Expr& radius, bool closed = false);

/// Round struts between pairs of points, by their numbers from 0 on. At least one.
Shape struts(const std::vector<Vec3E>& points, const std::vector<std::pair<std::size_t, std::size_t>>& edges,
             const Expr& radius);

}  // namespace sdf
