// Cutting polygons into triangles.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sdf {

/// Appends the triangles of a polygon, given by the places of its corners: two less than it has corners, and
/// each edge of the outline is that of one of them. Seen along the axis that is nearest to the polygon's
/// normal they fill the polygon and do not overlap: corners are cut off where nothing else of the outline
/// lies in the triangle, those with the shortest diagonal first; of equal ones that whose point comes first.
/// So the triangles are the same wherever the corners begin, and whichever way they run, and few of many
/// corners meet in one. Four corners are cut along the shorter diagonal. Corners may touch the outline, as
/// where an edge leads to a hole and back.
///
/// False where some triangle faces the other way, for the outline crosses itself: where no corner can be cut
/// off, the rest is cut by the diagonals' lengths alone. Coordinates that are no finite numbers may give any
/// triangles. Cost: n log n; up to n^1.5 where needles lie beside one another.
bool cutPolygon(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> corners,
                std::vector<glm::uvec3>& triangles);

}  // namespace sdf
