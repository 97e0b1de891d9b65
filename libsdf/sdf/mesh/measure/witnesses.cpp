#include "sdf/mesh/measure/witnesses.h"

#include <cmath>

namespace sdf {

Witnesses::Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, bool withBorders)
    : surface_(mesh.positions) {
  surface_.insert(surface_.end(), surface.begin(), surface.end());
  if (!withBorders) return;
  std::vector<char> onCrease(mesh.positions.size(), 0);
  for (const auto& [a, b] : mesh.creases) onCrease[a] = onCrease[b] = 1;
  for (std::size_t v = 0; v < onCrease.size(); ++v)
    if (onCrease[v]) borders_.push_back(mesh.positions[v]);
}

void Witnesses::add(const std::vector<glm::vec3>& surface) {
  surface_.insert(surface_.end(), surface.begin(), surface.end());
}

SurfaceDistance Witnesses::toSurface(const FeatureMesh& mesh, Progress& progress) const {
  return distanceToMesh(surface_, mesh.positions, mesh.triangles, progress);
}

double Witnesses::toBorders(const FeatureMesh& mesh, Progress& progress) const {
  if (borders_.empty()) return 0.0;
  if (mesh.creases.empty()) return HUGE_VAL;
  std::vector<glm::uvec3> edges;  // triangles without an area
  for (const auto& [a, b] : mesh.creases) edges.emplace_back(a, b, b);
  return distanceToMesh(borders_, mesh.positions, edges, progress).max;
}

}  // namespace sdf
