#include "sdf/triangles/incidence.h"

#include <algorithm>
#include <numeric>

#include "sdf/base/disjoint_sets.h"
#include "sdf/base/flat_map.h"

namespace sdf {

Incidence::Incidence(const std::vector<glm::uvec3>& triangles, std::size_t vertices)
    : first_(vertices + 1), list_(3 * triangles.size()) {
  for (const glm::uvec3& t : triangles)
    for (int k = 0; k < 3; ++k) ++first_[t[k] + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  // Filling moves each start to its end; shifting back restores them.
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) list_[first_[triangles[t][k]]++] = t;
  std::rotate(first_.begin(), first_.end() - 1, first_.end());
  first_[0] = 0;
}

std::vector<std::uint32_t> piecesOf(const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
  DisjointSets pieces(vertices);
  for (const glm::uvec3& t : triangles) pieces.join(t.x, t.y), pieces.join(t.y, t.z);
  std::vector<std::uint32_t> of(vertices);
  for (std::uint32_t v = 0; v < vertices; ++v) of[v] = pieces.of(v);
  return of;
}

std::optional<std::uint32_t> openVertex(const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
  const Incidence incidence(triangles, vertices);
  std::vector<std::pair<std::uint32_t, int>>
      ways;  // neighbours, and how often more an edge goes there than comes
  for (std::uint32_t v = 0; v < vertices; ++v) {
    ways.clear();
    const auto count = [&](std::uint32_t neighbour, int way) {
      const auto found = std::ranges::find(ways, neighbour, &std::pair<std::uint32_t, int>::first);
      if (found == ways.end())
        ways.emplace_back(neighbour, way);
      else
        found->second += way;
    };
    for (const std::uint32_t t : incidence.of(v)) {
      const glm::uvec3& c = triangles[t];
      const int k = c.x == v ? 0 : c.y == v ? 1 : 2;
      count(c[(k + 1) % 3], 1);
      count(c[(k + 2) % 3], -1);
    }
    if (std::ranges::any_of(ways, [](const auto& way) { return way.second != 0; })) return v;
  }
  return std::nullopt;
}

MostOnEdge mostOnEdge(const std::vector<glm::uvec3>& triangles) {
  FlatMap<std::uint32_t> counts;
  MostOnEdge most;
  for (const glm::uvec3& t : triangles)
    for (int k = 0; k < 3; ++k)
      if (const std::uint32_t count = ++counts.insert(edgeKey(t[k], t[(k + 1) % 3]), 0).first;
          count > most.triangles)
        most = {count, t[k]};
  return most;
}

}  // namespace sdf
