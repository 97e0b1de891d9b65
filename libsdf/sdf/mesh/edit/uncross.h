// Taking back what makes a mesh cross itself.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/edit/short_edges.h"

namespace sdf {

/// What was done to an extracted mesh: where its vertices were, and where in it those lie that were added.
struct Cuts {
  /// A place in a triangle: its corners and their weights. Of one on an edge two corners are one.
  struct Place {
    glm::uvec3 of;
    glm::vec3 weight;
  };

  explicit Cuts(const std::vector<glm::vec3>& places) : extracted(places) {}
  void addOnEdge(const std::array<std::uint32_t, 2>& edge, float share) {
    constexpr float kLeast = 0.1f;  // keeps triangles from having no area
    const float t = std::clamp(share, kLeast, 1.0f - kLeast);
    added.push_back({{edge[0], edge[1], edge[0]}, {1.0f - t, t, 0.0f}});
  }
  void addInside(const glm::uvec3& triangle) { added.push_back({triangle, glm::vec3(1.0f / 3.0f)}); }

  const std::vector<glm::vec3>& extracted;  ///< of the first vertices; may be empty
  std::uint32_t first = 0;                  ///< vertex that was added; of `added`
  std::uint32_t firstOfCreases = 0;         ///< those before it are on the surface, halving edges
  std::vector<Place> added;                 ///< each in a triangle of vertices before it
};

/// Takes back, where a mesh crosses itself, what was done to it since it was extracted: vertices on creases
/// go to the edges that were cut there, in quarters of the way and the farthest first, then all to where they
/// were extracted, collapses are undone, and what is taken back grows, until nothing crosses. The extracted
/// mesh does not cross itself, for its triangles keep to the cells that they are of. Creases end at what was
/// taken back, and the normals of vertices that left the surface become zero.
///
/// Looked for are crossings of triangles that a crease has drawn out far, by nearly half the edge that was
/// cut (a square edge moves at most by that), and of those that are turned by more than 60 degrees from a
/// normal at their vertices, with two rings around them: where all triangles agree with the normals the mesh
/// is one to one with the surface, which does not cross itself. Returns the vertices around triangles of the
/// second kind: if any are moved, more may cross. Cost: some nanoseconds a triangle, and as much as
/// crossingTriangles for those in question.
std::vector<std::uint32_t> uncross(FeatureMesh& mesh, std::vector<glm::vec3>& normals, const Cuts& cuts,
                                   const Collapses& collapses);

/// After vertices were moved, by little: where triangles around the `doubtful` vertices cross, they go back
/// to where they were before.
void uncrossMoved(FeatureMesh& mesh, const std::vector<std::uint32_t>& doubtful,
                  const std::vector<glm::vec3>& before);

}  // namespace sdf
