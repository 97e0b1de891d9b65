// Cutting polygons into triangles.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sdf {

/// Appends the triangles of a polygon, given by the places of its corners: cuts off the corner with the
/// shortest diagonal, again and again; of equal ones the one whose point comes first. So the triangles are
/// the same wherever the corners begin, and whichever way they run, and few of many corners meet in one.
/// Cost: n log n.
void cutPolygon(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> corners,
                std::vector<glm::uvec3>& triangles);

}  // namespace sdf
