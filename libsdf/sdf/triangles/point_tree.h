// Points of the plane, found by the triangles that hold them.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace sdf {

/// A balanced tree over points, each of which is on or off; at first all are off.
class PointTree {
 public:
  /// The points must outlive the tree. Cost: n log n.
  explicit PointTree(std::span<const glm::vec2> points);

  /// Cost: log n.
  void set(std::uint32_t point, bool on);
  bool isOn(std::uint32_t point) const { return on_[point]; }

  /// Calls visit(point) for those points that are on which a triangle may hold, all that it or its border
  /// holds among them, until a call returns true. Precondition: the corners run counter-clockwise.
  template <class Visit>
  bool anyNear(const std::array<glm::vec2, 3>& triangle, const Visit& visit) const {
    return !order_.empty() && anyNear({0, 0, order_.size()}, Probe(triangle), visit);
  }

 private:
  /// Points order_[begin .. end).
  struct Range {
    std::size_t node, begin, end;
    bool isLeaf() const { return end - begin <= kLeaf; }
    Range lower() const { return {2 * node + 1, begin, begin + (end - begin) / 2}; }
    Range upper() const { return {2 * node + 2, begin + (end - begin) / 2, end}; }
  };
  struct Node {
    glm::vec2 low, high;
    std::uint32_t on = 0;  // points in it that are
  };
  /// What tells that a box and a triangle are apart.
  struct Probe {
    explicit Probe(const std::array<glm::vec2, 3>& triangle);
    bool misses(const Node& node) const;

    std::array<glm::dvec2, 3> corners;
    glm::vec2 low, high;
  };
  static constexpr std::size_t kLeaf = 8;

  void build(const Range& range);

  template <class Visit>
  bool anyNear(const Range& range, const Probe& probe, const Visit& visit) const {
    const Node& node = nodes_[range.node];
    if (node.on == 0 || probe.misses(node)) return false;
    if (!range.isLeaf()) return anyNear(range.lower(), probe, visit) || anyNear(range.upper(), probe, visit);
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (on_[order_[i]] && visit(order_[i])) return true;
    return false;
  }

  std::span<const glm::vec2> points_;
  std::vector<std::uint32_t> order_, leafOf_;
  std::vector<char> on_;
  std::vector<Node> nodes_;
};

}  // namespace sdf
