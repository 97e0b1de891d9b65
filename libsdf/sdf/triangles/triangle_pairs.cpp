#include "sdf/triangles/triangle_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/triangles/exact_sum.h"
#include "sdf/triangles/orientation.h"

namespace sdf {
namespace {

using Corners = std::array<glm::vec3, 3>;
using Wide = std::array<glm::dvec3, 3>;

int signOf(double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; }

void addVolume(ExactSum& sum, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double sign) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.addProduct(a[i] * b[j], sign * c[k]);
    sum.addProduct(a[i] * b[k], -sign * c[j]);
  }
}

/// On which side of the plane through a, b and c is d? 1 where they run counter-clockwise, seen from there.
int side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  constexpr double kFilter = 1e-15;  // of the terms' sizes; (7 + 56 e) e after Shewchuk, e = 2^-53
  const glm::dvec3 u = glm::dvec3(b) - glm::dvec3(a), v = glm::dvec3(c) - glm::dvec3(a),
                   w = glm::dvec3(d) - glm::dvec3(a);
  const double volume = glm::dot(glm::cross(u, v), w);
  const glm::dvec3 x = glm::abs(u), y = glm::abs(v), z = glm::abs(w);
  const double size =
      (x.y * y.z + x.z * y.y) * z.x + (x.z * y.x + x.x * y.z) * z.y + (x.x * y.y + x.y * y.x) * z.z;
  if (std::abs(volume) > kFilter * size) return signOf(volume);
  if (size == 0.0) return 0;  // in a plane across an axis: products of three floats do not vanish
  ExactSum sum;
  addVolume(sum, glm::dvec3(b), glm::dvec3(c), glm::dvec3(d), 1.0);
  addVolume(sum, glm::dvec3(a), glm::dvec3(c), glm::dvec3(d), -1.0);
  addVolume(sum, glm::dvec3(a), glm::dvec3(b), glm::dvec3(d), 1.0);
  addVolume(sum, glm::dvec3(a), glm::dvec3(b), glm::dvec3(c), -1.0);
  return sum.sign();
}

/// Seen along an axis, does a, b, c turn to the left?
int turn(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  return orientation({a[i], a[j]}, {b[i], b[j]}, {c[i], c[j]});
}

/// An axis along which the triangle has an area; none (3) where it has no area at all.
int facedAxis(const Corners& t) {
  const glm::vec3 normal = glm::abs(glm::cross(t[1] - t[0], t[2] - t[0]));
  int best = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (normal[axis] > normal[best]) best = axis;
  for (const int axis : {best, (best + 1) % 3, (best + 2) % 3})
    if (turn(t[0], t[1], t[2], axis) != 0) return axis;
  return 3;
}

// The next functions are of what lies in one plane that is seen along an axis.

bool isInside(const glm::vec3& p, const Corners& t, int axis) {
  int least = 1, most = -1;
  for (int k = 0; k < 3; ++k) {
    const int s = turn(t[k], t[(k + 1) % 3], p, axis);
    least = std::min(least, s), most = std::max(most, s);
  }
  return least >= 0 || most <= 0;
}

bool isBetween(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b) {
  for (int k = 0; k < 3; ++k)
    if (p[k] < std::min(a[k], b[k]) || p[k] > std::max(a[k], b[k])) return false;
  return true;
}

bool segmentsMeet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, int axis) {
  const int abc = turn(a, b, c, axis), abd = turn(a, b, d, axis), cda = turn(c, d, a, axis),
            cdb = turn(c, d, b, axis);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && isBetween(c, a, b)) || (abd == 0 && isBetween(d, a, b)) ||
         (cda == 0 && isBetween(a, c, d)) || (cdb == 0 && isBetween(b, c, d));
}

bool meetsInPlane(const glm::vec3& p, const glm::vec3& q, const Corners& t) {
  const int axis = facedAxis(t);
  if (isInside(p, t, axis) || isInside(q, t, axis)) return true;
  for (int k = 0; k < 3; ++k)
    if (segmentsMeet(p, q, t[k], t[(k + 1) % 3], axis)) return true;
  return false;
}

/// Does a segment meet a triangle?
bool meets(const glm::vec3& p, const glm::vec3& q, const Corners& t) {
  const int atP = side(t[0], t[1], t[2], p), atQ = side(t[0], t[1], t[2], q);
  if (atP * atQ > 0) return false;
  if (atP == 0 && atQ == 0) return meetsInPlane(p, q, t);
  int least = 1, most = -1;
  for (int k = 0; k < 3; ++k) {
    const int s = side(p, q, t[k], t[(k + 1) % 3]);
    least = std::min(least, s), most = std::max(most, s);
  }
  return least >= 0 || most <= 0;
}

// Of the coordinates, what is certainly more than the rounding of the products below.
constexpr double kSure = 1e-13;

double size(const glm::dvec3& p) { return std::abs(p.x) + std::abs(p.y) + std::abs(p.z); }

/// Are all corners of t, from an origin, certainly beyond all of s along a direction? That means at most the
/// origin, where both have it.
bool isBeyond(const Wide& s, const Wide& t, const glm::dvec3& along, double margin) {
  const double most = std::max({glm::dot(s[0], along), glm::dot(s[1], along), glm::dot(s[2], along)});
  const double least = std::min({glm::dot(t[0], along), glm::dot(t[1], along), glm::dot(t[2], along)});
  return least - most > margin * size(along);
}

