// Evaluating the scene at points on a mesh, each with the tapes of its own leaf.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/eval/batch.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Of the coordinates, without their signs: what the rounding of a position goes by.
inline float largestCoordinate(const glm::vec3& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// A run of consecutive points that share their tapes, as rows for the batch readings.
struct PointRun {
  std::size_t first;  ///< index of the first point
  std::size_t count;  ///< at most kBatchPoints
  const PointRows& points;
  const LocalTapes& tapes;
  double voxel;  ///< the resolution there, scene units
  BatchEvaluator& batch;
};

/// Points that one task takes; fixed, so that runs do not depend on the number of threads.
inline constexpr std::size_t kRunChunk = 4096;

/// Calls work(run) for all points, chunks of kRunChunk in parallel and each chunk in order. `point(i)` yields
/// the i-th position; points that follow one another should lie near one another. Returns early once progress
/// is stopped.
void forEachRun(std::size_t count, const std::function<glm::vec3(std::size_t)>& point,
                const LocalField& field, Progress& progress,
                const std::function<void(const PointRun&)>& work);

/// The same for points that may lie anywhere: those of a chunk that share their tapes make a run, whose k-th
/// point is number which[k]: work(run, which).
void forEachGroupedRun(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                       const std::function<void(const PointRun&, const std::size_t* which)>& work);

/// First-order distances and gradients of one run: |f| / |grad f| is the distance to the zero set up to
/// second order (Taubin 1994).
struct RunGradients {
  float value[kBatchPoints];
  PointRows gradients;
  float slope;  ///< the field's slope bound; 1 where none is known

  void evaluate(const PointRun& run, const PointRows& at);
  glm::vec3 gradient(std::size_t i) const { return gradients.at(i); }
  /// The gradient's direction; `otherwise` where there is none: a distance that is a root has the slope 0 on
  /// the surface itself.
  glm::vec3 normal(std::size_t i, const glm::vec3& otherwise = glm::vec3(0.0f)) const;
  /// Signed; where the gradient vanishes the value itself, divided by the slope bound.
  float distance(std::size_t i) const;
  /// The step from the point to the first-order zero set, along the gradient.
  glm::vec3 step(std::size_t i) const;
};

/// Calls take(i, gradients, k) for all points, in parallel and in no order: the i-th point's are the k-th of
/// these. The points may lie anywhere.
template <class Take>
void forEachGradient(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                     const Take& take) {
  forEachGroupedRun(points, field, progress, [&](const PointRun& run, const std::size_t* which) {
    RunGradients g;
    g.evaluate(run, run.points);
    for (std::size_t k = 0; k < run.count; ++k) take(which[k], g, k);
  });
}

}  // namespace sdf
