// How far a mesh is from the surface, as it is measured.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Voxels from any point of a mesh to a sample of the lattice on the surface's other side, at most, where the
/// samples are the shape's. A triangle lies in the cells around a lattice edge that the surface crosses:
/// sqrt(3) to the edge's farther end. Refinement moves it by one.
inline constexpr double kFarthestVoxels = 3.0;

/// Root mean square (weighted by area) and maximum of the first-order distance to the zero set, read at every
/// vertex and at four points inside each triangle (its centroid, and midway from there to each corner). The
/// mean square over a triangle is that of the quadratic function through these seven readings. One-sided:
/// from the mesh to the surface (distanceToMesh is the other side). The first-order figure is taken where the
/// sign changes along the gradient within a tenth of it. Elsewhere, and where it exceeds half a voxel, the
/// surface is looked for where the field's branches meet by first order (edges, corners), along the gradient,
/// and at the samples of the lattice up to kFarthestVoxels away: what is found is an upper bound. Triangles
/// with more than a tenth of a voxel, under which the surface has an edge, are looked at in 36 points for the
/// maximum. A mesh whose maximum is beyond kFarthestVoxels is not the shape's. Fills stats.rmsDistance,
/// stats.maxDistance and stats.farthest; returns the vertices' distances.
std::vector<float> measureDistance(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                   Progress& progress, MeshStats& stats);

}  // namespace sdf
