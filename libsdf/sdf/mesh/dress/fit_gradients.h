// Normals fitted to the gradients all over triangles.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Unit gradients at points of facets, whose unit normals are given (0: of none) and which keep the
/// `tolerance`: one that is 60 degrees or more from its facet's normal, for the point is nearer to the other
/// side of an edge, becomes that of a point two tolerances in front of or behind the facet, if one agrees.
void faceGradients(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& facets,
                   float tolerance, const LocalField& field, Progress& progress,
                   std::vector<glm::vec3>& gradients);

/// The normals that, interpolated, are nearest to the unit gradients all over the triangles, in the mean
/// square over the area; from `normals`. A large triangle beside a small rounding is then as flat or as round
/// as it should be, where the gradient at the corner that both share would run through all of it. `shared`
/// is, by vertex, the vertex whose normal it has; the mesh keeps the `tolerance`. Cost: linear; some 4 to 64
/// gradients for each triangle.
void fitToGradients(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const std::vector<std::uint32_t>& shared, float tolerance, const LocalField& field,
                    Progress& progress, std::vector<glm::vec3>& normals);

}  // namespace sdf
