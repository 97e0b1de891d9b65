#include "sdf/mesh/measure/solid.h"

#include <glm/geometric.hpp>

namespace sdf {

// A tetrahedron from a vertex of the mesh stands on each triangle: far from the origin less is lost so.
void measureSolid(const Mesh& mesh, MeshStats& stats) {
  if (mesh.triangles.empty()) return;
  const glm::dvec3 tip(mesh.positions[mesh.triangles[0].x]);
  double area = 0.0, volume = 0.0;
  glm::dvec3 moment(0.0);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - tip, b = glm::dvec3(mesh.positions[t.y]) - tip,
                     c = glm::dvec3(mesh.positions[t.z]) - tip;
    const double one = glm::dot(a, glm::cross(b, c)) / 6.0;
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    volume += one;
    moment += one * (a + b + c) / 4.0;
  }
  stats.area = area;
  if (!stats.watertight) return;
  stats.volume = volume;
  stats.centreOfMass = volume > 0.0 ? tip + moment / volume : tip;
}

}  // namespace sdf
