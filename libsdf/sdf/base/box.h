// Axis-aligned boxes in scene units.
#pragma once
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace sdf {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Closed box [min, max]; sides may be infinite. Default: empty.
struct Box {
  glm::dvec3 min{kInfinity};
  glm::dvec3 max{-kInfinity};

  static Box everything() { return {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)}; }
  static Box centred(const glm::dvec3& half) { return {-half, half}; }

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  bool finite() const {
    return !empty() && min.x > -kInfinity && min.y > -kInfinity && min.z > -kInfinity && max.x < kInfinity &&
           max.y < kInfinity && max.z < kInfinity;
  }
  glm::dvec3 size() const { return max - min; }
  glm::dvec3 centre() const { return (min + max) * 0.5; }
  double longestSide() const { return glm::max(size().x, glm::max(size().y, size().z)); }
  bool contains(const Box& b) const {
    return b.empty() || (min.x <= b.min.x && min.y <= b.min.y && min.z <= b.min.z && max.x >= b.max.x &&
                         max.y >= b.max.y && max.z >= b.max.z);
  }
  Box grown(double by) const { return empty() ? *this : Box{min - by, max + by}; }
};

/// Smallest box around both.
inline Box unite(const Box& a, const Box& b) { return {glm::min(a.min, b.min), glm::max(a.max, b.max)}; }
/// The box that lies in both; may be empty.
inline Box intersect(const Box& a, const Box& b) { return {glm::max(a.min, b.min), glm::min(a.max, b.max)}; }

}  // namespace sdf
