// The sides of polygons, and of outlines whose sides are arcs, and the distance to them. Private to shape/.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "sdf/outline/arc.h"
#include "sdf/outline/side_tree.h"

namespace sdf {

/// One side of an outline, which lies to its left.
struct PolygonSide : Arc {
  double atFrom, atTo;  ///< tangents of half the turns to the left at its corners

  /// Is a point, to which this side is the nearest, outside of the outline? At corners the sum of both
  /// sides' normals tells (Baerentzen, Aanaes 2005).
  bool isOutside(const Place& place) const {
    return place.out + (place.past < 0.0 ? -atFrom : atTo) * place.past > 0.0;
  }
};

/// The signed distance to a polygon, or to contours of arcs. Immutable, and read from any thread.
class PolygonDistance {
 public:
  struct Read {
    double distance;      ///< negative inside
    glm::dvec2 gradient;  ///< of length 1; that of one side where there are several
    std::uint32_t side;   ///< the nearest
  };

  /// Corners counter-clockwise, at least three; neighbours differ, and sides do not touch. Cost: n.
  explicit PolygonDistance(std::span<const glm::dvec2> corners);
  /// At least one contour, each of at least two corners, with the inside to its left (boundaryOf). Cost: n.
  explicit PolygonDistance(const std::vector<ArcContour>& contours);

  const std::vector<PolygonSide>& sides() const { return sides_; }
  const SideTree& tree() const { return tree_; }
  const Rectangle& bounds() const { return tree_.bounds(); }
  bool hasArcs() const { return hasArcs_; }
  /// How many sides each contour has, in the order of the sides.
  const std::vector<std::size_t>& contourSizes() const { return contourSizes_; }

  /// The distance at p, which is finite, but for some roundings of what is as large as p and the sides.
  /// `hint` is a side that may be near. Cost: some log n, where few sides are about equally far.
  Read read(const glm::dvec2& p, std::uint32_t hint = 0) const;

 private:
  bool hasArcs_ = false;
  std::vector<std::size_t> contourSizes_;
  std::vector<PolygonSide> sides_;
  SideTree tree_;
};

}  // namespace sdf
