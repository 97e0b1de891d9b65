#include "sdf/shape/operators/tubes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

using glm::dvec3;

// Part of a circle, from end to end. `half` of it, by its angle, lies to either side of the middle.
struct Arc {
  dvec3 middle;
  dvec3 out, along;  // unit, at the middle: away from the circle's centre, and of the arc
  double chord;      // half of it
  double half;       // radians
  double curvature() const { return std::sin(half) / chord; }
  double rise() const { return chord * std::tan(0.5 * half); }
};

dvec3 anyAcross(const dvec3& v) {
  const dvec3 axis = std::abs(v.x) < 0.6 * glm::length(v) ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(v, axis));
}

// From one point to another one, setting out along a unit tangent.
Arc arcFrom(const dvec3& from, const dvec3& tangent, const dvec3& to) {
  const dvec3 way = to - from, along = glm::normalize(way);
  const auto across = [&](const dvec3& v) { return v - glm::dot(v, along) * along; };
  const dvec3 side = across(tangent);
  const double sine = glm::length(side);
  Arc arc{0.5 * (from + to), sine > 0.0 ? glm::normalize(across(side / sine)) : anyAcross(along), along,
          0.5 * glm::length(way), std::atan2(sine, glm::dot(tangent, along))};
  arc.middle += arc.rise() * arc.out;
  return arc;
}

Box boundsOf(const Arc& arc) {
  Box box;
  const auto add = [&](double angle) {
    // Chords from the middle, so that flat arcs of large circles keep their digits.
    const double reach = arc.half > 0.0 ? arc.chord / std::sin(arc.half) : 0.0, half = std::sin(0.5 * angle);
    const dvec3 at = arc.middle + reach * (std::sin(angle) * arc.along - 2.0 * half * half * arc.out);
    box = unite(box, {at, at});
  };
  add(-arc.half), add(arc.half);
  for (int k = 0; k < 3; ++k)
    for (const double turn : {0.0, std::numbers::pi, -std::numbers::pi})
      if (const double angle = std::atan2(arc.along[k], arc.out[k]) + turn; std::abs(angle) < arc.half)
        add(angle);
  return box;
}

Shape arcTube(const Arc& arc, const Expr& radius) {
  const Vec3E p = position() - Vec3E(arc.middle);
  const Expr x = weighted(p, Vec3E(arc.out)), y = abs(weighted(p, Vec3E(arc.along))),
             z = weighted(p, Vec3E(glm::cross(arc.out, arc.along)));
  // The distance to the circle in its plane, without the difference of its radius and a length: arcs may be
  // nearly straight.
  const double k = arc.curvature();
  const Expr toCircle =
      ((2.0 * x + k * (square(x) + square(y))) / (1.0 + length(1.0 + k * x, k * y))).claimLipschitz(1.0);
  const Expr endX = x + arc.rise(), endY = y - arc.chord;
  const Expr past = endY * std::cos(arc.half) - endX * std::sin(arc.half);
  const Expr toArc = select(lessEqual(past, 0.0), norm(toCircle, z), norm(endX, endY, z)).claimLipschitz(1.0);
  return solid(toArc - radius, boundsOf(arc).grown(upper(radius)), tubeKind(radius, 1.0 / k));
}

// What leads from one point to another one: flat arcs are segments.
Shape piece(const dvec3& from, const dvec3& tangent, const dvec3& to, const Expr& radius) {
  constexpr double kFlat = 1e-9;
  const Arc arc = arcFrom(from, tangent, to);
  return arc.half < kFlat ? capsule(Vec3E(from), Vec3E(to), radius) : arcTube(arc, radius);
}

// The way of the circle through three points at the middle one, unit. It leads no more than 90 degrees off
// the ways to the others: where the circle's would, the farther point counts as nearer.
dvec3 tangentAt(const dvec3& before, const dvec3& at, const dvec3& after) {
  const double in = glm::distance(before, at), out = glm::distance(at, after);
  const dvec3 u = (at - before) / in, v = (after - at) / out;
  const double back = std::max(-glm::dot(u, v), 1e-9);
  const dvec3 sum = std::min(out, in / back) * u + std::min(in, out / back) * v;
  // A line that turns back on itself does so across.
  return glm::length(sum) > 1e-9 * std::min(in, out) ? glm::normalize(sum) : anyAcross(u);
}

// Where two arcs meet that set out along one tangent and come in along the other, equally far along each.
dvec3 joint(const dvec3& from, const dvec3& out, const dvec3& to, const dvec3& in) {
  const dvec3 v = to - from;
  const double turn = 2.0 * (1.0 - glm::dot(out, in)), along = glm::dot(v, out + in), square = glm::dot(v, v);
  // The positive root of turn d^2 + 2 along d = square, without a difference.
  const double root = std::sqrt(along * along + turn * square);
  const double reach = along > 0.0 ? square / (along + root) : (root - along) / turn;
  if (!std::isfinite(reach)) return 0.5 * (from + to);  // from end to end against the way: two half circles
  return 0.5 * (from + reach * out + to - reach * in);
}

