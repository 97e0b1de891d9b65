#include "meshes.h"

#define GLM_ENABLE_EXPERIMENTAL  // for glm/gtx/hash.hpp
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtx/hash.hpp>
#include <unordered_map>

namespace sdf::accuracy {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const glm::ivec3& t : mesh.triangles)
    sum += glm::dot(mesh.points[t.x], glm::cross(mesh.points[t.y], mesh.points[t.z]));
  return sum / 6.0;
}

// Sum of cross products: positive where the points run counter-clockwise.
double area(std::span<const glm::dvec2> polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * sum;
}

// One point, computed twice.
bool same(const glm::dvec2& p, const glm::dvec2& q) {
  constexpr double kSame = 1e-13;
  return glm::length(p - q) <= kSame * std::max(1.0, glm::length(p));
}

// Sides of a prism along z between the outlines' points, both ends left open. Their corners at z = 0 are near
// to what is tried, from where CGAL's search begins.
void addWalls(std::vector<Triangle>& triangles, std::span<const glm::dvec2> outline, double half) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    for (const double z : {-half, 0.0}) {
      triangles.push_back({glm::dvec3(a, z), glm::dvec3(b, z), glm::dvec3(b, z + half)});
      triangles.push_back({glm::dvec3(a, z), glm::dvec3(b, z + half), glm::dvec3(a, z + half)});
    }
  }
}

void addCaps(std::vector<Triangle>& triangles, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c,
             double half) {
  triangles.push_back({glm::dvec3(a, half), glm::dvec3(b, half), glm::dvec3(c, half)});
  triangles.push_back({glm::dvec3(a, -half), glm::dvec3(c, -half), glm::dvec3(b, -half)});
}

// A prism of height 2 s, s the outline's longest side, tried close to its middle: a point inside is within s
// / 2 of the sides, nearer than the ends; and for one outside the nearest point lies at the point's own
// height.
struct Heights {
  explicit Heights(std::span<const glm::dvec2> outline) {
    glm::dvec2 lo = outline[0], hi = outline[0];
    for (const glm::dvec2& p : outline) lo = glm::min(lo, p), hi = glm::max(hi, p);
    const double s = std::max(hi.x - lo.x, hi.y - lo.y);
    half = s;
    region.min.z = -0.01 * s, region.max.z = 0.01 * s;
  }
  double half;
  Box region = Box::everything();
};

// A closed outline may end where it began, to a rounding.
std::vector<glm::dvec2> withoutLastTwice(const Outline& outline) {
  std::vector<glm::dvec2> points = outline.points;
  if (same(points.front(), points.back())) points.pop_back();
  return points;
}

}  // namespace

void Outline::add(const glm::dvec2& p) {
  if (points.empty() || !same(points.back(), p)) points.push_back(p);
}

Outline& Outline::to(const glm::dvec2& p) {
  add(p);
  special.push_back(p);
  return *this;
}

Outline& Outline::arc(const glm::dvec2& centre, double radius, double from, double to, int steps) {
  special.push_back(centre);
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    glm::dvec2 p = centre + radius * glm::dvec2(std::cos(angle), std::sin(angle));
    if (std::abs(p.x) < 1e-15 * radius) p.x = 0.0;  // the cosine of a right angle
    add(p);
    if (i == 0 || i == steps) special.push_back(p);
  }
  chord = std::max(chord, radius * (1.0 - std::cos(0.5 * (to - from) / steps)));
  return *this;
}

TriangleMesh welded(std::span<const Triangle> triangles) {
  TriangleMesh mesh;
  std::unordered_map<glm::dvec3, int> index;
  for (const Triangle& t : triangles) {
    glm::ivec3 corners;
    for (int i = 0; i < 3; ++i) {
      const auto [place, added] = index.emplace(t[i], static_cast<int>(mesh.points.size()));
      if (added) mesh.points.push_back(t[i]);
      corners[i] = place->second;
    }
    if (corners.x != corners.y && corners.y != corners.z && corners.z != corners.x)
      mesh.triangles.push_back(corners);
  }
  if (volume(mesh) < 0.0)
    for (glm::ivec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

std::vector<Triangle> rowsJoined(std::span<const std::vector<glm::dvec3>> rows, bool closed) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const std::size_t n = rows[i].size();
    for (std::size_t j = 0; j + (closed ? 0 : 1) < n; ++j) {
      const std::size_t next = (j + 1) % n;
      triangles.push_back({rows[i][j], rows[i + 1][j], rows[i + 1][next]});
      triangles.push_back({rows[i][j], rows[i + 1][next], rows[i][next]});
    }
  }
  return triangles;
}

Tessellation polyhedron(std::vector<glm::dvec3> points, std::span<const std::vector<int>> faces) {
  std::vector<Triangle> triangles;
  Tessellation t;
  for (const std::vector<int>& face : faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const glm::dvec3 a = points[face[i]], b = points[face[(i + 1) % face.size()]];
      t.special.push_back(0.5 * (a + b));
      if (i + 2 < face.size())
        triangles.push_back({points[face[0]], points[face[i + 1]], points[face[i + 2]]});
    }
  t.mesh = welded(triangles);
  t.special.insert(t.special.end(), points.begin(), points.end());
  t.special.emplace_back(0.0);
  return t;
}

