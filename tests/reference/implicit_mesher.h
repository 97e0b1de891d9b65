// Another's mesher of implicit surfaces, to be compared with.
#pragma once
#include <functional>
#include <glm/vec3.hpp>

#include "reference.h"

namespace sdf::accuracy {

/// What CGAL's surface mesher (Rineau, Yvinec; after Boissonnat, Oudot 2005) is asked for.
struct ImplicitMesh {
  std::function<double(const glm::dvec3&)> value;  ///< below 0 inside; at the origin it must not be 0
  glm::dvec3 inside;                               ///< a point of the solid
  double radius;                                   ///< of a ball around it that contains the solid
  double facetDistance;                            ///< between the centres of a facet and of its surface ball
  double facetSize;                                ///< largest radius of a facet's surface ball
  std::function<bool()> stopped = [] { return false; };
};

/// The surface as triangles. Deterministic, on one thread. Sharp edges are not kept: the mesher knows none of
/// them. Throws std::runtime_error where it is stopped or nothing is found.
TriangleMesh meshByCgal(const ImplicitMesh& asked);

}  // namespace sdf::accuracy
