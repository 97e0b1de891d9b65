#include "sdf/mesh/measure/witnesses.h"

#include <cmath>
#include <utility>

namespace sdf {

Witnesses::Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh,
                     std::vector<glm::vec3> borders)
    : surface_(mesh.positions), borders_(std::move(borders)) {
  surface_.insert(surface_.end(), surface.begin(), surface.end());
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
