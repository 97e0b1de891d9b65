#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "operator_meshes.h"

namespace sdf::accuracy {
namespace {

double radiusAlong(const Star& star, const glm::dvec3& way) {
  double inside = star.nearest, outside = star.farthest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (star.g(middle * way) < 0.0 ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

double slopeAlongRay(const Star& star, const glm::dvec3& p) {
  constexpr double kStep = 1e-5;  // the difference errs by kStep bending, far less than an edge does
  return (star.g(p * (1.0 + kStep)) - star.g(p * (1.0 - kStep))) / (2.0 * kStep * glm::length(p));
}

// The direction in the xy half plane x >= 0, `angle` from +y.
glm::dvec3 direction(double angle) { return {std::sin(angle), std::cos(angle), 0.0}; }

// Between two directions whose points belong to different pieces: the direction of the border.
double borderBetween(const Star& star, double from, double to) {
  const auto pieceAt = [&](double angle) {
    return star.piece(radiusAlong(star, direction(angle)) * direction(angle));
  };
  const int first = pieceAt(from);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (from + to);
    (pieceAt(middle) == first ? from : to) = middle;
  }
  return to;
}

// From -y to +y, counter-clockwise, with a point on each border between pieces.
std::vector<glm::dvec2> outlineOf(const Star& star, int steps) {
  std::vector<glm::dvec2> outline;
  const auto add = [&](double angle) {
    const glm::dvec3 p = radiusAlong(star, direction(angle)) * direction(angle);
    outline.emplace_back(p);
    return star.piece ? star.piece(p) : 0;
  };
  int before = add(kPi);
  outline.back().x = 0.0;
  for (int i = 1; i <= steps; ++i) {
    const double from = kPi * (steps - i + 1) / steps, to = kPi * (steps - i) / steps;
    const int now = add(to);
    if (now != before) {
      outline.pop_back();
      add(borderBetween(star, from, to));
      add(to);
    }
    before = now;
  }
  outline.back().x = 0.0;
  return outline;
}

}  // namespace

Tessellation sphereSurface(double radius, int times) {
  const Star star{[=](const glm::dvec3& p) { return glm::length(p) - radius; }, 0.9 * radius, 1.1 * radius,
                  1.0 / (0.9 * radius)};
  return tessellated(star, times);
}

Tessellation revolved(const std::vector<glm::dvec2>& outline, int steps) {
  Tessellation result;
  TriangleMesh& mesh = result.mesh;
  const auto ringOf = [&](const glm::dvec2& p) {
    std::vector<int> ring(steps, static_cast<int>(mesh.points.size()));
    for (int i = 0; i < (p.x > 0.0 ? steps : 1); ++i) {
      ring[i] = static_cast<int>(mesh.points.size());
      const double angle = 2.0 * kPi * i / steps;
      mesh.points.emplace_back(p.x * std::cos(angle), p.y, p.x * std::sin(angle));
    }
    result.chord = std::max(result.chord, p.x * (1.0 - std::cos(kPi / steps)));
    return ring;
  };
  std::vector<std::vector<int>> rings;
  for (const glm::dvec2& p : outline) rings.push_back(ringOf(p));
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const std::vector<int>&low = rings[k], &high = rings[(k + 1) % rings.size()];
    for (int i = 0; i < steps; ++i) {
      const int j = (i + 1) % steps;
      if (low[i] != low[j]) mesh.triangles.emplace_back(low[i], high[i], low[j]);
      if (high[i] != high[j]) mesh.triangles.emplace_back(low[j], high[i], high[j]);
    }
  }
  return result;
}

Tessellation partlyRevolved(const std::vector<glm::dvec2>& outline, const glm::dvec2& middle, double angle,
                            int steps) {
  Tessellation result;
  TriangleMesh& mesh = result.mesh;
  const int count = static_cast<int>(outline.size());
  const auto add = [&](const glm::dvec2& p, int i) {
    const double at = angle * (static_cast<double>(i) / steps - 0.5);
    mesh.points.emplace_back(p.x * std::cos(at), p.y, p.x * std::sin(at));
    result.chord = std::max(result.chord, p.x * (1.0 - std::cos(0.5 * angle / steps)));
  };
  for (int i = 0; i <= steps; ++i)
    for (const glm::dvec2& p : outline) add(p, i);
  add(middle, 0), add(middle, steps);
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    for (int i = 0; i < steps; ++i) {
      const int low = count * i, high = count * (i + 1);
      mesh.triangles.emplace_back(low + k, low + next, high + k);
      mesh.triangles.emplace_back(high + k, low + next, high + next);
    }
    const int last = count * steps, centre = count * (steps + 1);
    mesh.triangles.emplace_back(centre, next, k);
    mesh.triangles.emplace_back(centre + 1, last + k, last + next);
  }
  return result;
}

Tessellation warped(const TriangleMesh& flatFaces, int times, const PointMap& map, double bending) {
  const TriangleMesh flat = refined(flatFaces, times);
  // A triangle lies in a disc of radius edge / sqrt 3; a linear interpolation is off by at most half the
  // second derivative times the square of that.
  const double edge = longestEdge(flat);
  return {mapped(flat, map), bending * edge * edge / 6.0};
}

// Over a triangle, g is at most bending edge^2 / 6 (it is 0 at the corners), and so the surface is no farther
// along the ray than that over the least slope, which is sampled and lowered by what it can change within an
// edge.
Tessellation tessellated(const Star& star, int times) {
  Tessellation result{sphereMesh(1.0, times), 0.0};
  for (glm::dvec3& p : result.mesh.points) p *= radiusAlong(star, p);
  const double edge = longestEdge(result.mesh);
  double slope = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : result.mesh.points) slope = std::min(slope, slopeAlongRay(star, p));
  result.chord = star.bending * edge * edge / 6.0 / (slope - star.bending * edge);
  return result;
}

// The same for the outline's edges, with half the second derivative times the square of half an edge.
Tessellation tessellatedAboutY(const Star& star) {
  constexpr int steps = 128;
  const std::vector<glm::dvec2> outline = outlineOf(star, 3 * steps);
  double edge = 0.0, slope = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < outline.size(); ++i) {
    edge = std::max(edge, glm::distance(outline[i], outline[i - 1]));
    slope = std::min(slope, slopeAlongRay(star, glm::dvec3(0.5 * (outline[i] + outline[i - 1]), 0.0)));
  }
  Tessellation result = revolved(outline, steps);
  result.chord += star.bending * edge * edge / 8.0 / (slope - star.bending * edge);
  return result;
}

}  // namespace sdf::accuracy
