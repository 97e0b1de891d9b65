// Normals where the mesh does not show what the gradient tells of.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// How far a vertex's normal may be from the mean of the facets around it, in radians: 30 degrees. A facet
/// whose side is d long is asin(d / 2r) from the normal of a surface that bends as a ball of radius r does:
/// what bends less than a ball as large as the facets keeps its normals.
inline constexpr double kFittingAngle = 0.5235987755982988;

/// Where a normal is farther than kFittingAngle from the mean of the facets around its vertex, slivers but
/// for, weighted by their angles there (Thuermer, Wuethrich 1998), it becomes that mean: the mesh does not
/// show what the gradient tells of, an edge that it cuts off or detail below a voxel. Cost: linear.
void fitNormals(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                std::vector<glm::vec3>& normals);

}  // namespace sdf
