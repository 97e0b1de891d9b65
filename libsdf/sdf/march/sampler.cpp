#include "sdf/march/sampler.h"

#include <algorithm>
#include <cmath>

namespace sdf {
namespace {

// Float values are off by some tens of roundings of numbers of the size of the coordinates: 2^-18 of them.
// Below four times that the value says little.
constexpr double kDoubtful = 0x1p-16;

}  // namespace

double Sampler::at(const glm::dvec3& p) {
  scalar_.run(*field_.distance, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
  return scalar_.output() / field_.divisor();
}

void Sampler::sample(const Vectors& points, std::vector<double>& value) {
  value.resize(points.size());
  PointRows block;
  float f[kBatchPoints];
  for (std::size_t first = 0; first < points.size(); first += kBatchPoints) {
    const std::size_t count = std::min(kBatchPoints, points.size() - first);
    for (std::size_t i = 0; i < count; ++i) block.set(i, points[first + i]);
    batch_.evaluate(*field_.distance, block.rows(), count, f);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec3 size = glm::abs(block.at(i));
      const bool doubtful = std::abs(f[i]) <= kDoubtful * std::max({size.x, size.y, size.z});
      value[first + i] = doubtful ? at(points[first + i]) : f[i] / field_.divisor();
    }
  }
}

}  // namespace sdf
