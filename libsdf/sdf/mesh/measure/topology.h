// How the triangles of a mesh hang together, and where they cross.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/mesh.h"

namespace sdf {

/// Watertight, manifold, components (by shared vertices) and Euler characteristic of an indexed mesh. Cost: n
/// log n.
void measureTopology(const std::vector<glm::uvec3>& triangles, std::size_t vertices, MeshStats& stats);

/// How many pairs of triangles cross (crossingTriangles), and where the first does.
void measureCrossings(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                      MeshStats& stats);

}  // namespace sdf
