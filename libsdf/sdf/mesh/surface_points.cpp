#include "sdf/mesh/surface_points.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

namespace sdf {
namespace {

// A gradient this much below the slope bound says nothing about the distance (a medial axis, a flat spot of a
// field).
constexpr float kVanishing = 1e-3f;

}  // namespace

void forEachRun(std::size_t count, const std::function<glm::vec3(std::size_t)>& point,
                const LocalField& field, Progress& progress,
                const std::function<void(const PointRun&)>& work) {
  tbb::enumerable_thread_specific<BatchEvaluator> evaluators;
  const std::size_t chunks = (count + kRunChunk - 1) / kRunChunk;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    if (progress.stopped()) return;
    const std::size_t end = std::min(count, (chunk + 1) * kRunChunk);
    const auto finder = field.finder();
    for (std::size_t first = chunk * kRunChunk; first < end;) {
      const LocalField::Local here = finder->at(point(first));
      const auto same = [&](const LocalField::Local& next) {
        return next.tapes.surface == here.tapes.surface && next.voxel == here.voxel;
      };
      std::size_t next = first + 1;
      while (next < end && next - first < kBatchPoints && same(finder->at(point(next)))) ++next;
      work({first, next - first, here.tapes, here.voxel, evaluators.local()});
      first = next;
    }
    progress.update(static_cast<double>(++done) / chunks);
  });
}

float RunGradients::distance(std::size_t i, float slope) const {
  const glm::vec3 g = gradient(i);
  const float length = std::hypot(g.x, g.y, g.z);
  return length > kVanishing * slope ? value[i] / length : value[i] / slope;
}

glm::vec3 RunGradients::step(std::size_t i, float slope) const {
  const glm::vec3 g = gradient(i);
  const float squared = glm::dot(g, g);
  if (!(squared > kVanishing * kVanishing * slope * slope)) return glm::vec3(0.0f);
  return g * (-value[i] / squared);
}

}  // namespace sdf
