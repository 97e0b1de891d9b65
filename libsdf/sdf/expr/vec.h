// Three expressions that belong together: positions, directions and colours written as formulas.
#pragma once
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

/// Bound of |a(p) - a(q)| / |p - q| over all p and q: the spectral norm of the partial derivatives'
/// enclosures (its midpoints' norm plus a bound of what they are off by), or the root of the sum of the
/// components' squared slopes if that is less; infinite where a component has no slope. Exact for scalings
/// along the axes, to rounding for other linear maps.
double stretchOf(const Vec3E& a);

/// Euclidean lengths. The gradient at 0 is defined as 0. No steeper than what they are the length of
/// (|length(u) - length(v)| <= |u - v|).
inline Expr length(const Vec3E& a) {
  return sqrt(square(a.x) + square(a.y) + square(a.z)).claimLipschitz(stretchOf(a));
}
inline Expr length(const Expr& a, const Expr& b) {
  return sqrt(square(a) + square(b)).claimLipschitz(stretchOf({a, b, 0.0}));
}
inline Expr length(const Expr& a, const Expr& b, const Expr& c) { return length({a, b, c}); }

}  // namespace sdf
