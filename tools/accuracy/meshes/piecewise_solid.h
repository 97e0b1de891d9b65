// Solids by the smooth pieces of their surfaces, written by hand: true distances, edges and corners included.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "accuracy/check_points.h"

namespace sdf::accuracy {

/// The intersection of regions, or their union. Each region is where a smooth function is below 0.
struct PiecewiseSolid {
  using Piece = std::function<double(const glm::dvec3&)>;

  std::vector<Piece> pieces{};
  bool united = false;
  double slope = 1.0;   ///< no piece is steeper
  double radius = 0.0;  ///< of a ball around the origin that contains the solid, scene units

  /// Below 0 inside, 0 on the surface; as steep as the pieces.
  double value(const glm::dvec3& p) const;

  /// Distance from p to the solid's surface, not signed: to the nearest of the feet of p on a piece, on the
  /// curve where two meet and at the corners of three that lie on the surface. The feet come from Newton's
  /// method and are good to 1e-9 where p is closer to the surface than the pieces' radii of curvature.
  double distance(const glm::dvec3& p) const;

  /// Points of the surface, uniform over its area: where lines that are uniform in space pass it (Crofton's
  /// formula; Santalo 1976). Walls and gaps that a line meets for less than 1e-3 may be missed. In parallel;
  /// a seed gives the same points for any number of threads.
  std::vector<glm::dvec3> surfacePoints(std::size_t count, unsigned seed) const;

 private:
  void addLine(PointMaker::Random& random, std::vector<glm::dvec3>& points) const;
};

}  // namespace sdf::accuracy
