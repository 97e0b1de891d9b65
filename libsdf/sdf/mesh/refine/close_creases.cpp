#include "sdf/mesh/refine/close_creases.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "sdf/mesh/edit/half_edges.h"

namespace sdf {

void closeCreases(FeatureMesh& mesh) {
  constexpr float kSharp = 0.7071f, kSliver = 0.05f;
  const HalfEdgeMesh topology(mesh);
  std::vector<glm::vec3> normals;  // 0 for slivers
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const glm::vec3 area = glm::cross(b - a, c - a);
    const float size = glm::length(area),
                longest = std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    normals.push_back(size > kSliver * longest ? area / size : glm::vec3(0.0f));
  }
  std::vector<std::array<std::uint32_t, 2>> sharp;
  for (std::uint32_t h = 0; h < topology.halfEdges(); ++h) {
    if (topology.from(h) > topology.to(h) || topology.isCrease(h)) continue;
    const glm::vec3 &a = normals[h / 3], &b = normals[topology.twin(h) / 3];
    if (a == glm::vec3(0.0f) || b == glm::vec3(0.0f) || glm::dot(a, b) > kSharp) continue;
    sharp.push_back({topology.from(h), topology.to(h)});
  }
  std::vector<std::uint32_t> ends(mesh.positions.size(), 0);
  for (const auto* edges : {&mesh.creases, &sharp})
    for (const auto& edge : *edges)
      for (const std::uint32_t v : edge) ++ends[v];
  const auto isLoose = [&](const std::array<std::uint32_t, 2>& edge) {
    if (ends[edge[0]] > 1 && ends[edge[1]] > 1) return false;
    --ends[edge[0]], --ends[edge[1]];
    return true;
  };
  while (std::erase_if(sharp, isLoose) > 0) {
  }
  // What joins no crease is a bend: around the tip of a cone, and on small roundings.
  std::vector<char> joined(mesh.positions.size(), 0);
  for (const auto& [a, b] : mesh.creases) joined[a] = joined[b] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : sharp)
      if (joined[a] != joined[b]) joined[a] = joined[b] = 1, grows = true;
  }
  std::erase_if(sharp, [&](const auto& edge) { return !joined[edge[0]]; });
  mesh.creases.insert(mesh.creases.end(), sharp.begin(), sharp.end());
  std::sort(mesh.creases.begin(), mesh.creases.end());
}

}  // namespace sdf