Tessellation cells(const std::array<std::vector<double>, 3>& cuts,
                   const std::function<bool(const glm::ivec3&)>& solid) {
  const glm::ivec3 count(cuts[0].size() - 1, cuts[1].size() - 1, cuts[2].size() - 1);
  const auto filled = [&](const glm::ivec3& c) {
    for (int i = 0; i < 3; ++i)
      if (c[i] < 0 || c[i] >= count[i]) return false;
    return solid(c);
  };
  const auto corner = [&](const glm::ivec3& c) {
    return glm::dvec3(cuts[0][c.x], cuts[1][c.y], cuts[2][c.z]);
  };
  std::vector<Triangle> triangles;
  for (int k = 0; k < count.x * count.y * count.z; ++k) {
    const glm::ivec3 cell(k % count.x, k / count.x % count.y, k / count.x / count.y);
    if (!filled(cell)) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        glm::ivec3 step(0), u(0), v(0);
        step[axis] = 1, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
        if (filled(cell + (2 * side - 1) * step)) continue;
        const glm::ivec3 base = cell + side * step;
        const glm::dvec3 a = corner(base), b = corner(base + u), c = corner(base + u + v),
                         d = corner(base + v);
        triangles.push_back(side ? Triangle{a, b, c} : Triangle{a, c, b});
        triangles.push_back(side ? Triangle{a, c, d} : Triangle{a, d, c});
      }
  }
  Tessellation t{welded(triangles)};
  t.special = t.mesh.points;
  t.special.emplace_back(0.0);
  return t;
}

// At each height the facets cut out the regular polygon that is inscribed in the circle there, since the four
// corners between two rings and two half-planes lie in one plane. So they are within r (1 - cos(pi / around))
// of the turned polyline, and that is within r (1 - cos(pi / around)) of the sphere.
// Scaled by the radii, distances grow by the largest at most.
Tessellation ellipsoidSurface(const glm::dvec3& radii, int around) {
  std::vector<std::vector<glm::dvec3>> rows(around / 2 + 1);
  for (int i = 0; i <= around / 2; ++i)
    for (int k = 0; k < around; ++k) {
      const double height = kPi * (2.0 * i / around - 0.5), angle = 2.0 * kPi * k / around;
      const double across = i == 0 || i == around / 2 ? 0.0 : std::cos(height);
      rows[i].push_back(radii *
                        glm::dvec3(across * std::sin(angle), std::sin(height), across * std::cos(angle)));
    }
  const double largest = std::max({radii.x, radii.y, radii.z});
  Tessellation t{welded(rowsJoined(rows, true)), 2.0 * largest * (1.0 - std::cos(kPi / around))};
  t.special = {glm::dvec3(0.0), {radii.x, 0, 0}, {0, radii.y, 0}, {0, 0, radii.z}};
  return t;
}

Tessellation turned(const Outline& profile, const Axis& axis) {
  Outline whole = profile;
  const std::size_t n = profile.points.size();
  const bool onAxis = profile.points.front().x == 0.0;
  for (std::size_t k = 1; onAxis && k + 1 < n; ++k)
    whole.points.emplace_back(-profile.points[n - 1 - k].x, profile.points[n - 1 - k].y);
  Tessellation t = extruded(whole);
  t.axis = axis;
  return t;
}

Tessellation extruded(const Outline& outline) {
  const Heights heights(outline.points);
  Tessellation t = prism(outline, heights.half, [](const glm::dvec3& p) { return p; });
  t.region = heights.region;
  return t;
}

Tessellation extrudedBand(const Outline& outer, const Outline& inner) {
  const Heights heights(outer.points);
  const std::vector<glm::dvec2> out = withoutLastTwice(outer), in = withoutLastTwice(inner);
  std::vector<Triangle> triangles;
  addWalls(triangles, out, heights.half);
  addWalls(triangles, std::vector<glm::dvec2>(in.rbegin(), in.rend()), heights.half);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t j = (i + 1) % out.size();
    addCaps(triangles, out[i], out[j], in[j], heights.half);
    addCaps(triangles, out[i], in[j], in[i], heights.half);
  }
  Tessellation t{welded(triangles), std::max(outer.chord, inner.chord)};
  t.region = heights.region;
  for (const Outline& o : {outer, inner})
    for (const glm::dvec2& p : o.special) t.special.emplace_back(p, 0.0);
  return t;
}

Tessellation prism(const Outline& outline, double half,
                   const std::function<glm::dvec3(const glm::dvec3&)>& turn) {
  std::vector<glm::dvec2> points = withoutLastTwice(outline);
  if (area(points) < 0.0) std::reverse(points.begin(), points.end());
  std::vector<Triangle> triangles;
  addWalls(triangles, points, half);
  for (const glm::ivec3& f : triangulated(points))
    addCaps(triangles, points[f.x], points[f.y], points[f.z], half);
  for (Triangle& t : triangles)
    for (glm::dvec3& p : t) p = turn(p);
  Tessellation t{welded(triangles), outline.chord};
  for (const glm::dvec2& p : outline.special)
    for (const double z : {-half, 0.0, half}) t.special.push_back(turn(glm::dvec3(p, z)));
  t.special.emplace_back(0.0);
  return t;
}

// Points are tried within a cube of half size kTried, hence up to sqrt(3) kTried from the origin and up to
// that plus |offset| from the plane. The mesh ends farther away than that from each of them.
Tessellation halfSpace(const glm::dvec3& normal, double offset) {
  constexpr double kTried = 100.0;
  const double end = 5.0 * kTried + 2.0 * std::abs(offset);
  const glm::dvec3 n = glm::normalize(normal);
  Tessellation t = cells({{{-end, end}, {-end, 0.0}, {-end, end}}}, [](const glm::ivec3&) { return true; });
  const glm::dvec3 other = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(glm::cross(n, other)), w = glm::cross(u, n);
  for (glm::dvec3& p : t.mesh.points) p = p.x * u + (p.y + offset) * n + p.z * w;
  t.special = {glm::dvec3(0.0), offset * n};
  t.region = Box::centred(glm::dvec3(kTried));
  return t;
}

}  // namespace sdf::accuracy
