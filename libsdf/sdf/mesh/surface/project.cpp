#include "sdf/mesh/surface/project.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

constexpr int kRefineSteps = 3;

// Of a point's coordinates: steps that are shorter are their rounding and the reading's.
constexpr float kSettled = 0x1p-21f;

void refineRun(const PointRun& run, glm::vec3* positions, glm::vec3* normals) {
  const float reach = static_cast<float>(run.voxel);
  PointRows trial = run.points;
  RunGradients g;
  float best[kBatchPoints];
  std::fill_n(best, run.count, HUGE_VALF);
  for (int step = 0; step <= kRefineSteps; ++step) {
    g.evaluate(run, trial);
    bool moved = false;
    for (std::size_t i = 0; i < run.count; ++i) {
      const float distance = std::abs(g.distance(i));
      if (distance < best[i]) {
        best[i] = distance;
        positions[i] = trial.at(i);
        normals[i] = g.normal(i, normals[i]);
      }
      const glm::vec3 way = g.step(i), target = trial.at(i) + way;
      if (!(glm::distance(target, run.points.at(i)) <= reach)) continue;
      if (glm::length(way) <= kSettled * largestCoordinate(target)) continue;
      moved = true;
      trial.set(i, target);
    }
    if (!moved) break;
  }
}

}  // namespace

void refineVertices(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& normals,
                    const LocalField& field, Progress& progress) {
  normals.assign(positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
  forEachRun(
      positions.size(), [&](std::size_t i) { return positions[i]; }, field, progress,
      [&](const PointRun& run) { refineRun(run, &positions[run.first], &normals[run.first]); });
}

void gradientNormals(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                     std::vector<glm::vec3>& normals) {
  normals.assign(points.size(), glm::vec3(0.0f, 1.0f, 0.0f));
  forEachRun(
      points.size(), [&](std::size_t i) { return points[i]; }, field, progress,
      [&](const PointRun& run) {
        RunGradients g;
        g.evaluate(run, run.points);
        for (std::size_t i = 0; i < run.count; ++i)
          normals[run.first + i] = g.normal(i, normals[run.first + i]);
      });
}

}  // namespace sdf
