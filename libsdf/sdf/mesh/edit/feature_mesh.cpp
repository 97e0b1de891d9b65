#include "sdf/mesh/edit/feature_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace sdf {

std::vector<std::uint32_t> dropUnused(FeatureMesh& mesh, std::vector<glm::vec3>* normals) {
  std::erase_if(mesh.triangles, isGone);
  Compaction left = dropUnusedVertices(mesh.triangles, mesh.positions.size());
  left.apply(mesh.positions), left.apply(mesh.tips);
  if (normals) left.apply(*normals);
  // Numbers keep their order, and so do the creases.
  for (auto& [a, b] : mesh.creases) a = left.after[a], b = left.after[b];
  return std::move(left.after);
}

}  // namespace sdf
