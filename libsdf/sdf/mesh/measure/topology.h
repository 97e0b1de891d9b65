// How the triangles of a mesh hang together.
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

}  // namespace sdf
