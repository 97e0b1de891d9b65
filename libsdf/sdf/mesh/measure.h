// What a mesh is worth: its distance to the surface, and its topology.
#pragma once
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface_points.h"

namespace sdf {

/// Root mean square (weighted by area) and maximum of the first-order distance to the zero set, over every
/// vertex and over four points inside each triangle (its centroid, and midway from there to each corner).
/// One-sided: from the mesh to the surface. Where the first-order figure exceeds half a voxel, the surface is
/// looked for along the gradient instead. Triangles with more than a tenth of a voxel, under
/// which the surface has an edge, are looked at in 36 points for the maximum.
void measureDistance(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                     const LocalField& field, Progress& progress, MeshStats& stats);

/// Watertight, manifold, components (by shared vertices) and Euler characteristic of an indexed mesh. Cost: n
/// log n.
void measureTopology(const std::vector<glm::uvec3>& triangles, std::size_t vertices, MeshStats& stats);

}  // namespace sdf
