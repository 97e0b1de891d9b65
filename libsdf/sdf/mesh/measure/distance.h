// How far a mesh is from the surface, as it is measured.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/measure/find_surface.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Root mean square (weighted by area) and maximum of the distance to the zero set, read at every
/// vertex and at four points inside each triangle (its centroid, and midway from there to each corner). The
/// mean square over a triangle is that of the quadratic function through these seven readings. One-sided:
/// from the mesh to the surface (distanceToMesh is the other side). Each is what findSurface says. Triangles
/// with more than a tenth of a voxel, under which the surface has an edge, are looked at in 36 points for the
/// maximum. A mesh whose maximum is beyond kFarthestVoxels is not the shape's. Fills stats.rmsDistance,
/// stats.maxDistance and stats.farthest; returns the vertices' distances.
std::vector<float> measureDistance(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles, const LocalField& field,
                                   Progress& progress, MeshStats& stats);

/// The same where each vertex has its place on the surface, and triangles between places are the surface: how
/// far the vertices are from them. No other point is farther, either way. Fills stats.surfacePoints, too.
/// Precondition: at least one. Cost: linear.
void measureRounding(const std::vector<glm::vec3>& positions, const std::vector<glm::dvec3>& places,
                     MeshStats& stats);

}  // namespace sdf
