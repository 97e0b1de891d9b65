// Bounds of expressions over a region, by intervals over cells of it. Private to sdf/shape.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/expr/expr.h"
#include "sdf/number/dual-inl.h"

namespace sdf {

// The reading of several expressions at once over boxes.
template <class T>
class BoxReading {
 public:
  explicit BoxReading(std::span<const Expr> roots);

  void run(const Box& box);
  std::size_t size() const { return order_.size(); }
  const T& operator[](std::size_t output) const { return values_[outputs_[output]]; }

 private:
  struct Step {
    Op op;
    const PayloadPart* payload;
    std::array<std::size_t, 3> args;
  };
  std::vector<Expr> order_;
  std::vector<Step> steps_;  // of the order
  std::vector<std::size_t> outputs_;
  std::vector<T> values_;
};

// Of their values.
class IntervalReading : public BoxReading<Interval> {
 public:
  using BoxReading<Interval>::BoxReading;

  double most(std::size_t output) const {
    const Interval& i = (*this)[output];
    return i.nan ? kInfinity : i.hi;
  }
};

// Of their values at points, which are boxes without a size.
using PointReading = BoxReading<double>;

// And of their difference quotients along x, y and z, jumps included.
using Sloped = Dual<Interval, 3>;
using SlopedReading = BoxReading<Sloped>;

// The least magnitude that it has.
inline double nearest(const Interval& i) { return std::max({0.0, i.lo, -i.hi}); }
// The largest magnitude that it has; infinite where it may be no number.
inline double farthest(const Interval& i) { return i.nan ? kInfinity : i.magnitude(); }

// The expression looked up at the nearest point of the box, for what holds in it alone.
Expr heldWithin(const Expr& e, const Box& box);

// So many cells as are read in some ten milliseconds, if `most` are not too many: `work` over the number of
// operations. 60 say more than nothing of a graph that is larger, until they take some times as long.
inline std::size_t affordableCells(std::size_t work, std::size_t operations, std::size_t most) {
  const std::size_t least = std::clamp<std::size_t>(5 * work / operations, 1, 60);
  return std::clamp(work / operations, least, most);
}

// A cell of space with the slopes that bound each part's in it, the last being the whole's.
struct Cell {
  Box box;
  std::vector<double> slopes;
  double worst() const { return slopes.back(); }
};

// Cells that cover the region, halved where the slope is worst until that is good or there are too many.
// `slopesOf` reads one. `size` is the shape's: sides without an end are cut in such pieces.
template <class SlopesOf>
std::vector<Cell> refined(const Box& region, double size, std::size_t mostCells, SlopesOf slopesOf) {
  constexpr double kGood = 1.25;  // less is not looked for
  std::vector<Cell> cells;
  const auto add = [&](const Box& box) {
    cells.push_back({box, slopesOf(box)});
    std::ranges::push_heap(cells, {}, &Cell::worst);
  };
  add(region);
  while (cells.size() < mostCells && cells.front().worst() > kGood) {
    std::ranges::pop_heap(cells, {}, &Cell::worst);
    const Box box = cells.back().box;
    cells.pop_back();
    const glm::dvec3 sides = box.size();
    const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    const double lo = box.min[axis], hi = box.max[axis];
    const double unbounded = hi < kInfinity ? hi - size : lo > -kInfinity ? lo + size : 0.0;
    for (const bool upper : {false, true}) {
      Box half = box;
      (upper ? half.min : half.max)[axis] = hi - lo < kInfinity ? 0.5 * (lo + hi) : unbounded;
      add(half);
    }
  }
  return cells;
}

}  // namespace sdf
