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

/// Moves points that lie on a film, where the distance is 0 and what is on both sides is solid, or both is
/// not, to the surface: along `outward`, a unit vector or 0 by point, or against it, up to a voxel and a
/// half, where the sign changes from solid to free. Points without such a place stay. `normals` as above.
/// Shells that touch themselves have films, and steps along gradients lead there.
void leaveFilms(const std::vector<glm::vec3>& outward, std::vector<glm::vec3>& positions,
                std::vector<glm::vec3>& normals, const LocalField& field, Progress& progress);

/// By point the mean of its triangles' normals, by their area; 0 where they cancel out.
std::vector<glm::vec3> outwardNormals(const std::vector<glm::vec3>& points,
                                      const std::vector<glm::uvec3>& triangles);

/// Unit gradients (exact derivatives) at the points; where there is none the y axis.
void gradientNormals(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                     std::vector<glm::vec3>& normals);

}  // namespace sdf