/// Looks for a direction that holds two triangles apart: the usual case, at little cost.
bool areApart(const Wide& s, const Wide& t) {
  double extent = 0.0;
  for (int k = 0; k < 3; ++k) extent = std::max({extent, size(s[k]), size(t[k])});
  const double margin = kSure * extent;
  if (isBeyond(s, t, (t[0] + t[1] + t[2]) - (s[0] + s[1] + s[2]), margin)) return true;
  const glm::dvec3 u = glm::cross(s[1] - s[0], s[2] - s[0]), v = glm::cross(t[1] - t[0], t[2] - t[0]);
  for (const glm::dvec3& way : {u, -u, v, -v})
    if (isBeyond(s, t, way, margin)) return true;
  for (int k = 0; k < 3; ++k)
    if (isBeyond(s, t, glm::cross(s[(k + 1) % 3] - s[k], u), margin) ||
        isBeyond(s, t, -glm::cross(t[(k + 1) % 3] - t[k], v), margin))
      return true;
  return false;
}

bool crossApart(const Corners& s, const Corners& t) {
  Wide a, b;
  const glm::dvec3 origin(s[0]);
  for (int k = 0; k < 3; ++k) a[k] = glm::dvec3(s[k]) - origin, b[k] = glm::dvec3(t[k]) - origin;
  if (areApart(a, b)) return false;
  for (int k = 0; k < 3; ++k)
    if (meets(s[k], s[(k + 1) % 3], t) || meets(t[k], t[(k + 1) % 3], s)) return true;
  return false;
}

/// Are two wedges with their tips in the origin certainly on either side of a plane through it?
bool arePartedBy(const glm::dvec3& along, const std::array<glm::dvec3, 2>& s,
                 const std::array<glm::dvec3, 2>& t, double margin) {
  const double sure = margin * size(along);
  return std::min(glm::dot(t[0], along), glm::dot(t[1], along)) > sure &&
         std::max(glm::dot(s[0], along), glm::dot(s[1], along)) < -sure;
}

/// Both have their first corner in common.
bool crossAtCorner(const Corners& s, const Corners& t) {
  const glm::dvec3 origin(s[0]);
  const std::array<glm::dvec3, 2> a{glm::dvec3(s[1]) - origin, glm::dvec3(s[2]) - origin},
      b{glm::dvec3(t[1]) - origin, glm::dvec3(t[2]) - origin};
  const double margin = kSure * std::max({size(a[0]), size(a[1]), size(b[0]), size(b[1])});
  const glm::dvec3 first = a[0] + a[1], second = b[0] + b[1];
  if (arePartedBy(second * size(first) - first * size(second), a, b, margin)) return false;
  // A plane through the middle of the gap between their nearest edges.
  const glm::dvec3 normal = glm::cross(a[0], a[1]) + glm::cross(b[0], b[1]);
  for (const glm::dvec3& p : a)
    for (const glm::dvec3& q : b) {
      const glm::dvec3 across = glm::cross(normal, glm::normalize(p) + glm::normalize(q));
      if (arePartedBy(across, a, b, margin) || arePartedBy(-across, a, b, margin)) return false;
    }
  return meets(s[1], s[2], t) || meets(t[1], t[2], s);
}

/// Both have their first two corners in common: they lie on one another, or do not cross.
bool crossAtEdge(const Corners& s, const glm::vec3& other) {
  constexpr double kOpposite = -0.01;  // clearly; of the product of the sizes
  const glm::dvec3 a(s[0]), edge = glm::dvec3(s[1]) - a, u = glm::dvec3(s[2]) - a, v = glm::dvec3(other) - a;
  const glm::dvec3 x = glm::cross(edge, u), y = glm::cross(edge, v);
  if (size(x) > kSure * size(edge) * size(u) && size(y) > kSure * size(edge) * size(v) &&
      glm::dot(x, y) < kOpposite * size(x) * size(y))
    return false;
  if (side(s[0], s[1], s[2], other) != 0) return false;
  const int axis = facedAxis(s);
  return turn(s[0], s[1], s[2], axis) * turn(s[0], s[1], other, axis) > 0;
}

}  // namespace

bool hasNoArea(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
  const glm::vec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
  const glm::dvec3 u = glm::dvec3(b) - glm::dvec3(a), v = glm::dvec3(c) - glm::dvec3(a);
  return !(size(glm::cross(u, v)) > kSure * size(u) * size(v)) && facedAxis({a, b, c}) == 3;
}

bool cross(const std::vector<glm::vec3>& positions, const glm::uvec3& s, const glm::uvec3& t) {
  // Turned so that shared corners come first.
  glm::uvec3 a = s, b = t;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int k = shared; k < 3; ++k)
      if (shared <= i && a[i] == b[k]) {
        std::swap(a[i], a[shared]), std::swap(b[k], b[shared]);
        ++shared;
        break;
      }
  const Corners u{positions[a.x], positions[a.y], positions[a.z]},
      v{positions[b.x], positions[b.y], positions[b.z]};
  switch (shared) {
    case 0:
      return crossApart(u, v);
    case 1:
      return crossAtCorner(u, v);
    case 2:
      return crossAtEdge(u, v[2]);
    default:
      return true;
  }
}

}  // namespace sdf
