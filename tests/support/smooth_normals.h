// Normals at vertices held against the facets around them.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "sdf/mesh/mesh.h"

namespace sdf::test {

/// A surface is smooth at a vertex where the facets around it are within this of their mean, weighted by
/// their angles there: the mean is then no farther than this from the normal, the surface being between them.
inline constexpr double kSmoothDegrees = 10.0;
/// A normal farther than this from the mean is no normal of a smooth place.
inline constexpr double kWrongDegrees = 30.0;

struct SmoothNormals {
  std::size_t smooth = 0, wrong = 0;
  std::string firstWrong;
};

inline double degreesBetween(const glm::dvec3& unit, const glm::dvec3& unitToo) {
  return 360.0 / std::numbers::pi * std::asin(std::min(1.0, 0.5 * glm::length(unit - unitToo)));
}

/// Looks at the vertices that at least `fan` facets surround, not counting those as small as `resolved`
/// squared, whose normals are rounding.
inline SmoothNormals smoothNormals(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::vec3>& normals,
                                   const std::vector<glm::uvec3>& triangles, int fan, double resolved) {
  std::vector<glm::dvec3> facets, sums(positions.size(), glm::dvec3(0.0));
  std::vector<int> around(positions.size(), 0);
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    const glm::dvec3 area = glm::cross(b - a, c - a);
    const bool counts = glm::length(area) > resolved * resolved;
    facets.push_back(counts ? glm::normalize(area) : glm::dvec3(0.0));
    const glm::dvec3 corners[] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 u = corners[(i + 1) % 3] - corners[i], v = corners[(i + 2) % 3] - corners[i];
      sums[t[i]] += std::atan2(glm::length(area), glm::dot(u, v)) * facets.back(), around[t[i]] += counts;
    }
  }
  std::vector<double> worst(positions.size(), 0.0);
  const auto mean = [&](std::size_t v) { return glm::normalize(sums[v]); };
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (int i = 0; i < 3; ++i)
      if (const std::uint32_t v = triangles[k][i]; facets[k] != glm::dvec3(0.0))
        worst[v] = std::max(worst[v], degreesBetween(facets[k], mean(v)));
  SmoothNormals result;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (around[v] < fan || sums[v] == glm::dvec3(0.0) || !(worst[v] <= kSmoothDegrees)) continue;
    ++result.smooth;
    const glm::vec3 &n = normals[v], &p = positions[v];
    if (degreesBetween(glm::dvec3(n), mean(v)) <= kWrongDegrees) continue;
    if (++result.wrong > 1) continue;
    const glm::dvec3 m = mean(v);
    const auto text = [](const auto& w) {
      return "(" + std::to_string(w.x) + ", " + std::to_string(w.y) + ", " + std::to_string(w.z) + ")";
    };
    result.firstWrong = "at " + text(p) + " the normal is " + text(n) + ", the facets' " + text(m);
  }
  return result;
}

}  // namespace sdf::test
