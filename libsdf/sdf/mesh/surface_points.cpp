#include "sdf/mesh/surface_points.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sdf {
namespace {

// A gradient this much below the slope bound says nothing about the distance (a medial axis, a flat spot of a
// field).
constexpr float kVanishing = 1e-3f;

// Has this sum of squares neither overflown nor lost what matters?
bool isOrdinary(float squared) { return squared > 0x1p-80f && squared < 0x1p80f; }

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
    PointRows points;
    for (std::size_t first = chunk * kRunChunk; first < end;) {
      const LocalField::Local here = finder->at(point(first));
      std::size_t taken = 0;
      for (; taken < kBatchPoints && first + taken < end; ++taken) {
        const glm::vec3 p = point(first + taken);
        const LocalField::Local there = finder->at(p);
        if (there.tapes.surface != here.tapes.surface || there.voxel != here.voxel) break;
        points.set(taken, p);
      }
      work({first, taken, points, here.tapes, here.voxel, evaluators.local()});
      first += taken;
    }
    progress.update(static_cast<double>(++done) / chunks);
  });
}

// A band's leaves are 8 voxels wide.
std::vector<std::uint32_t> orderByRegion(const std::vector<glm::vec3>& points, const LocalField& field) {
  std::vector<std::uint32_t> order(points.size());
  const std::size_t chunks = (points.size() + kRunChunk - 1) / kRunChunk;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    const std::size_t first = chunk * kRunChunk, count = std::min(points.size() - first, kRunChunk);
    const float width = 8.0f * static_cast<float>(field.finder()->at(points[first]).voxel);
    std::pair<std::uint64_t, std::uint32_t> keys[kRunChunk];
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 cell = glm::floor(points[first + i] / width);
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 21 | (static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis])) & 0x1fffff);
      keys[i] = {key, static_cast<std::uint32_t>(first + i)};
    }
    std::sort(keys, keys + count);
    for (std::size_t i = 0; i < count; ++i) order[first + i] = keys[i].second;
  });
  return order;
}

void RunGradients::evaluate(const PointRun& run, const PointRows& at) {
  run.batch.evaluateGradient(*run.tapes.distance, at.rows(), run.count, value, gradients.x, gradients.y,
                             gradients.z);
  slope = std::isfinite(run.tapes.distance->lipschitz()) ? run.tapes.distance->lipschitz() : 1.0f;
}

float RunGradients::distance(std::size_t i) const {
  const glm::vec3 g = gradient(i);
  const float squared = glm::dot(g, g),
              length = isOrdinary(squared) ? std::sqrt(squared) : std::hypot(g.x, g.y, g.z);
  return length > kVanishing * slope ? value[i] / length : value[i] / slope;
}

glm::vec3 RunGradients::normal(std::size_t i, const glm::vec3& otherwise) const {
  const glm::vec3 g = gradient(i);
  if (const float squared = glm::dot(g, g); isOrdinary(squared)) return g / std::sqrt(squared);
  const float size = std::abs(g.x) + std::abs(g.y) + std::abs(g.z);
  if (!(size > 0.0f && std::isfinite(size))) return otherwise;
  // Scaled by a power of two first, which rounds nothing.
  const glm::vec3 scaled = glm::ldexp(g, glm::ivec3(-std::ilogb(size)));
  return scaled / glm::length(scaled);
}

glm::vec3 RunGradients::step(std::size_t i) const {
  const glm::vec3 g = gradient(i);
  const float squared = glm::dot(g, g);
  if (!(squared > kVanishing * kVanishing * slope * slope)) return glm::vec3(0.0f);
  return g * (-value[i] / squared);
}

}  // namespace sdf
