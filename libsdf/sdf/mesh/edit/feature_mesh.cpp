#include "sdf/mesh/edit/feature_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace sdf {

bool isMostlyFlat(const FeatureMesh& mesh) {
  constexpr float kAlike = 1.0f - 1e-6f;  // cosine; chosen, far above the rounding of floats
  std::vector<glm::vec3> around(mesh.positions.size(), glm::vec3(0.0f)), areas;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x];
    areas.push_back(glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a));
    for (int k = 0; k < 3; ++k) around[t[k]] += areas.back();
  }
  double all = 0.0, flat = 0.0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const float size = glm::length(areas[i]);
    bool isFlat = true;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3& n = around[mesh.triangles[i][k]];
      isFlat = isFlat && glm::dot(areas[i], n) > kAlike * size * glm::length(n);
    }
    all += size;
    if (isFlat) flat += size;
  }
  return flat > 0.5 * all;
}

std::vector<std::uint32_t> dropUnused(FeatureMesh& mesh, std::vector<glm::vec3>* normals) {
  std::erase_if(mesh.triangles, isGone);
  Compaction left = dropUnusedVertices(mesh.triangles, mesh.positions.size());
  left.apply(mesh.positions), left.apply(mesh.held);
  if (normals) left.apply(*normals);
  // Numbers keep their order, and so do the creases.
  for (auto& [a, b] : mesh.creases) a = left.after[a], b = left.after[b];
  return std::move(left.after);
}

}  // namespace sdf
