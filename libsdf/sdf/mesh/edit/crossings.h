// Finding where a mesh intersects itself.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

using TrianglePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Pairs of triangles that intersect, touching included, beyond the corners and edges that they share, the
/// lower number first; a triangle without area is a pair with itself. Sorted. What triangles without area
/// meet is not looked for, and those that are gone (feature_mesh.h) are passed over. Cost: n log n and some
/// 300 nanoseconds a triangle, where triangles near one another are about as large.
TrianglePairs crossingTriangles(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles);

/// Those pairs of which one triangle is asked for (not 0 in `asked`, by triangle) and both are `among` the
/// given ones. Cost: by what is among them.
TrianglePairs crossingTriangles(const std::vector<glm::vec3>& positions,
                                const std::vector<glm::uvec3>& triangles,
                                const std::vector<std::uint32_t>& among, const std::vector<char>& asked);

}  // namespace sdf
