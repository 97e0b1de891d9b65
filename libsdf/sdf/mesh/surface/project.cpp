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

// Looks for the surface along lines through points, in steps of a share of a voxel.
class Lines {
 public:
  Lines(const PointRun& run, const glm::vec3* outward)
      : run_(run), outward_(outward), step_(static_cast<float>(kStep * run.voxel)) {}

  // By point: where along the line, from solid to free, the surface is; 0 for points that lie on it, and
  // those without.
  std::vector<float> surfaces() {
    constexpr int kHalvings = 16;  // an eighth of a voxel to some millionths
    std::vector<float> inner(run_.count, 0.0f), found(run_.count, 0.0f);
    const std::vector<float> before = valuesAt(std::vector<float>(run_.count, -step_)),
                             behind = valuesAt(std::vector<float>(run_.count, step_));
    std::vector<int> way(run_.count, 0);  // 1: solid on both sides, so outwards; -1: free, so inwards
    for (std::size_t i = 0; i < run_.count; ++i)
      way[i] = before[i] <= 0.0f && behind[i] <= 0.0f ? 1 : before[i] > 0.0f && behind[i] > 0.0f ? -1 : 0;
    if (std::ranges::count(way, 0) == static_cast<std::ptrdiff_t>(run_.count)) return found;
    for (int k = 2; k <= kSteps; ++k) {
      std::vector<float> at(run_.count);
      for (std::size_t i = 0; i < run_.count; ++i) at[i] = static_cast<float>(way[i] * k) * step_;
      const std::vector<float> values = valuesAt(at);
      for (std::size_t i = 0; i < run_.count; ++i)
        if (way[i] != 0 && (values[i] > 0.0f) == (way[i] > 0))
          found[i] = at[i], inner[i] = static_cast<float>(way[i] * (k - 1)) * step_, way[i] = 0;
    }
    for (int k = 0; k < kHalvings; ++k) {
      std::vector<float> at(run_.count);
      for (std::size_t i = 0; i < run_.count; ++i) at[i] = 0.5f * (inner[i] + found[i]);
      const std::vector<float> values = valuesAt(at);
      for (std::size_t i = 0; i < run_.count; ++i)
        ((values[i] > 0.0f) == (found[i] > 0.0f) ? found : inner)[i] = at[i];
    }
    return found;
  }

 private:
  // Of a voxel, chosen: how far beside a point it is looked whether that lies on a film. Twelve of them are
  // one and a half, within which the surface is where two samples of it differ in sign.
  static constexpr double kStep = 1.0 / 8.0;
  static constexpr int kSteps = 12;

  std::vector<float> valuesAt(const std::vector<float>& along) {
    PointRows at = run_.points;
    for (std::size_t i = 0; i < run_.count; ++i) at.set(i, run_.points.at(i) + along[i] * outward_[i]);
    std::vector<float> values(run_.count);
    run_.batch.evaluate(*run_.tapes.distance, at.rows(), run_.count, values.data());
    return values;
  }

  const PointRun& run_;
  const glm::vec3* outward_;
  float step_;
};

}  // namespace

std::vector<glm::vec3> outwardNormals(const std::vector<glm::vec3>& points,
                                      const std::vector<glm::uvec3>& triangles) {
  std::vector<glm::vec3> normals(points.size(), glm::vec3(0.0f));
  for (const glm::uvec3& t : triangles) {
    const glm::vec3 n = glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x]);
    for (int k = 0; k < 3; ++k) normals[t[k]] += n;
  }
  for (glm::vec3& n : normals) n = glm::length(n) > 0.0f ? glm::normalize(n) : glm::vec3(0.0f);
  return normals;
}

void leaveFilms(const std::vector<glm::vec3>& outward, std::vector<glm::vec3>& positions,
                std::vector<glm::vec3>& normals, const LocalField& field, Progress& progress) {
  forEachRun(
      positions.size(), [&](std::size_t i) { return positions[i]; }, field, progress,
      [&](const PointRun& run) {
        const std::vector<float> found = Lines(run, &outward[run.first]).surfaces();
        PointRows at = run.points;
        bool moved = false;
        for (std::size_t i = 0; i < run.count; ++i)
          if (found[i] != 0.0f) moved = true, at.set(i, at.at(i) + found[i] * outward[run.first + i]);
        if (!moved) return;
        RunGradients g;
        g.evaluate(run, at);
        for (std::size_t i = 0; i < run.count; ++i)
          if (found[i] != 0.0f)
            positions[run.first + i] = at.at(i), normals[run.first + i] = g.normal(i, outward[run.first + i]);
      });
}

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
