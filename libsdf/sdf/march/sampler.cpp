#include "sdf/march/sampler.h"

#include <algorithm>
#include <cmath>

#include "sdf/eval/promise.h"

namespace sdf {
namespace {

// Of a distance's rounding: a value below it says little.
constexpr double kDoubtful = 4.0;

}  // namespace

Sample Sampler::at(const glm::dvec3& p) {
  scalar_.run(*field_.distance, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
  return {scalar_.output(0), scalar_.output(1)};
}

void Sampler::sample(const Vectors& points, std::vector<Sample>& samples) {
  samples.resize(points.size());
  PointRows block;
  float distance[kBatchPoints], step[kBatchPoints];
  float* const outputs[] = {distance, step};
  for (std::size_t first = 0; first < points.size(); first += kBatchPoints) {
    const std::size_t count = std::min(kBatchPoints, points.size() - first);
    for (std::size_t i = 0; i < count; ++i) block.set(i, points[first + i]);
    batch_.evaluate(*field_.distance, block.rows(), count, outputs);
    for (std::size_t i = 0; i < count; ++i) {
      const bool doubtful = std::abs(distance[i]) <= kDoubtful * distanceRounding(block.at(i));
      samples[first + i] = doubtful ? at(points[first + i]) : Sample{distance[i], step[i]};
    }
  }
}

}  // namespace sdf
