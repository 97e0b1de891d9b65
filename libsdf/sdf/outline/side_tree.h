// A tree of boxes over the sides of outlines.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sdf {

/// A rectangle.
struct Rectangle {
  glm::dvec2 lo{std::numeric_limits<double>::infinity()}, hi{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec2& p) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)}, hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  void add(const Rectangle& other) { add(other.lo), add(other.hi); }
  bool meets(const Rectangle& other) const {
    return lo.x <= other.hi.x && other.lo.x <= hi.x && lo.y <= other.hi.y && other.lo.y <= hi.y;
  }
  /// The squared distance between the two; 0 where they meet.
  double squaredTo(const Rectangle& other) const {
    const double x = std::max({0.0, other.lo.x - hi.x, lo.x - other.hi.x});
    const double y = std::max({0.0, other.lo.y - hi.y, lo.y - other.hi.y});
    return x * x + y * y;
  }
};

/// Boxes over sides. A box holds sides that follow one another. Immutable, and read from any thread.
class SideTree {
 public:
  /// The boxes of the sides, at least one. Cost: n.
  explicit SideTree(std::span<const Rectangle> sides);

  std::size_t size() const { return size_; }
  const Rectangle& bounds() const { return levels_.back()[0]; }

  /// Calls found(i), in ascending order, for the sides of all boxes that wanted(box) takes, until one returns
  /// true; returns whether one did. It may be called for sides beside those that are wanted.
  template <class Wanted, class Found>
  bool any(const Wanted& wanted, const Found& found) const {
    return anyBelow(levels_.size() - 1, 0, wanted, found);
  }

  /// Calls visit(i) for each side that may be nearer to p than the root of `least`, the nearer boxes first.
  /// `least` is what visit makes of it.
  template <class Visit>
  void nearest(const glm::dvec2& p, const double& least, const Visit& visit) const {
    nearestBelow(levels_.size() - 1, 0, {p, p}, least, visit);
  }

 private:
  static constexpr std::size_t kLeaf = 4;  // sides

  template <class Visit>
  bool anyOfLeaf(std::size_t leaf, const Visit& visit) const {
    for (std::size_t i = leaf * kLeaf; i < std::min(size_, (leaf + 1) * kLeaf); ++i)
      if (visit(i)) return true;
    return false;
  }

  template <class Wanted, class Found>
  bool anyBelow(std::size_t level, std::size_t node, const Wanted& wanted, const Found& found) const {
    if (!wanted(levels_[level][node])) return false;
    if (level == 0) return anyOfLeaf(node, found);
    const std::size_t left = 2 * node, right = left + 1;
    return anyBelow(level - 1, left, wanted, found) ||
           (right < levels_[level - 1].size() && anyBelow(level - 1, right, wanted, found));
  }

  template <class Visit>
  void nearestBelow(std::size_t level, std::size_t node, const Rectangle& p, const double& least,
                    const Visit& visit) const {
    if (level == 0) {
      anyOfLeaf(node, [&](std::size_t i) {
        visit(i);
        return false;
      });
      return;
    }
    const std::vector<Rectangle>& below = levels_[level - 1];
    std::size_t near = 2 * node, far = near + 1;
    double toNear = below[near].squaredTo(p);
    double toFar = far < below.size() ? below[far].squaredTo(p) : std::numeric_limits<double>::infinity();
    if (toFar < toNear) std::swap(near, far), std::swap(toNear, toFar);
    if (toNear < least) nearestBelow(level - 1, near, p, least, visit);
    if (toFar < least) nearestBelow(level - 1, far, p, least, visit);
  }

  std::size_t size_;
  std::vector<std::vector<Rectangle>> levels_;  // leaves first; a node has two of the level below, or one
};

}  // namespace sdf
