// Curved surfaces as meshes, each with a proven bound on its distance to the surface.
#pragma once
#include <functional>

#include "meshes.h"
#include "operator_meshes.h"

namespace sdf::accuracy {

/// The sphere about the origin.
Tessellation sphereSurface(double radius, int times);

/// The flat outline (x >= 0, counter-clockwise) swept around the y axis in this many steps; points at x = 0
/// become one.
Tessellation revolved(const std::vector<glm::dvec2>& outline, int steps);

/// A mesh of flat faces, refined and mapped. `bending` bounds the map's second derivative along any unit
/// direction over the mesh.
Tessellation warped(const TriangleMesh& flatFaces, int times, const PointMap& map, double bending);

/// A surface g = 0 that is seen whole from the origin.
struct Star {
  std::function<double(const glm::dvec3&)> g;  ///< grows along every ray where it is 0
  double nearest = 0.0, farthest = 0.0;        ///< the surface's radii lie between
  double bending = 0.0;  ///< bounds g's second derivative along any unit direction, within each piece
  /// Which smooth piece of g a point belongs to; absent: g is smooth.
  std::function<int(const glm::dvec3&)> piece{};
};
/// A smooth star.
Tessellation tessellated(const Star& star, int times);
/// A star that is its own image under turns about the y axis: its outline in 3 * steps, turned in `steps`.
Tessellation tessellatedAboutY(const Star& star, int steps);

}  // namespace sdf::accuracy
