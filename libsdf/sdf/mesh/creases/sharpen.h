// Cutting a mesh along the creases of its surface.
#pragma once
#include "sdf/mesh/creases/crease.h"
#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

struct Sharpened {
  FeatureMesh mesh;
  std::vector<std::uint32_t> doubtful;  ///< vertices that cannot be moved at will: see uncrossMoved
};

/// Cuts the triangles of a closed mesh, whose vertices are on the surface, along its creases: an edge that
/// crosses one gets a vertex there, a triangle that three smooth pieces share gets their corner. Edges that
/// more than two pieces share are halved before, up to three times over. Short edges at creases are taken out
/// again, and triangles that are turned over, where that may be. `normals` are the gradients' at the
/// vertices, and become those of the mesh's; zero on creases. The mesh stays closed, and as manifold as it
/// was. Where it would cross itself the cuts are taken back, and where that does not help the vertices go
/// back to where they were `extracted`, if these places are given (uncross.h).
Sharpened sharpen(std::vector<glm::vec3> positions, std::vector<glm::vec3>& normals,
                  std::vector<glm::uvec3> triangles, const std::vector<glm::vec3>& extracted,
                  const LocalField& field, Progress& progress);

}  // namespace sdf
