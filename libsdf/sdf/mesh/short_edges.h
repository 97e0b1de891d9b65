// Taking short edges out of a mesh that was cut along its creases.
#pragma once
#include <vector>

#include "sdf/mesh/feature_mesh.h"

namespace sdf {

/// Collapses edges that are shorter than `shortest` and end on a crease, the shortest first, where the mesh
/// stays manifold (link condition; Dey et al. 1999), no triangle turns away from its piece, and creases keep
/// their places: a vertex on a crease only moves along it, one of the `anchors` (corners) not at all, but for
/// those that are the same point. Then any edges, where that turns triangles back that were turned over.
/// `normals` are the vertices', before and after; each triangle has its least vertex inside its piece. Cost:
/// n log n in the number of creases, and linear in that of triangles.
void collapseShortEdges(FeatureMesh& mesh, std::vector<glm::vec3>& normals,
                        const std::vector<std::uint32_t>& anchors, double shortest);

}  // namespace sdf
