// Whether two triangles of a mesh meet where they should not.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// Do the corners of a triangle of a mesh lie on one line?
bool hasNoArea(const std::vector<glm::vec3>& positions, const glm::uvec3& t);

/// Have two triangles of a mesh, both with an area, a point in common that is on no corner and no edge which
/// they share? Signs of volumes and areas are exact (a filter in double, then the products of coordinates,
/// summed without rounding; Shewchuk 1997), so the answer is, too.
bool cross(const std::vector<glm::vec3>& positions, const glm::uvec3& s, const glm::uvec3& t);

}  // namespace sdf
