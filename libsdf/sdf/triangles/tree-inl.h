// The boxes of the tree over triangles.
#pragma once
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <vector>

namespace sdf {

/// Levels that no node of a tree is below.
inline constexpr int kDeepest = 128;

struct Extent {
  glm::vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
  void add(const glm::vec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
  void add(const Extent& other) { min = glm::min(min, other.min), max = glm::max(max, other.max); }
  // Of a float's extent squares are no floats.
  double halfArea() const {
    const glm::dvec3 s = glm::dvec3(max) - glm::dvec3(min);
    return s.x < 0.0 ? 0.0 : s.x * s.y + s.y * s.z + s.z * s.x;
  }
};

inline Extent extentOf(const std::vector<glm::vec3>& points, const glm::uvec3& t) {
  Extent e;
  for (int k = 0; k < 3; ++k) e.add(points[t[k]]);
  return e;
}

inline bool apart(const Extent& a, const Extent& b) {
  return glm::any(glm::lessThan(a.max, b.min)) || glm::any(glm::lessThan(b.max, a.min));
}

}  // namespace sdf
