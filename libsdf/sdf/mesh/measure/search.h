// Looking for a surface from points near it, many points at a time.
#pragma once
#include <algorithm>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {

/// Is a point with this value on the surface, or on the side where one that is inside or not is not? What is
/// no number is outside, as it is for the mesher.
inline bool isAcross(float value, bool inside) { return inside ? !(value < 0.0f) : value <= 0.0f; }

/// Of a lattice of 3 by 3 by 3 about the origin, sample i of kNeighbourhood; the middle one is the origin.
inline constexpr int kNeighbourhood = 27;
inline glm::vec3 neighbour(int i) { return glm::vec3(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1); }

/// So many unit vectors across a direction, all around it; `turned` by this share of the angle between them.
std::vector<glm::dvec3> allAround(const glm::dvec3& way, int count, double turned);

/// What lies between the two sides of a surface there at least, of a shape as large as that: some times the
/// way to the next float. The numbers of two shapes that touch are rounded each by themselves.
inline float filmAt(const glm::vec3& p, double size) {
  return 8.0f * 0x1p-23f * std::max(largestCoordinate(p), static_cast<float>(size));
}

/// A point, its side, and the line through it on which the surface is looked for.
struct Way {
  glm::dvec3 from;
  bool inside;
  glm::dvec3 direction;  ///< unit
  double reach;          ///< to either side
};

/// Where the surface was met from a point. Any point of the surface bounds the distance to it from above.
struct Met {
  double distance = kInfinity;  ///< infinite where it was not
  glm::dvec3 direction{0.0};    ///< unit
};
inline const Met& nearer(const Met& a, const Met& b) { return b.distance < a.distance ? b : a; }

/// Where the sign changes along each way, up to 2^-24 of its reach; nowhere where 16 steps to either side do
/// not tell that it does.
std::vector<Met> meetAlong(const PointRun& run, const std::vector<Way>& ways);

/// The same on the way from each point to the nearest sample of the lattice on the other side, at most
/// kFarthestVoxels away.
std::vector<Met> meetAround(const PointRun& run, const std::vector<Way>& points);

/// The same along lines through each point: to the outermost of its neighbours in a lattice of 3 by 3 by 3,
/// which are 13 lines, or of a larger one, which are 49 for a fineness of 2.
std::vector<Met> meetAllAround(const PointRun& run, const std::vector<Way>& points, int fineness);

/// The same along the gradients at the places where it was met, again and again as long as that is nearer:
/// the nearest point of a smooth surface lies along its own normal.
std::vector<Met> meetNearer(const PointRun& run, const std::vector<Way>& points, std::vector<Met> met);

/// The same in directions around those in which it was met, ever closer ones, as long as that is nearer: the
/// nearest point may be on an edge or a tip, which no normal leads to.
std::vector<Met> meetBeside(const PointRun& run, const std::vector<Way>& points, std::vector<Met> met);

}  // namespace sdf
