// Moving extracted vertices onto the true surface.
#pragma once
#include "sdf/mesh/surface_points.h"

namespace sdf {

/// Newton's method along the gradient, at most kRefineSteps steps and no farther than a voxel from where
/// extraction put the vertex; the best position met is kept. `normals` receives the unit gradient there
/// (exact derivatives).
void refineVertices(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
                    const LocalField& field, Progress& progress);

inline constexpr int kRefineSteps = 3;

}  // namespace sdf