// The tangents of the curve through the points, each that of the circle through neighbours.
std::vector<dvec3> tangentsOf(const std::vector<dvec3>& points, bool closed) {
  const std::size_t n = points.size();
  std::vector<dvec3> tangents(n);
  for (std::size_t i = 0; i < n; ++i)
    if (closed || (i > 0 && i + 1 < n))
      tangents[i] = tangentAt(points[(i + n - 1) % n], points[i], points[(i + 1) % n]);
  if (closed) return tangents;
  // The circle of the next point leads on to the end.
  const auto mirrored = [](const dvec3& tangent, const dvec3& chord) {
    const dvec3 along = glm::normalize(chord);
    return 2.0 * glm::dot(tangent, along) * along - tangent;
  };
  tangents[0] = n == 2 ? glm::normalize(points[1] - points[0]) : mirrored(tangents[1], points[1] - points[0]);
  tangents[n - 1] = n == 2 ? tangents[0] : mirrored(tangents[n - 2], points[n - 1] - points[n - 2]);
  return tangents;
}

void checkCount(Check& check, std::size_t points, bool closed) {
  const std::size_t least = closed ? 3 : 2;
  check.that(points >= least, std::string(closed ? "a closed line" : "it") + " needs " +
                                  std::to_string(least) + " points or more, got " + std::to_string(points));
}

// Calls make(i, k) for each pair of neighbours.
template <class Make>
Shape joined(std::size_t points, bool closed, const Make& make) {
  std::vector<Shape> pieces;
  for (std::size_t i = 0; i + 1 < points; ++i) make(i, i + 1, pieces);
  if (closed) make(points - 1, 0, pieces);
  return unite(pieces);
}

void checkNeighbours(Check& check, const std::vector<dvec3>& points, bool closed) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; check.ok() && i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t k = (i + 1) % n;
    check.that(points[i] != points[k],
               "points " + std::to_string(i + 1) + " and " + std::to_string(k + 1) + " are the same");
  }
}

// The hull of two balls, or the one that holds the other.
Shape coneBetween(const dvec3& from, const dvec3& to, const Expr& radiusFrom, const Expr& radiusTo) {
  const double length = glm::distance(from, to);
  const dvec3 along = (to - from) / length, side = anyAcross(along);
  const Vec3E p = position() - Vec3E(0.5 * (from + to));
  const Expr across = norm(weighted(p, Vec3E(side)), weighted(p, Vec3E(glm::cross(along, side))));
  const double most = upper(max(radiusTo, radiusFrom - kSteepestCone * length));
  return solid(roundConeDistance(across, weighted(p, Vec3E(along)), radiusFrom, radiusTo, 0.5 * length),
               unite(Box{from, from}.grown(upper(radiusFrom)), Box{to, to}.grown(most)));
}

}  // namespace

Shape tube(const std::vector<Vec3E>& points, const Expr& radius, bool closed) {
  Check c("tube");
  checkCount(c, points.size(), closed);
  for (std::size_t i = 0; i < points.size() && c.ok(); ++i)
    c.vector("point " + std::to_string(i + 1), points[i], Rule::Any);
  if (!c.positive("radius", radius).ok()) return c.failure();
  return joined(points.size(), closed, [&](std::size_t i, std::size_t k, std::vector<Shape>& pieces) {
    pieces.push_back(capsule(points[i], points[k], radius));
  });
}

Shape taperedTube(const std::vector<dvec3>& points, const std::vector<Expr>& radii, bool closed) {
  Check c("tube");
  checkCount(c, points.size(), closed);
  c.that(radii.size() == points.size(), "it needs a radius for each point, " + std::to_string(points.size()) +
                                            ", got " + std::to_string(radii.size()));
  for (std::size_t i = 0; i < radii.size() && c.ok(); ++i)
    c.positive("radius " + std::to_string(i + 1), radii[i]);
  const std::size_t n = points.size();
  checkNeighbours(c, points, closed);
  if (!c.ok()) return c.failure();
  return joined(n, closed, [&](std::size_t i, std::size_t k, std::vector<Shape>& pieces) {
    pieces.push_back(coneBetween(points[i], points[k], radii[i], radii[k]));
  });
}

Shape curvedTube(const std::vector<dvec3>& points, const Expr& radius, bool closed) {
  Check c("tube");
  checkCount(c, points.size(), closed);
  c.positive("radius", radius);
  const std::size_t n = points.size();
  checkNeighbours(c, points, closed);
  if (!c.ok()) return c.failure();
  const std::vector<dvec3> tangents = tangentsOf(points, closed);
  return joined(n, closed, [&](std::size_t i, std::size_t k, std::vector<Shape>& pieces) {
    const dvec3 middle = joint(points[i], tangents[i], points[k], tangents[k]);
    pieces.push_back(piece(points[i], tangents[i], middle, radius));
    pieces.push_back(piece(points[k], -tangents[k], middle, radius));
  });
}

Shape struts(const std::vector<Vec3E>& points, const std::vector<std::pair<std::size_t, std::size_t>>& edges,
             const Expr& radius) {
  Check c("struts");
  c.that(!edges.empty(), "it needs at least one edge");
  for (std::size_t i = 0; i < points.size() && c.ok(); ++i)
    c.vector("point " + std::to_string(i + 1), points[i], Rule::Any);
  for (std::size_t e = 0; e < edges.size() && c.ok(); ++e)
    for (const std::size_t point : {edges[e].first, edges[e].second})
      c.that(point < points.size(), "edge " + std::to_string(e + 1) + " names point " +
                                        std::to_string(point + 1) + " of " + std::to_string(points.size()));
  if (!c.positive("radius", radius).ok()) return c.failure();
  std::vector<Shape> pieces;
  for (const auto& [a, b] : edges) pieces.push_back(capsule(points[a], points[b], radius));
  return unite(pieces);
}

}  // namespace sdf
