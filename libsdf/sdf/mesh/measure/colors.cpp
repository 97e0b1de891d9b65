#include "sdf/mesh/measure/colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/mesh/surface/surface_paint.h"

namespace sdf {
namespace {

// Corners are looked at so far inside at least, as a share of the way to the centroid.
constexpr float kInto = 0.05f;
// Points read at a time, to bound the memory.
constexpr std::size_t kPaintedPoints = std::size_t{1} << 19;

using Corners = std::array<glm::vec3, 3>;

float longestSide(const Corners& corners) {
  return std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                   glm::distance(corners[2], corners[0])});
}

// The triangle's corners moved so far inside that they are away from its sides.
Corners shrunken(const Corners& corners, float away) {
  const glm::vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
  const float height =
      glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / longestSide(corners);
  const float share = std::clamp(3.0f * away / height, kInto, 1.0f);
  return {glm::mix(corners[0], middle, share), glm::mix(corners[1], middle, share),
          glm::mix(corners[2], middle, share)};
}

// Appends the corners and a grid over the triangle, no coarser than `cell`, as weights.
void addGrid(float longest, float cell, std::vector<glm::vec3>& weights) {
  for (int k = 0; k < 3; ++k) weights.emplace_back(k == 0, k == 1, k == 2);
  const int n = std::max(2, static_cast<int>(std::ceil(longest / cell)));
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n - i; ++k) {
      const auto u = static_cast<float>(i) / static_cast<float>(n),
                 v = static_cast<float>(k) / static_cast<float>(n);
      weights.emplace_back(u, v, 1.0f - u - v);
    }
}

// What corners with these weights show.
Paint mixed(const Paint* corners, const glm::vec3& weights) {
  const auto mix = [&](glm::vec3 Paint::*color) {
    return corners[0].*color * weights.x + corners[1].*color * weights.y + corners[2].*color * weights.z;
  };
  return {mix(&Paint::color), mix(&Paint::ambient)};
}

}  // namespace

bool keepsColors(const FeatureMesh& mesh, double tolerance, const LocalField& field, Progress& progress) {
  const auto finder = field.finder();
  std::vector<glm::vec3> points, weights;
  std::vector<std::size_t> firsts;  // of each triangle's points
  const auto keeps = [&] {
    const std::vector<Paint> paint = readPaintBeside(points, field, progress);
    if (progress.stopped()) return true;
    firsts.push_back(points.size());
    for (std::size_t i = 0; i + 1 < firsts.size(); ++i)
      for (std::size_t k = firsts[i] + 3; k < firsts[i + 1]; ++k)
        if (colorDifference(paint[k], mixed(&paint[firsts[i]], weights[k])) > kColorTolerance) return false;
    points.clear(), weights.clear(), firsts.clear();
    return true;
  };
  for (const glm::uvec3& t : mesh.triangles) {
    const Corners corners{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const float longest = longestSide(corners);
    const auto voxel = static_cast<float>(finder->at(corners[0]).voxel);
    if (longest <= voxel) continue;
    firsts.push_back(points.size());
    addGrid(longest, voxel / 2.0f, weights);
    const Corners inner = shrunken(corners, kBorderTolerances * static_cast<float>(tolerance));
    for (std::size_t i = points.size(); i < weights.size(); ++i)
      points.push_back(inner[0] * weights[i].x + inner[1] * weights[i].y + inner[2] * weights[i].z);
    if (points.size() >= kPaintedPoints && !keeps()) return false;
  }
  return keeps();
}

}  // namespace sdf
