#include "sdf/mesh/surface/surface_points.h"
#include "sdf/eval/batch.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace sdf {
namespace {

// Has this sum of squares neither overflown nor lost what matters?
bool isOrdinary(float squared) { return squared > 0x1p-80f && squared < 0x1p80f; }

// Calls work(first, count, evaluator) for each kRunChunk of so many points, in parallel.
template <class Work>
void forEachChunk(std::size_t count, Progress& progress, const Work& work) {
  tbb::enumerable_thread_specific<BatchEvaluator> evaluators;
  const std::size_t chunks = (count + kRunChunk - 1) / kRunChunk;
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
    if (progress.stopped()) return;
    const std::size_t first = chunk * kRunChunk;
    work(first, std::min(count - first, kRunChunk), evaluators.local());
    progress.update(static_cast<double>(++done) / static_cast<double>(chunks));
  });
}

}  // namespace

void forEachRun(std::size_t count, const std::function<glm::vec3(std::size_t)>& point,
                const LocalField& field, Progress& progress,
                const std::function<void(const PointRun&)>& work) {
  forEachChunk(count, progress, [&](std::size_t first, std::size_t size, BatchEvaluator& evaluator) {
    const std::size_t end = first + size;
    const auto finder = field.finder();
    PointRows points;
    while (first < end) {
      const LocalField::Local here = finder->at(point(first));
      std::size_t taken = 0;
      for (; taken < kBatchPoints && first + taken < end; ++taken) {
        const glm::vec3 p = point(first + taken);
        const LocalField::Local there = finder->at(p);
        if (there.tapes.surface != here.tapes.surface || there.voxel != here.voxel) break;
        points.set(taken, p);
      }
      work({first, taken, points, here.tapes, here.voxel, evaluator});
      first += taken;
    }
  });
}

namespace {

// A chunk of points, ordered so that those with the same tapes and resolution follow one another.
class GroupedChunk {
 public:
  struct Group {
    LocalField::Local here;
    std::size_t end = 0;  // in order()
  };

  GroupedChunk(const glm::vec3* points, std::size_t count, LocalField::Finder& finder) : order_(count) {
    std::map<std::pair<const Tape*, double>, std::uint32_t> numbers;
    std::vector<std::uint32_t> groupOf(count);
    for (std::size_t i = 0; i < count; ++i) {
      const LocalField::Local here = finder.at(points[i]);
      const auto sameAs = [&](const LocalField::Local& o) {
        return o.tapes.surface == here.tapes.surface && o.voxel == here.voxel;
      };
      if (i > 0 && sameAs(groups_[groupOf[i - 1]].here)) {
        groupOf[i] = groupOf[i - 1];
      } else {
        const auto number = static_cast<std::uint32_t>(groups_.size());
        const auto [at, isNew] = numbers.try_emplace({here.tapes.surface.get(), here.voxel}, number);
        if (isNew) groups_.push_back({here});
        groupOf[i] = at->second;
      }
      ++groups_[groupOf[i]].end;
    }
    std::size_t begin = 0;
    for (Group& g : groups_) begin += std::exchange(g.end, begin);
    for (std::size_t i = 0; i < count; ++i) order_[groups_[groupOf[i]].end++] = i;
  }

  const std::vector<Group>& groups() const { return groups_; }
  /// The points' numbers in the chunk, a group after the other.
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  std::vector<Group> groups_;
  std::vector<std::size_t> order_;
};

}  // namespace

void forEachGroupedRun(const std::vector<glm::vec3>& points, const LocalField& field, Progress& progress,
                       const std::function<void(const PointRun&, const std::size_t*)>& work) {
  forEachChunk(points.size(), progress, [&](std::size_t first, std::size_t count, BatchEvaluator& evaluator) {
    const GroupedChunk grouped(&points[first], count, *field.finder());
    PointRows rows;
    std::size_t which[kBatchPoints], k = 0;
    for (const GroupedChunk::Group& group : grouped.groups())
      while (k < group.end) {
        const std::size_t begin = k;
        for (; k < group.end && k - begin < kBatchPoints; ++k) {
          which[k - begin] = first + grouped.order()[k];
          rows.set(k - begin, points[which[k - begin]]);
        }
        work({first + begin, k - begin, rows, group.here.tapes, group.here.voxel, evaluator}, which);
      }
  });
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
  return length > 0.0f ? value[i] / length : value[i] / slope;
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
  if (!(squared > 0.0f)) return glm::vec3(0.0f);
  return g * (-value[i] / squared);
}

}  // namespace sdf
