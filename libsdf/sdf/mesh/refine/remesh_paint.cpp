#include "sdf/mesh/refine/remesh_paint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sdf/mesh/surface/surface_paint.h"

namespace sdf {
namespace {

// Corners are looked at so far inside at least, as a share of the way to the centroid.
constexpr float kInto = 0.05f;
// Fans that are so many tolerances off are of no use whatever their paint.
constexpr float kHopelessPaint = 1.5f;
// Points read at a time, to bound the memory.
constexpr std::size_t kPaintedPoints = std::size_t{1} << 19;

float longestSide(const std::array<glm::vec3, 3>& corners) {
  return std::max({glm::distance(corners[0], corners[1]), glm::distance(corners[1], corners[2]),
                   glm::distance(corners[2], corners[0])});
}

// The triangle's corners moved so far inside that they are away from its sides.
std::array<glm::vec3, 3> shrunken(const std::array<glm::vec3, 3>& corners, float away) {
  const glm::vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0f;
  const float height =
      glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / longestSide(corners);
  const float share = std::clamp(3.0f * away / height, kInto, 1.0f);
  return {glm::mix(corners[0], middle, share), glm::mix(corners[1], middle, share),
          glm::mix(corners[2], middle, share)};
}

// How far p is from what corners with these weights make of it.
float difference(const Paint& p, const Paint* corners, const glm::vec3& weights) {
  const auto mixed = [&](glm::vec3 Paint::*color) {
    return corners[0].*color * weights.x + corners[1].*color * weights.y + corners[2].*color * weights.z;
  };
  return colorDifference(p, {mixed(&Paint::color), mixed(&Paint::ambient)});
}

// Where a triangle of a fan is looked at: weights of its shrunken corners.
const glm::vec3 kNodes[] = {{1, 0, 0},
                            {0, 1, 0},
                            {0, 0, 1},
                            {0.5f, 0.5f, 0},
                            {0, 0.5f, 0.5f},
                            {0.5f, 0, 0.5f},
                            {1.0f / 3, 1.0f / 3, 1.0f / 3}};
constexpr std::size_t kCount = std::size(kNodes);

std::array<glm::vec3, 3> cornersOf(const Fans& fans, const Fan& fan, std::uint32_t i) {
  return {fan.centre, fans.rim[fan.first + i].end, fans.rim[fan.first + (i + 1) % fan.count].end};
}

glm::vec3 at(const std::array<glm::vec3, 3>& corners, const glm::vec3& weights) {
  return corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
}

void addTo(FanError& e, std::uint32_t triangle, float distance, float tolerance) {
  e.energy += std::pow(std::min(distance / tolerance, kLargestShare), kEnergyPower);
  if (distance > e.largest) e.largest = distance, e.worst = triangle;
}

// Appends the nodes of a grid over a triangle, no coarser than `cell`, as weights: the corners come first.
void addGrid(float longest, float cell, std::vector<glm::vec3>& weights) {
  weights.insert(weights.end(), std::begin(kNodes), std::begin(kNodes) + 3);
  const int n = std::max(2, static_cast<int>(std::ceil(longest / cell)));
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n - i; ++k) {
      const auto u = static_cast<float>(i) / static_cast<float>(n),
                 v = static_cast<float>(k) / static_cast<float>(n);
      weights.emplace_back(u, v, 1.0f - u - v);
    }
}

}  // namespace

void addPaintErrors(const Fans& fans, float tolerance, const LocalField& field, Progress& progress,
                    std::vector<FanError>& errors) {
  const auto isHopeless = [&](const FanError& e) {
    return !e.sound || e.largest > kHopelessPaint * tolerance;
  };
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < fans.all.size(); ++i) {
    if (isHopeless(errors[i])) continue;
    for (std::uint32_t k = 0; k < fans.all[i].triangles(); ++k) {
      const auto inner = shrunken(cornersOf(fans, fans.all[i], k), kBorderTolerances * tolerance);
      for (const glm::vec3& weights : kNodes) points.push_back(at(inner, weights));
    }
  }
  const std::vector<Paint> paint = readPaintBeside(points, field, progress);
  if (progress.stopped()) return;
  const auto finder = field.finder();
  const Paint* p = paint.data();
  for (std::size_t i = 0; i < fans.all.size(); ++i) {
    const Fan& fan = fans.all[i];
    if (isHopeless(errors[i])) continue;
    for (std::uint32_t k = 0; k < fan.triangles(); ++k, p += kCount) {
      const int material = fans.rim[fan.first + k].material;
      if (std::any_of(p, p + kCount, [&](const Paint& q) { return q.material != material; }))
        errors[i].sound = false;
      float largest = 0.0f;
      for (std::size_t n = 3; n < kCount; ++n) largest = std::max(largest, difference(p[n], p, kNodes[n]));
      if (largest > 0.0f && longestSide(cornersOf(fans, fan, k)) > finder->at(fan.centre).voxel)
        addTo(errors[i], k, largest / kColorTolerance * tolerance, tolerance);
    }
  }
}

ColorErrors measureColors(const HalfEdgeMesh& mesh, float tolerance, const LocalField& field,
                          std::vector<TriangleColors>& known, Progress& progress) {
  known.resize(mesh.halfEdges() / 3);
  const auto finder = field.finder();
  std::vector<glm::vec3> points, weights;
  std::vector<std::uint32_t> triangles;
  std::vector<std::size_t> ends;  // of each triangle's points
  const auto read = [&] {
    const std::vector<Paint> paint = readPaintBeside(points, field, progress);
    for (std::size_t i = 0, first = 0; i < triangles.size() && !progress.stopped(); first = ends[i++]) {
      float& largest = known[triangles[i] / 3].largest = 0.0f;
      for (std::size_t k = first + 3; k < ends[i]; ++k)
        largest = std::max(largest, difference(paint[k], &paint[first], weights[k]));
    }
    points.clear(), weights.clear(), triangles.clear(), ends.clear();
  };
  for (std::uint32_t h = 0; h < mesh.halfEdges() && !progress.stopped(); h += 3) {
    if (!mesh.alive(h) || mesh.isExemptTriangle(h)) continue;
    TriangleColors& t = known[h / 3];
    const std::array<glm::vec3, 3> corners = mesh.corners(h);
    if (t.largest >= 0.0f && t.corners == corners) continue;
    const float longest = longestSide(corners);
    const auto voxel = static_cast<float>(finder->at(corners[0]).voxel);
    t = {corners, -1.0f, longest <= voxel};
    addGrid(longest, voxel / 2.0f, weights);
    const auto inner = shrunken(corners, kBorderTolerances * tolerance);
    for (std::size_t i = points.size(); i < weights.size(); ++i) points.push_back(at(inner, weights[i]));
    triangles.push_back(h), ends.push_back(points.size());
    if (points.size() >= kPaintedPoints) read();
  }
  read();
  ColorErrors result;
  if (progress.stopped()) return result;
  for (std::uint32_t h = 0; h < mesh.halfEdges(); h += 3) {
    if (!mesh.alive(h) || mesh.isExemptTriangle(h)) continue;
    const TriangleColors& t = known[h / 3];
    result.largest = std::max(result.largest, static_cast<double>(t.largest));
    if (!t.mayExceed && t.largest > kColorTolerance) result.exceeding.push_back(h);
  }
  return result;
}

bool keepsColors(const FeatureMesh& mesh, double tolerance, const LocalField& field, Progress& progress) {
  std::vector<TriangleColors> known;
  return measureColors(HalfEdgeMesh(mesh), static_cast<float>(tolerance), field, known, progress)
      .exceeding.empty();
}

}  // namespace sdf
