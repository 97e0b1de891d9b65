// Looking for a surface from points near it, many points at a time.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/surface/surface_points.h"

namespace sdf {

/// Is a point with this value on the surface, or on the side where one that is inside or not is not? What is
/// no number is outside, as it is for the mesher.
inline bool isAcross(float value, bool inside) { return inside ? !(value < 0.0f) : value <= 0.0f; }

/// A point, its side, and the line through it on which the surface is looked for.
struct Way {
  glm::dvec3 from;
  bool inside;
  glm::dvec3 direction;  ///< unit
  double reach;          ///< to either side
};

/// Distance along each way to where the sign changes, up to 2^-24 of its reach; infinite where 16 steps to
/// either side do not tell that it does. Any point of the surface bounds the distance to it from above.
std::vector<double> distancesAlong(const PointRun& run, const std::vector<Way>& ways);

/// The same on the way from each point to the nearest sample of the lattice on the other side, at most
/// kFarthestVoxels away.
std::vector<double> distancesAround(const PointRun& run, const std::vector<Way>& points);

}  // namespace sdf
