// Loose pieces of a lattice's mesh that the rest of it swallows once its creases and tips are in place.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// A piece of a mesh apart from all others, as it stands around a sample or two that a thin wedge has caught
/// near its rim.
struct Island {
  std::vector<std::uint32_t> vertices;
  glm::vec3 centre{0.0f};    ///< mean of these as they were when it was found
  bool solid = false;        ///< or a hole; by its volume then
  bool holdsCentre = false;  ///< the centre was within it, as no ring's is
};

/// Has the surface edges of less than 80 degrees? The normals at a triangle's corners tell.
bool hasSharpEdges(const std::vector<glm::vec3>& normals, const std::vector<glm::uvec3>& triangles);

/// Pieces of no more than 512 triangles of a closed mesh. Cost: linear.
std::vector<Island> findIslands(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles);

/// Drops the islands that have their centre, if they hold it, or an eighth of their vertices within the rest
/// of the mesh: solid in what is solid, or holes in what is empty, by the number of times that the rest goes
/// around these points. Their vertices stay, and are of no triangle any more. Cost: linear.
void dropSwallowed(FeatureMesh& mesh, const std::vector<Island>& islands);

}  // namespace sdf
