#include "sdf/triangles/point_tree.h"

#include <bit>
#include <numeric>

namespace sdf {

PointTree::PointTree(std::span<const glm::vec2> points)
    : points_(points), order_(points.size()), leafOf_(points.size()), on_(points.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (points.empty()) return;
  const std::size_t leaves = std::bit_ceil((points.size() + kLeaf - 1) / kLeaf);
  nodes_.resize(2 * leaves - 1);
  build({0, 0, order_.size()});
}

void PointTree::build(const Range& range) {
  Node& node = nodes_[range.node];
  node.low = node.high = points_[order_[range.begin]];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    node.low = glm::min(node.low, points_[order_[i]]);
    node.high = glm::max(node.high, points_[order_[i]]);
  }
  if (range.isLeaf()) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      leafOf_[order_[i]] = static_cast<std::uint32_t>(range.node);
    return;
  }
  const glm::dvec2 size = glm::dvec2(node.high) - glm::dvec2(node.low);
  const int axis = size.y > size.x ? 1 : 0;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(range.upper().begin), at(range.end),
                   [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
  build(range.lower());
  build(range.upper());
}

void PointTree::set(std::uint32_t point, bool on) {
  if (isOn(point) == on) return;
  on_[point] = on;
  for (std::size_t node = leafOf_[point];; node = (node - 1) / 2) {
    nodes_[node].on += on ? 1u : ~0u;
    if (node == 0) return;
  }
}

PointTree::Probe::Probe(const std::array<glm::vec2, 3>& triangle)
    : corners{glm::dvec2(triangle[0]), glm::dvec2(triangle[1]), glm::dvec2(triangle[2])},
      low(glm::min(glm::min(triangle[0], triangle[1]), triangle[2])),
      high(glm::max(glm::max(triangle[0], triangle[1]), triangle[2])) {}

bool PointTree::Probe::misses(const Node& node) const {
  for (int k = 0; k < 2; ++k)
    if (node.high[k] < low[k] || node.low[k] > high[k]) return true;
  // Of the box's corners the one that is farthest to the left of a side says whether all are on its right.
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 from = corners[k], way = corners[(k + 1) % 3] - from;
    const double x = (way.y > 0.0 ? node.low.x : node.high.x) - from.x,
                 y = (way.x > 0.0 ? node.high.y : node.low.y) - from.y;
    const double left = way.x * y, right = way.y * x;
    constexpr double kRounding = 8.0 * 0x1p-53;
    if (left - right < -kRounding * (std::abs(left) + std::abs(right))) return true;
  }
  return false;
}

}  // namespace sdf
