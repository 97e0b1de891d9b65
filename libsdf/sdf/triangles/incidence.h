// The triangles around the vertices of a mesh, and its edges.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sdf {

/// One number for the edge between two vertices, whichever comes first.
inline std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// For each vertex the triangles that have it as a corner, by their numbers, ascending. Cost: linear.
class Incidence {
 public:
  Incidence(const std::vector<glm::uvec3>& triangles, std::size_t vertices);
  std::span<const std::uint32_t> of(std::size_t v) const {
    return {list_.data() + first_[v], list_.data() + first_[v + 1]};
  }

 private:
  std::vector<std::uint32_t> first_, list_;
};

/// By vertex, the least vertex that triangles connect it with; one that no triangle has is alone. Cost: about
/// linear.
std::vector<std::uint32_t> piecesOf(const std::vector<glm::uvec3>& triangles, std::size_t vertices);

/// A vertex on an edge that has more triangles one way than the other; none where the triangles are closed.
/// Cost: linear, times the triangles around a vertex.
std::optional<std::uint32_t> openVertex(const std::vector<glm::uvec3>& triangles, std::size_t vertices);

/// How many triangles an edge has at most, and one of its vertices. Cost: linear.
struct MostOnEdge {
  std::uint32_t triangles = 0, vertex = 0;
};
MostOnEdge mostOnEdge(const std::vector<glm::uvec3>& triangles);

}  // namespace sdf
