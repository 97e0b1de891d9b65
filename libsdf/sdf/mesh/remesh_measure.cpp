#include "sdf/mesh/remesh_measure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/surface_points.h"

namespace sdf {
namespace {

// Points evaluated at a time, to bound the memory.
constexpr std::size_t kPoints = std::size_t{1} << 20;

// Steps along each side at least. What lies between two of them is at most 1 / (4 * 81) of a quadratic
// error's span larger.
constexpr int kLeast = 9;

// Adds the triangle's corners, and the nodes of a grid no coarser than `cell`: rows along the longest side.
void addPoints(const glm::vec3 (&corners)[3], float cell, std::vector<glm::vec3>& points) {
  points.insert(points.end(), corners, corners + 3);
  int k = 0;
  float longest = 0.0f;
  for (int i = 0; i < 3; ++i)
    if (const float l = glm::distance(corners[i], corners[(i + 1) % 3]); l > longest) longest = l, k = i;
  const glm::vec3 &a = corners[k], &b = corners[(k + 1) % 3], &c = corners[(k + 2) % 3];
  const float height = glm::length(glm::cross(b - a, c - a)) / longest;
  const int rows = std::max(kLeast, static_cast<int>(std::ceil(height / cell)));
  for (int j = 0; j < rows; ++j) {
    const float t = static_cast<float>(j) / static_cast<float>(rows);
    const int columns = std::max(kLeast - j, static_cast<int>(std::ceil(longest * (1.0f - t) / cell)));
    for (int i = 0; i <= columns; ++i) {
      const float s = static_cast<float>(i) / static_cast<float>(std::max(columns, 1));
      points.push_back(t * c + (1.0f - t) * (a + s * (b - a)));
    }
  }
}

}  // namespace

std::vector<float> distancesAt(const std::vector<glm::vec3>& points, const LocalField& field,
                               Progress& progress) {
  std::vector<float> all(points.size());
  forEachRun(
      points.size(), [&](std::size_t i) { return points[i]; }, field, progress,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i) all[run.first + i] = std::abs(g.distance(i));
      });
  return all;
}

DenseDistances measureDensely(const RemeshTopology& mesh, const LocalField& field, double tolerance,
                              Progress& progress) {
  DenseDistances result;
  double area = 0.0, squares = 0.0;
  const auto finder = field.finder();
  std::vector<glm::vec3> points;
  std::vector<std::size_t> ends;
  for (std::uint32_t h = 0, first = 0; h < mesh.halfEdges() && !progress.stopped(); h += 3) {
    if (mesh.alive(h)) {
      const glm::vec3 corners[3]{mesh.positions[mesh.from(h)], mesh.positions[mesh.from(h + 1)],
                                 mesh.positions[mesh.from(h + 2)]};
      addPoints(corners,
                static_cast<float>(finder->at((corners[0] + corners[1] + corners[2]) / 3.0f).voxel) / 3.0f,
                points);
    }
    ends.push_back(points.size());
    if (points.size() < kPoints && h + 3 < mesh.halfEdges()) continue;
    const std::vector<float> distances = distancesAt(points, field, progress);
    std::size_t k = 0;
    for (std::uint32_t t = first; t <= h; t += 3) {
      const std::size_t begin = k, end = ends[(t - first) / 3];
      double largest = 0.0, sum = 0.0;
      for (; k < end; ++k) {
        largest = distances[k] <= largest ? largest : static_cast<double>(distances[k]);
        if (k >= begin + 3) sum += static_cast<double>(distances[k]) * static_cast<double>(distances[k]);
      }
      if (end == begin) continue;
      for (std::uint32_t i = 0; i < 3; ++i)
        if (!(distances[begin + i] <= tolerance)) result.vertices.push_back(mesh.from(t + i));
      const glm::dvec3 a(mesh.positions[mesh.from(t)]), b(mesh.positions[mesh.from(t + 1)]),
          c(mesh.positions[mesh.from(t + 2)]);
      const double size = glm::length(glm::cross(b - a, c - a));
      area += size;
      squares += size * sum / static_cast<double>(end - begin - 3);
      result.largest = largest <= result.largest ? result.largest : largest;
      if (!(largest <= tolerance)) result.exceeding.push_back(t);
    }
    points.clear(), ends.clear();
    first = h + 3;
  }
  std::sort(result.vertices.begin(), result.vertices.end());
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  if (area > 0.0) result.rms = std::sqrt(squares / area);
  return result;
}

}  // namespace sdf
