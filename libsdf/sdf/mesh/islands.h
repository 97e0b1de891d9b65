// Loose pieces of a lattice's mesh that the rest of it swallows once its creases are in place.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/feature_mesh.h"

namespace sdf {

/// Around a sample or two that a thin wedge has caught near its rim, apart from all others.
struct Island {
  std::vector<std::uint32_t> vertices;
  glm::dvec3 centre{0.0};  ///< where it was extracted
  bool solid = false;      ///< or a hole
};

/// Pieces of no more than 512 triangles of a closed mesh, if its surface has edges of less than 80 degrees,
/// which `normals` tell. Cost: linear, and little where there are no such edges.
std::vector<Island> findIslands(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::vec3>& normals,
                                const std::vector<glm::uvec3>& triangles);

/// Drops the islands that have their centre or an eighth of their vertices within the rest of the mesh: solid
/// in what is solid, or holes in what is empty. `islandOf` has the number of each vertex's island, ~0 for
/// none. Vertices stay, and are of no triangle any more. Cost: linear.
void dropSwallowed(FeatureMesh& mesh, const std::vector<Island>& islands,
                   const std::vector<std::uint32_t>& islandOf);

}  // namespace sdf
