// Taking short edges out of a mesh that was cut along its creases.
#pragma once
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// Collapses and flips in the order in which they were made, so that they can be undone.
struct Collapses {
  static constexpr std::uint32_t kNone = ~0u;

  struct Change {
    std::uint32_t triangle;
    glm::uvec3 before;  ///< its corners
  };
  struct Step {
    std::uint32_t gone;   ///< the vertex that went; kNone of a flip
    std::uint32_t first;  ///< of its changes; they end where the next step's begin
  };
  std::vector<Step> steps;
  std::vector<Change> changes;

  void begin(std::uint32_t gone) { steps.push_back({gone, static_cast<std::uint32_t>(changes.size())}); }
  void add(std::uint32_t triangle, const glm::uvec3& before) { changes.push_back({triangle, before}); }
  std::size_t end(std::size_t step) const {
    return step + 1 < steps.size() ? steps[step + 1].first : changes.size();
  }
};

/// Collapses edges that are shorter than `shortest` and end on a crease, the shortest first, where the mesh
/// stays manifold (link condition; Dey et al. 1999), no triangle turns away from its piece, and creases keep
/// their places: a vertex on a crease only moves along it, one of the `anchors` (corners) not at all, but for
/// those that are the same point. Then any edges, where that turns triangles back that were turned over.
/// `normals` are the vertices'; each triangle has its least vertex inside its piece. What goes stays in the
/// mesh, for undoing: see dropUnused (feature_mesh.h). Cost: n log n in the number of creases, and linear in
/// that of triangles.
Collapses collapseShortEdges(FeatureMesh& mesh, const std::vector<glm::vec3>& normals,
                             const std::vector<std::uint32_t>& anchors, double shortest);

}  // namespace sdf
