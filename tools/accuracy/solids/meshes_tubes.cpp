#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "meshes.h"

namespace sdf::accuracy {
namespace {

using Ring = std::vector<glm::dvec3>;

// A tube's cut through a half-plane that ends at an axis: a circle, or what lies outside the axis of one that
// crosses it; coordinates are distance from the axis and height. `pole`: height at which all of a tube's cuts
// cross the axis; 0 where they do not reach it.
std::vector<glm::dvec2> section(double centre, double radius, double pole, int steps) {
  std::vector<glm::dvec2> points;
  const double end = pole > 0.0 ? std::atan2(pole, -centre) : kPi;
  for (int k = 0; k < (pole > 0.0 ? steps + 1 : steps); ++k) {
    const double angle = end * (2.0 * k / steps - 1.0);
    points.emplace_back(centre + radius * std::cos(angle), radius * std::sin(angle));
  }
  if (pole > 0.0) points.front() = {0.0, -pole}, points.back() = {0.0, pole};
  return points;
}

// Where the tube's circle crosses the axis. Where it only touches it, both ends are kept apart by a hair, for
// a mesh cannot pinch.
double poleOf(double major, double minor) {
  if (minor < major) return 0.0;
  return std::max(std::sqrt(minor * minor - major * major), 1e-12 * major);
}

void mirror(std::vector<Triangle>& triangles, int axis) {
  const std::size_t count = triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    Triangle t = triangles[i];
    for (glm::dvec3& p : t) p[axis] = -p[axis];
    triangles.push_back({t[0], t[2], t[1]});
  }
}

// Corners on a sphere: a point of the triangle lies between the distance of its plane and the radius from the
// centre, hence within their difference of the sphere; and the triangle covers the part of the sphere that it
// faces.
double sphereChord(std::span<const Triangle> triangles, const glm::dvec3& centre, double radius) {
  double chord = 0.0;
  for (const Triangle& t : triangles) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    if (length < 1e-12 * radius * radius) continue;  // no triangle once welded
    chord = std::max(chord, radius - std::abs(glm::dot(normal, t[0] - centre)) / length);
  }
  return chord;
}

Ring turned(const std::vector<glm::dvec2>& section, double sine, double cosine) {
  Ring row;
  for (const glm::dvec2& q : section) row.emplace_back(q.x * sine, q.y, q.x * cosine);
  return row;
}

// The tube's end: cuts of the ball about its last centre by the half-planes beyond `angle`, up to where they
// leave the ball or to the plane of symmetry opposite.
std::vector<Ring> ballRows(double angle, double major, double minor, int steps, int along) {
  const double pole = poleOf(major, minor), rest = kPi - angle;
  // A half-plane turned by `by` beyond the end passes the centre at major sin(by) = minor sin(latitude).
  const bool reaches = pole > 0.0 || (angle > 0.5 * kPi && major * std::sin(rest) < minor);
  const double last = pole > 0.0 ? rest : reaches ? std::asin(major / minor * std::sin(rest)) : 0.5 * kPi;
  std::vector<Ring> rows;
  for (int k = 0; k <= along; ++k) {
    const double share = last * k / along;
    const double by = pole > 0.0 ? share : std::asin(minor / major * std::sin(share));
    const double off = major * std::sin(by);
    const double radius = k == along && !reaches ? 0.0 : std::sqrt(minor * minor - off * off);
    const bool opposite = k == along && reaches;
    rows.push_back(turned(section(major * std::cos(by), radius, pole, steps),
                          opposite ? 0.0 : std::sin(angle + by), opposite ? -1.0 : std::cos(angle + by)));
  }
  return rows;
}

}  // namespace

// The tube is all balls about the arc. By symmetry the half x >= 0 of the solid is what the balls of the
// arc's half x >= 0 cover of it, for a mirrored centre is nearer than its image; so that half is built and
// mirrored, overlaps of the two ends included. In a half-plane about the axis within the angle the ball of
// that half-plane's own centre reaches farthest, beyond it the last ball: their cuts are the rows.
//
// Chord: as for lathe(), and sphereChord for the ends. The mesh lies inside the solid and holds every ball
// that keeps this far inside the tube, which is what the check of an overlapping inside needs.
Tessellation bentTube(double angle, double major, double minor, int steps, int along) {
  const double pole = poleOf(major, minor);
  const int turns = std::max(2, static_cast<int>(std::ceil(along * angle / kPi)));
  std::vector<Ring> rows;
  for (int k = 0; k <= turns; ++k) {
    const double theta = angle * k / turns;
    const bool opposite = angle == kPi && k == turns;
    rows.push_back(
        turned(section(major, minor, pole, steps), opposite ? 0.0 : std::sin(theta), std::cos(theta)));
  }
  const bool ring = pole == 0.0;
  std::vector<Triangle> triangles = rowsJoined(rows, ring);
  Tessellation t;
  t.chord = minor * (1.0 - std::cos(kPi / steps)) + (major + minor) * (1.0 - std::cos(0.5 * angle / turns));
  if (angle < kPi) {
    const std::vector<Triangle> end = rowsJoined(ballRows(angle, major, minor, steps, along / 2), ring);
    const glm::dvec3 centre(major * std::sin(angle), 0.0, major * std::cos(angle));
    t.chord = std::max(t.chord, sphereChord(end, centre, minor));
    triangles.insert(triangles.end(), end.begin(), end.end());
    t.special = {centre, {-centre.x, 0.0, centre.z}, centre * (1.0 + minor / major)};
  }
  mirror(triangles, 0);
  t.mesh = welded(triangles);
  for (const double z : {0.0, major, major + minor, major - minor, -major})
    t.special.insert(t.special.end(), {{0, 0, z}, {0, pole, z}, {0, minor, z}});
  return t;
}

