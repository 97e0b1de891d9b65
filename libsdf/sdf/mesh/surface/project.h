// Points on the surface itself, and the gradients there.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Newton's method along the gradient, at most three steps and no farther than a voxel from where
/// extraction put the vertex; steps below 4 ulps of a float end it, and the best position met is kept.
/// `normals` receives the unit gradient there (exact derivatives).
void refineVertices(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
                    const LocalField& field, Progress& progress);

/// Unit gradients (exact derivatives) at the points; where there is none the y axis.
void gradientNormals(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                     std::vector<glm::vec3>& normals);

}  // namespace sdf
