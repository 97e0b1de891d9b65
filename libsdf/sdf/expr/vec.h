// Three expressions that belong together: positions, directions and colours written as formulas.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

#include "sdf/expr/expr.h"

namespace sdf {

struct Vec3E {
  Expr x, y, z;

  Vec3E() = default;
  Vec3E(Expr all) : x(all), y(all), z(std::move(all)) {}  // NOLINT
  Vec3E(Expr x_, Expr y_, Expr z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
  Vec3E(const glm::dvec3& v) : x(v.x), y(v.y), z(v.z) {}  // NOLINT
  bool operator==(const Vec3E&) const = default;
};

/// (x, y, z), the point at which a distance or an attribute is asked for.
inline Vec3E position() {
  return {Expr::variable(Variable::X), Expr::variable(Variable::Y), Expr::variable(Variable::Z)};
}
/// The unit normal, for attributes.
inline Vec3E normal() {
  return {Expr::variable(Variable::NX), Expr::variable(Variable::NY), Expr::variable(Variable::NZ)};
}

inline Vec3E operator+(const Vec3E& a, const Vec3E& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3E operator-(const Vec3E& a, const Vec3E& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3E operator*(const Vec3E& a, const Expr& s) { return {a.x * s, a.y * s, a.z * s}; }
inline Expr dot(const Vec3E& a, const Vec3E& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3E abs(const Vec3E& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
inline Vec3E max(const Vec3E& a, const Expr& b) { return {max(a.x, b), max(a.y, b), max(a.z, b)}; }
inline Vec3E mix(const Vec3E& a, const Vec3E& b, const Expr& t) {
  return {mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}

/// Euclidean lengths. The gradient at 0 is defined as 0. Lipschitz facts follow from the arguments' own
/// (|length(u) - length(v)| <= |u - v|), so a length of coordinates that form a basis should be claimed
/// tighter.
inline Expr length(const Expr& a, const Expr& b) {
  return sqrt(square(a) + square(b)).claimLipschitz(std::hypot(a.lipschitz(), b.lipschitz()));
}
inline Expr length(const Expr& a, const Expr& b, const Expr& c) {
  return sqrt(square(a) + square(b) + square(c))
      .claimLipschitz(std::hypot(std::hypot(a.lipschitz(), b.lipschitz()), c.lipschitz()));
}
inline Expr length(const Vec3E& a) { return length(a.x, a.y, a.z); }

}  // namespace sdf
