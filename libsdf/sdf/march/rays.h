// Rows of vectors and rays: how marching takes many at once.
#pragma once
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sdf {

/// Vectors in rows, one row a component. All three rows have one length.
struct Vectors {
  std::vector<double> x, y, z;

  std::size_t size() const { return x.size(); }
  glm::dvec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void add(const glm::dvec3& v) {
    x.push_back(v.x);
    y.push_back(v.y);
    z.push_back(v.z);
  }
  void clear() {
    x.clear();
    y.clear();
    z.clear();
  }
};

/// Has v length 1, as far as normalising in float goes (1e-6)?
inline bool isUnit(const glm::dvec3& v) { return std::abs(glm::length(v) - 1.0) <= 1e-6; }

/// Points origin + t direction for t in [tMin, tMax], in scene units. In double, so that a ray may start far
/// from what it meets: at t = 1e5 a float t moves in steps of 0.008.
struct Rays {
  Vectors origin;
  Vectors direction;  ///< each isUnit
  std::vector<double> tMin, tMax;

  std::size_t size() const { return tMin.size(); }
  glm::dvec3 at(std::size_t i, double t) const { return origin[i] + t * direction[i]; }
  void add(const glm::dvec3& from, const glm::dvec3& along, double first, double last) {
    origin.add(from);
    direction.add(along);
    tMin.push_back(first);
    tMax.push_back(last);
  }
};

}  // namespace sdf
