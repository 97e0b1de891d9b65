// From points of a surface to those near them that are the farthest from a mesh.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/triangles/tree.h"

namespace sdf {

/// A point of the surface, and how far it is from a mesh.
struct FarPoint {
  glm::vec3 at{0.0f};
  double distance = 0.0;
};

/// Moves points along the surface of a shape as large as that, as long as they get farther from the mesh:
/// what is strewn over a surface misses the tips and edges that a mesh cuts off. Those that cannot become the
/// farthest of them are left on their way. Films that are thinner than positions are exact are no surface.
void climb(std::vector<FarPoint>& points, const LocalField& field, double size, const TriangleTree& mesh,
           Progress& progress);

}  // namespace sdf
