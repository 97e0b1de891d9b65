// Polygons to try, and what is known of them by other ways.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace sdf::test {

/// By the number of sides that a ray to the right crosses.
inline bool inPolygon(const std::vector<glm::dvec2>& corners, const glm::dvec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

/// To the nearest point, by projection onto each side.
inline double outlineDistance(const std::vector<glm::dvec2>& corners, const glm::dvec2& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 a = corners[i], e = corners[(i + 1) % corners.size()] - a;
    const double t = std::clamp(glm::dot(p - a, e) / glm::dot(e, e), 0.0, 1.0);
    best = std::min(best, glm::distance(p, a + e * t));
  }
  return best;
}

/// A star whose tips are at 1, with as many concave corners between them.
inline std::vector<glm::dvec2> starCorners(int tips, double inner) {
  std::vector<glm::dvec2> corners;
  for (int i = 0; i < 2 * tips; ++i) {
    const double angle = std::numbers::pi * i / tips, radius = i % 2 == 0 ? 1.0 : inner;
    corners.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

}  // namespace sdf::test
