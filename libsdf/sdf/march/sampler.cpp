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
  const std::size_t count = points.size();
  x_.assign(points.x.begin(), points.x.end());
  y_.assign(points.y.begin(), points.y.end());
  z_.assign(points.z.begin(), points.z.end());
  f_.resize(count);
  value.resize(count);
  batch_.evaluate(*field_.distance, {x_.data(), y_.data(), z_.data()}, count, f_.data());
  for (std::size_t i = 0; i < count; ++i) {
    const float size = std::max({std::abs(x_[i]), std::abs(y_[i]), std::abs(z_[i])});
    value[i] = std::abs(f_[i]) <= kDoubtful * size ? at(points[i]) : f_[i] / field_.divisor();
  }
}

}  // namespace sdf
