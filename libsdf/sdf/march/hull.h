// A few triangles around a solid, proven to hold all of it: rays start where they enter them, and those that
// pass them by miss.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/march/field.h"

namespace sdf {

/// The border of a set of cubes. Its triangles are seen counter-clockwise from outside; where two cubes touch
/// in an edge they share it.
struct Hull {
  glm::dvec3 origin{0.0};          ///< of the corners
  std::vector<glm::vec3> corners;  ///< scene units from the origin
  std::vector<glm::uvec3> triangles;
};

/// Cubes, `cells` of them (2 to 128) along the longest side of the bounds, which must be finite and hold the
/// solid, and the border of those that their balls do not prove free of it (Hart 1996): it keeps a ten
/// thousandth of a cube's side from the solid. Empty where there is no solid. Errors (Scene): a field without
/// a slope. Cost: some readings for each cube at the surface.
Result<Hull> hullOf(const MarchField& field, const Box& bounds, int cells);

}  // namespace sdf
