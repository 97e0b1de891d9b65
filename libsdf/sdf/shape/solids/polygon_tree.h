// The sides of a polygon, and a tree of boxes over them. Private to shape/.
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

/// Boxes over the sides of a closed chain of points: side i goes from point i to the next one. A box holds
/// sides that follow one another. Immutable, and read from any thread.
class SideTree {
 public:
  /// At least one point. Cost: n.
  explicit SideTree(std::span<const glm::dvec2> points);

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

/// One side of a polygon, which lies to its left.
struct PolygonSide {
  glm::dvec2 from, along;  ///< its first corner; its direction, of length 1
  double size;             ///< its length
  double atFrom, atTo;     ///< tangents of half the turns to the left at its corners

  /// Where a point is, seen from the side.
  struct Place {
    double out;   ///< how far to the right of its line
    double past;  ///< how far along it beyond an end: negative before `from`, 0 beside the side

    double squared() const { return out * out + past * past; }  ///< of the distance
  };
  Place placeOf(const glm::dvec2& p) const {
    const glm::dvec2 r = p - from;
    const double t = r.x * along.x + r.y * along.y;
    return {r.x * along.y - r.y * along.x, t - std::clamp(t, 0.0, size)};
  }
  /// Is a point, to which this side is the nearest, outside of the polygon? At corners the sum of both
  /// sides' normals tells (Baerentzen, Aanaes 2005).
  bool isOutside(const Place& place) const {
    return place.out + (place.past < 0.0 ? -atFrom : atTo) * place.past > 0.0;
  }
};

/// The signed distance to a simple polygon. Immutable, and read from any thread.
class PolygonDistance {
 public:
  struct Read {
    double distance;      ///< negative inside
    glm::dvec2 gradient;  ///< of length 1; that of one side where there are several
    std::uint32_t side;   ///< the nearest
  };

  /// Corners counter-clockwise, at least three; neighbours differ, and sides do not touch. Cost: n.
  explicit PolygonDistance(std::span<const glm::dvec2> corners);

  const std::vector<PolygonSide>& sides() const { return sides_; }
  const SideTree& tree() const { return tree_; }
  const Rectangle& bounds() const { return tree_.bounds(); }

  /// The distance at p, which is finite, but for some roundings of what is as large as p and the sides.
  /// `hint` is a side that may be near. Cost: some log n, where few sides are about equally far.
  Read read(const glm::dvec2& p, std::uint32_t hint = 0) const;

 private:
  SideTree tree_;
  std::vector<PolygonSide> sides_;
};

}  // namespace sdf
