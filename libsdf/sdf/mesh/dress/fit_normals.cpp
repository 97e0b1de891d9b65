#include "sdf/mesh/dress/fit_normals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace sdf {
namespace {

// Share of the largest facet around a vertex below which one counts for nothing: it may be folded over, and
// its normal rounding.
constexpr double kSliver = 0.01;

const double kCosine = std::cos(kFittingAngle);

// Of a facet's longest side: one that is less high is a needle, which may point anywhere.
constexpr double kNeedle = 1e-3;

// Twice the area, along the facet's normal; 0 of a needle.
glm::dvec3 areaOf(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
  const glm::dvec3 u = glm::dvec3(positions[t.y]) - glm::dvec3(positions[t.x]),
                   v = glm::dvec3(positions[t.z]) - glm::dvec3(positions[t.x]), w = v - u;
  const glm::dvec3 area = glm::cross(u, v);
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  return glm::dot(area, area) > kNeedle * kNeedle * longest * longest ? area : glm::dvec3(0.0);
}

bool isFar(const glm::dvec3& area, const glm::vec3& normal) {
  const double along = glm::dot(area, glm::dvec3(normal));
  return along < 0.0 || along * along < kCosine * kCosine * glm::dot(area, area);
}

// The triangle's angle at its corner k.
double angleAt(const std::vector<glm::vec3>& positions, const glm::uvec3& t, int k) {
  const glm::dvec3 corner(positions[t[k]]);
  const glm::dvec3 u = glm::dvec3(positions[t[(k + 1) % 3]]) - corner,
                   v = glm::dvec3(positions[t[(k + 2) % 3]]) - corner;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

// 1 for vertices with a facet that is far from their normal: elsewhere the mean is near it, too.
std::vector<std::uint32_t> suspects(const std::vector<glm::vec3>& positions,
                                    const std::vector<glm::uvec3>& triangles,
                                    const std::vector<glm::vec3>& normals) {
  std::vector<std::uint32_t> suspect(positions.size(), 0);
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
    const glm::dvec3 area = areaOf(positions, triangles[i]);
    for (int k = 0; k < 3; ++k)
      if (const std::uint32_t v = triangles[i][k]; isFar(area, normals[v]))
        std::atomic_ref(suspect[v]).store(1, std::memory_order_relaxed);
  });
  return suspect;
}

}  // namespace

void fitNormals(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                std::vector<glm::vec3>& normals) {
  struct Fan {
    std::uint32_t vertex;
    glm::dvec3 sum{0.0};
    double largest = 0.0;
  };
  std::vector<std::uint32_t> fanOf = suspects(positions, triangles, normals);
  std::vector<Fan> fans{{}};
  for (std::uint32_t v = 0; v < fanOf.size(); ++v)
    if (fanOf[v] != 0) fanOf[v] = static_cast<std::uint32_t>(fans.size()), fans.push_back({v});
  if (fans.size() == 1) return;
  // Calls take(the suspect's fan, its place in the triangle, the triangle, area).
  const auto forEachSuspect = [&](const auto& take) {
    for (const glm::uvec3& t : triangles)
      for (int k = 0; k < 3; ++k)
        if (const std::uint32_t fan = fanOf[t[k]]; fan != 0) take(fans[fan], k, t, areaOf(positions, t));
  };
  forEachSuspect([&](Fan& fan, int, const glm::uvec3&, const glm::dvec3& area) {
    fan.largest = std::max(fan.largest, glm::length(area));
  });
  forEachSuspect([&](Fan& fan, int k, const glm::uvec3& t, const glm::dvec3& area) {
    const double size = glm::length(area);
    if (size > kSliver * fan.largest) fan.sum += area * (angleAt(positions, t, k) / size);
  });
  for (const Fan& fan : std::span(fans).subspan(1))
    if (isFar(fan.sum, normals[fan.vertex])) normals[fan.vertex] = glm::vec3(glm::normalize(fan.sum));
}

}  // namespace sdf
