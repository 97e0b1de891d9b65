// What is wrong with a mesh, found out without the mesher's own means.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/mesh.h"
#include "sdf/shape/shape.h"

namespace sdf::test {

struct MeshAudit {
  bool closed = false;    ///< every edge has as many triangles one way as the other
  bool manifold = false;  ///< every edge has two triangles, and every vertex one fan
  int components = 0;     ///< by shared vertices
  int eulerCharacteristic = 0;
  std::size_t crossings =
      0;  ///< pairs that intersect beyond what they share, and triangles without area (CGAL)
  std::size_t turned =
      0;  ///< triangles that look against the shape's gradient in their middles, slivers left out
};

/// Triangles are held to gradients where their middle is `near` the surface (first-order distance); elsewhere
/// they pass over what they do not resolve, and the gradient is that of something else. What crosses is
/// looked for only where the mesh is closed and manifold. Cost: n log n; some microseconds a triangle.
MeshAudit audit(const Mesh& mesh, const Shape& shape, double near);

}  // namespace sdf::test
