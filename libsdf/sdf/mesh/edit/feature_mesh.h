// A closed triangle mesh that knows its creases: what is handed from the finding of edges to remeshing.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// What remeshing is to leave of a vertex: nothing in particular; where it is, for it is a tip (tips.h); its
/// edges, too; and of triangles between such also as far from the surface as they are.
enum class Hold : std::uint8_t { None, Tip, Kept, Left };

/// Triangles, counter-clockwise seen from outside, closed and manifold, and those of their edges along which
/// the surface has an edge or its paint a border. A vertex without creases lies on one smooth piece of the
/// surface, one with two of them on a crease, any other at a corner (or where a crease fades out).
struct FeatureMesh {
  std::vector<glm::vec3> positions;  ///< scene units
  std::vector<glm::uvec3> triangles;
  std::vector<std::array<std::uint32_t, 2>> creases;  ///< pairs of vertices, the lower first; sorted
  /// Of each triangle, the number among the shape's; where two meet there is a crease. Empty: all are of one.
  std::vector<int> materials{};
  std::vector<Hold> held{};  ///< of the first vertices; of all others none is held

  Hold heldAt(std::uint32_t v) const { return v < held.size() ? held[v] : Hold::None; }
};

/// A triangle that was taken away, and keeps its place in the list for a while, has one vertex for all
/// corners.
inline bool isGone(const glm::uvec3& triangle) { return triangle.x == triangle.y; }

/// One number for the edge between two vertices, whichever comes first.
inline std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace sdf
