// Arcs of ellipses as curves.
#pragma once
#include <vector>

#include "sdf/outline/outline.h"

namespace sdf {

/// An arc from a point, as SVG's path data says it.
struct EllipseArc {
  glm::dvec2 radii{};       ///< scaled up where the ends are farther apart than they reach; 0: a line
  double turn = 0.0;        ///< of the first radius from the x axis, degrees
  bool isLarge = false;     ///< of 180 degrees or more
  bool isPositive = false;  ///< the way that leads from the x to the y axis
  glm::dvec2 to{};
};

/// Cubic curves that are within 1e-7 of the larger radius of the arc (W3C, Scalable Vector Graphics 1.1,
/// 2011, appendix F.6; Goldapp 1991). None where the ends are the same point.
std::vector<Curve> curvesOf(const glm::dvec2& from, const EllipseArc& arc);

}  // namespace sdf
