// Where two smooth pieces of a surface meet: found between the vertices of a mesh, from exact gradients
// alone.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// A point near a crease, and what is known of its two sides.
struct CreasePoint {
  glm::vec3 at;                     ///< scene units
  std::array<glm::vec3, 2> normal;  ///< unit normals of the sides
  glm::vec3 toFirst;                ///< some way from the second side to the first
  bool placed = false;              ///< `at` is on the crease
  bool corner = false;              ///< `at` is where the crease ends at a third piece
};

/// Moves points onto the creases beside them: each side's tangent plane is taken from the exact gradient a
/// little away on that side, and the nearest point of their common line follows (Newton's method of least
/// norm). Where a third piece is the surface there, the point goes to where the crease ends at it. `placed`
/// tells whether both sides were met and the surface is there. Of a side that bends with radius r the error
/// is about (voxel / 100)² / r, beside the rounding of float. Cost: five readings a point, and fifteen more
/// where the sides are not met at first.
void placeOnCreases(std::span<CreasePoint> points, const LocalField& field, Progress& progress);

/// A point near a corner of three smooth pieces.
struct CornerPoint {
  glm::vec3 at{0.0f};                 ///< scene units
  std::array<glm::vec3, 3> normal{};  ///< unit normals of the pieces
  std::array<glm::vec3, 3> on{};      ///< points of the pieces, where they have these normals
  bool placed = false;                ///< `at` is the corner
};

/// The same for corners, where three tangent planes meet; where two of them are nearly parallel the nearest
/// point of the sharpest crease. What is not placed keeps its place.
void placeCorners(std::span<CornerPoint> corners, const LocalField& field, Progress& progress);

/// Where an edge of a mesh crosses a crease.
struct Crossing {
  std::array<std::uint32_t, 2> edge;  ///< vertices, the lower first; the sides are theirs
  CreasePoint point;
};

/// Looks for a crease across each edge of a closed mesh whose ends have normals more than kCreaseAngle apart:
/// a jump of the gradient along the edge is halved in until it is certain, which tells a crease from a bend
/// with a radius of more than about half an edge. Payloads that kink between their samples count as
/// smooth (Payload::hasCreases). A crossing lies within four voxels of its edge, or, at the end of a thin
/// wedge, within what that goes on for where it is two voxels thick. Ordered by triangles.
std::vector<Crossing> findCrossings(const std::vector<glm::vec3>& positions,
                                    const std::vector<glm::vec3>& normals,
                                    const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                    Progress& progress);

}  // namespace sdf
