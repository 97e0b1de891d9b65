// Making the surface of a solid from triangles as they come from files.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/triangles/triangle_mesh.h"

namespace sdf {

/// Triangles without a border: for each that goes along an edge one way another one goes the other way. What
/// they wind around, a number of times that is not 0, is their solid.
struct ClosedTriangles {
  std::vector<glm::vec3> points;  ///< distinct
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> source;  ///< by triangle, which one of the mesh it was; those beyond close holes
  std::size_t holes = 0;              ///< loops of borders that were closed
  std::size_t turned = 0;             ///< triangles that were turned over to agree with their neighbours
  std::size_t repeated = 0;           ///< triangles left out because one with the same corners is there
  std::size_t films = 0;              ///< triangles left out because nothing lies behind them
  bool manifold = false;              ///< every edge has two triangles, and every point one fan of them
};

/// Joins vertices at one place, and those of borders that are within 1e-5 of the mesh's size of one another;
/// drops triangles without an area; leaves one of those that have the same corners, or none where as many are
/// turned one way as the other; turns patches over whose neighbours run the other way; and closes each loop
/// of what borders remain as cutPolygon does. What is closed by a triangle of the same corners is a film, and
/// left out. Cost: n log n.
ClosedTriangles closed(const TriangleMesh& mesh);

}  // namespace sdf