// One quarter, mirrored twice; by the same argument each quarter is what its own part of the middle line
// covers of it: straight up to halfLength, then turned about the line through (0, halfLength) along z.
Tessellation chainLink(double halfLength, double major, double minor, int steps, int along) {
  const double pole = poleOf(major, minor);
  const std::vector<glm::dvec2> circle = section(major, minor, pole, steps);
  const int turns = along / 2;
  std::vector<Ring> rows;
  const auto add = [&](double sine, double cosine, double y) {
    Ring& row = rows.emplace_back();
    for (const glm::dvec2& q : circle) row.emplace_back(q.x * cosine, y + q.x * sine, q.y);
  };
  for (int k = 0; k < turns && halfLength > 0.0; ++k) add(0.0, 1.0, halfLength * k / turns);
  for (int k = 0; k <= turns; ++k) {
    const double angle = 0.5 * kPi * k / turns;
    add(std::sin(angle), k == turns ? 0.0 : std::cos(angle), halfLength);
  }
  std::vector<Triangle> triangles = rowsJoined(rows, pole == 0.0);
  mirror(triangles, 0);
  mirror(triangles, 1);
  Tessellation t{welded(triangles)};
  t.chord = minor * (1.0 - std::cos(kPi / steps)) + (major + minor) * (1.0 - std::cos(0.25 * kPi / turns));
  for (const double y : {0.0, halfLength, halfLength + major, halfLength + major + minor})
    t.special.insert(t.special.end(),
                     {{0, y, 0}, {major, y, 0}, {0, y, minor}, {major, y, minor}, {0, y, pole}});
  return t;
}

// Each vertex is a core point plus radius times a normal, the core points of a triangle on one face, edge or
// corner of the core box, its normals within an angle a of their mean u. A point of the triangle is then
// c + radius m with m a mean of these normals, 1 >= |m| >= dot(m, u) >= cos a, while c + radius m / |m| is on
// the surface: it lies within radius (1 - cos a), and every point of the surface is met that way.
Tessellation roundedBox(const glm::dvec3& half, double radius, int steps) {
  const glm::dvec3 core = half - radius;
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i < 3; ++i) {
    for (int k = steps; k >= 0; --k)
      lines[i].push_back(k == steps ? -half[i] : -core[i] - radius * std::tan(0.25 * kPi * k / steps));
    for (int k = 0; k <= steps; ++k) lines[i].push_back(-lines[i][steps - k]);
  }
  Tessellation t;
  std::vector<Triangle> triangles;
  const auto normal = [&](const glm::dvec3& q) { return glm::normalize(q - glm::clamp(q, -core, core)); };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half[axis], half[axis]}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<Ring> rows;
      for (const double a : lines[u]) {
        Ring& row = rows.emplace_back();
        for (const double b : lines[v])
          row.emplace_back(0.0), row.back()[axis] = side, row.back()[u] = a, row.back()[v] = b;
      }
      for (Triangle& f : rowsJoined(rows, false)) {
        if (side < 0.0) std::swap(f[1], f[2]);
        const std::array<glm::dvec3, 3> normals{normal(f[0]), normal(f[1]), normal(f[2])};
        const glm::dvec3 mean = glm::normalize(normals[0] + normals[1] + normals[2]);
        for (int k = 0; k < 3; ++k) {
          t.chord = std::max(t.chord, radius * (1.0 - glm::dot(normals[k], mean)));
          f[k] = glm::clamp(f[k], -core, core) + radius * normals[k];
        }
        triangles.push_back(f);
      }
    }
  t.mesh = welded(triangles);
  for (int k = 0; k < 27; ++k) {
    const glm::dvec3 way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    t.special.push_back(way * core);
    t.special.push_back(way * half);
  }
  return t;
}

}  // namespace sdf::accuracy
