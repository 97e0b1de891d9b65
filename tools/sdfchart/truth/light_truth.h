// Light on the ground under a ball or a block, by rays of their own: no distance is read.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sdf/march/rays.h"
#include "sdf/shape/shape.h"

namespace sdf::chart {

/// What stands on the ground, y = 0, or hovers over it.
struct Blocker {
  bool ball;  ///< else a block
  glm::dvec3 centre;
  glm::dvec3 half;  ///< of the block's sides; x: the ball's radius

  /// The library's shape of it, without the ground.
  Shape shape() const;
  /// Does the ray from p along unit d meet it within `reach`? By the ball's quadratic equation and the
  /// block's slabs (Kay, Kajiya 1986).
  bool meets(const glm::dvec3& p, const glm::dvec3& d, double reach) const;
};

/// Points of the ground within 2 of the origin, in a square of n by n, that the blocker does not cover.
Vectors groundPoints(const Blocker& blocker, int n);

/// Light from 0 to 1 at the points that groundPoints(…, n) gave, as two hexadecimal digits for each of the n
/// * n places of the square, row by row: 00 to fe, and ff where the blocker covers the ground.
std::string groundPicture(const Vectors& points, const std::vector<double>& light, int n);

/// Unit directions to `count` points, evenly spread (Vogel 1979), of a lamp that is a disc of this angular
/// radius (radians) around the unit direction `towards`.
std::vector<glm::dvec3> lampDirections(const glm::dvec3& towards, double radius, int count);
/// The same of the hemisphere around +y, by the cosine.
std::vector<glm::dvec3> skyDirections(int count);

/// Of each point, the share of the directions that meet nothing within `reach`.
std::vector<double> lightOf(const Blocker& blocker, const Vectors& points,
                            const std::vector<glm::dvec3>& directions, double reach);

}  // namespace sdf::chart
