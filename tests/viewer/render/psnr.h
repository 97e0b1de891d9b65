// How far two pictures of encoded colours, each part in [0, 1], are apart.
#pragma once
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace sdf::test {

/// Peak signal to noise ratio in decibels, the peak being 1: -10 log10 of the mean square of the differences
/// over all pixels and colours. Infinite for equal pictures. Both must have one size, not 0.
inline double psnr(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  assert(a.size() == b.size() && !a.empty());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  if (sum == 0.0) return std::numeric_limits<double>::infinity();
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(a.size())));
}

/// Share of the pixels of which a colour differs by more than x.
inline double shareApart(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, double x) {
  assert(a.size() == b.size() && !a.empty());
  std::size_t apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 d = glm::abs(a[i] - b[i]);
    if (std::max({d.x, d.y, d.z}) > x) ++apart;
  }
  return static_cast<double>(apart) / static_cast<double>(a.size());
}

}  // namespace sdf::test
