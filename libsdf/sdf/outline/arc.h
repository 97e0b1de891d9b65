// Arcs of circles, which the sides of outlines are, and segments among them.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

#include "sdf/outline/side_tree.h"

namespace sdf {

inline double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
inline double dotOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.x + a.y * b.y; }

/// A corner of an outline, and the arc from it to the next corner: `bulge` is the tangent of a quarter of the
/// angle by which the arc turns to the left, 0 for a segment (as in DXF). |bulge| < 1.
struct ArcCorner {
  glm::dvec2 at{};
  double bulge = 0.0;
  bool operator==(const ArcCorner&) const = default;
};
/// A closed chain of arcs.
using ArcContour = std::vector<ArcCorner>;

/// A segment, or an arc that turns by less than 180 degrees. The outline's inside lies to its left.
struct Arc {
  glm::dvec2 from, along;  ///< its first end; its direction there, of length 1
  glm::dvec2 to, alongTo;  ///< its last end; its direction there
  double size;             ///< its length
  double curvature;        ///< 1 / radius, positive where it turns to the left; 0: a segment

  /// Between different points.
  static Arc through(const ArcCorner& from, const glm::dvec2& to);

  /// Where a point is, seen from the arc.
  struct Place {
    double out;   ///< how far to the right of its circle, or at an end of the tangent there
    double past;  ///< how far along the tangent beyond an end: negative before `from`, 0 beside the arc

    double squared() const { return out * out + past * past; }  ///< of the distance
  };
  /// |p - c| - r, without the centre c, which may be as far as it likes: where g = k |p - from|² + 2 out is
  /// the circle's equation, k its curvature and `out` how far p is to the right of the tangent, it is g over
  /// 1 + |p - c| / r.
  Place placeOf(const glm::dvec2& p) const {
    const glm::dvec2 r = p - from;
    const double t = dotOf(r, along), out = -crossOf(along, r);
    if (curvature == 0.0) return {out, t - std::clamp(t, 0.0, size)};
    const glm::dvec2 q = p - to;
    const double u = dotOf(q, alongTo);
    if (t >= 0.0 && u <= 0.0) return {circleAt(r, out) / (1.0 + radii(t, out)), 0.0};
    if (u <= 0.0 || (t < 0.0 && dotOf(r, r) <= dotOf(q, q))) return {out, t};
    return {-crossOf(alongTo, q), u};
  }
  /// The direction away from the circle to its right, at a point that lies beside the arc.
  glm::dvec2 normalAt(const glm::dvec2& p) const {
    const glm::dvec2 r = p - from;
    const double x = 1.0 - curvature * crossOf(along, r), y = curvature * dotOf(r, along);
    const double length = std::hypot(x, y);
    if (length == 0.0) return {along.y, -along.x};  // the centre
    return (x * glm::dvec2(along.y, -along.x) + y * along) / length;
  }

  /// Places and directions by their distance from `from` along the arc.
  glm::dvec2 at(double length) const;
  glm::dvec2 directionAt(double length) const;
  glm::dvec2 middle() const;
  /// How far the arc is from its chord, at most.
  double sagitta() const;
  Rectangle box() const;
  /// The part between two points of it.
  ArcCorner part(const glm::dvec2& a, const glm::dvec2& b) const;

  /// By how much the arc adds to the winding number of p: 1 or -1 where it passes p upwards or downwards on
  /// its right, which needs an arc that only rises or only falls.
  int windingAt(const glm::dvec2& p) const;
  /// The circle's equation: 0 on it, positive to its right; r is from `from`, and `out` to the right of
  /// `along`.
  double circleAt(const glm::dvec2& r, double out) const { return curvature * dotOf(r, r) + 2.0 * out; }

 private:
  // The distance to the centre in radii.
  double radii(double t, double out) const { return std::hypot(1.0 + curvature * out, curvature * t); }
};

/// The arcs of a chain; the last corner of one that is not closed is its end. Neighbouring corners differ.
std::vector<Arc> arcsOf(const ArcContour& chain, bool isClosed);
/// The arcs of contours, one contour after the other. Neighbouring corners differ.
std::vector<Arc> arcsOf(const std::vector<ArcContour>& contours);
/// Of all arcs of these, each of which only rises or only falls, around p, which is on none of them.
int windingNumber(const std::vector<Arc>& arcs, const SideTree& tree, const glm::dvec2& p);
/// A tree over arcs.
SideTree treeOf(const std::vector<Arc>& arcs);

}  // namespace sdf
