#include "sdf/mesh/measure/witnesses.h"

#include <algorithm>
#include <cmath>

namespace sdf {

Witnesses::Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, bool withBorders)
    : surface_(mesh.positions) {
  surface_.insert(surface_.end(), surface.begin(), surface.end());
  if (withBorders) addBorders(mesh);
}

Witnesses::Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, double limit,
                     bool withBorders, Progress& progress)
    : surface_(mesh.positions) {
  const std::vector<NearestPoint> nearest =
      nearestTriangles(surface, mesh.positions, mesh.triangles, progress);
  for (std::size_t i = 0; i < surface.size() && !progress.stopped(); ++i) {
    const double d = std::sqrt(nearest[i].squared);
    lacking_ = std::max(lacking_, d);
    if (d <= limit) surface_.push_back(surface[i]);
  }
  if (withBorders) addBorders(mesh);
}

void Witnesses::add(const std::vector<glm::vec3>& surface) {
  surface_.insert(surface_.end(), surface.begin(), surface.end());
}

void Witnesses::addBorders(const FeatureMesh& mesh) {
  std::vector<char> onCrease(mesh.positions.size(), 0);
  for (const auto& [a, b] : mesh.creases) onCrease[a] = onCrease[b] = 1;
  for (std::size_t v = 0; v < onCrease.size(); ++v)
    if (onCrease[v]) borders_.push_back(mesh.positions[v]);
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

Witnesses::Missed Witnesses::missedBy(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles, double limit,
                                      Progress& progress) const {
  const std::vector<NearestPoint> nearest = nearestTriangles(surface_, positions, triangles, progress);
  Missed missed;
  if (progress.stopped()) return missed;
  for (const NearestPoint& n : nearest) {
    const double d = std::sqrt(n.squared);
    missed.max = std::max(missed.max, d);
    if (d > limit) missed.triangles.push_back(n.triangle);
  }
  std::ranges::sort(missed.triangles);
  missed.triangles.erase(std::unique(missed.triangles.begin(), missed.triangles.end()),
                         missed.triangles.end());
  return missed;
}

}  // namespace sdf
