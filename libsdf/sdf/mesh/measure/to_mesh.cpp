#include "sdf/mesh/measure/to_mesh.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/measure/cell_roots.h"

namespace sdf {
namespace {

// Cells of one operand of many at least.
constexpr std::size_t kFewestCells = 64;
// Times the cells that there are at first: so many are looked into at most. A gear, a chain, the creature and
// the twisted tower of the samples are decided by then, the planet's noise in two thirds of what was open at
// worst; where solids touch it never is.
constexpr std::size_t kSearched = 8;
// A box is halved so often at most: what is left of it is a point then, up to the rounding of floats.
constexpr int kMostHalvings = 60;
// Tapes are specialised to cells at every third halving, when these have half the side.
constexpr int kSpecialised = 3;
// Of the bounds' sides: what lies on a face of them is inside of the cells.
constexpr double kMargin = 1e-3;

struct Cell {
  Box box;
  TapePtr tape;      // of the distance, as it is in the box
  int halvings = 0;  // of the box that it is a part of
};

template <class T>
std::vector<T> joined(std::vector<std::vector<T>> lists) {
  std::vector<T> all;
  for (std::vector<T>& list : lists)
    all.insert(all.end(), std::move_iterator(list.begin()), std::move_iterator(list.end()));
  return all;
}

// Halves a box into cells that may hold a part of the surface.
class Divider {
 public:
  explicit Divider(const ModelTapes& model) : model_(model) {}

  /// As many cells as that or more, where there is a surface to be divided.
  std::vector<Cell> divide(const Box& box, std::size_t count, Progress& progress) {
    std::vector<Cell> cells{{box, tapeIn(box)}};
    for (int k = 0; k < kMostHalvings && !cells.empty() && cells.size() < count && !progress.stopped(); ++k)
      cells = halved(cells);
    return cells;
  }

  /// The halves of the cells that may hold a part of the surface.
  std::vector<Cell> halved(const std::vector<Cell>& cells) {
    std::vector<std::vector<Cell>> halves(cells.size());
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) { halves[i] = halvesOf(cells[i]); });
    return joined(std::move(halves));
  }

 private:
  struct Scratch {
    ScalarReading<Interval> reading;
    std::vector<Decision> decisions;
  };

  TapePtr tapeIn(const Box& box) const {
    if (model_.slope() == kInfinity) return model_.whole()->firstOutputOnly();
    std::vector<std::uint32_t> operands = model_.relevantOperands(box, 0.0, model_.all());
    if (operands.empty()) operands = {model_.all().front()};
    return model_.link(operands)->firstOutputOnly();
  }

  std::vector<Cell> halvesOf(const Cell& cell) {
    Scratch& scratch = scratch_.local();
    const glm::dvec3 size = cell.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<Cell> halves;
    for (const bool upper : {false, true}) {
      Cell half = cell;
      ++half.halvings;
      (upper ? half.box.min : half.box.max)[axis] = cell.box.centre()[axis];
      const Interval v = evaluate(*cell.tape, half.box, scratch.reading);
      if (!v.nan && (v.lo > 0.0 || v.hi < 0.0)) continue;
      if (half.halvings % kSpecialised == 0 && cell.tape->decisionCount() > 0) {
        evaluate(*cell.tape, half.box, scratch.reading, scratch.decisions);
        if (TapePtr special = cell.tape->specialised(scratch.decisions.data(), 1))
          half.tape = std::move(special);
      }
      halves.push_back(std::move(half));
    }
    return halves;
  }

  const ModelTapes& model_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
};

std::vector<Cell> cellsOf(Divider& divider, const ModelTapes& model, const Box& bounds, std::size_t count,
                          Progress& progress) {
  std::vector<Cell> cells = divider.divide(bounds.grown(kMargin * bounds.longestSide()), count, progress);
  const std::size_t operands = model.all().size();
  if (operands < 2) return cells;
  for (const std::uint32_t operand : model.all()) {
    const Box box = intersect(model.boundsOf(operand), bounds);
    if (box.empty() || !box.finite() || box.contains(bounds)) continue;
    std::vector<Cell> more = divider.divide(box.grown(kMargin * box.longestSide()),
                                            std::max(count / operands, kFewestCells), progress);
    cells.insert(cells.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  }
  return cells;
}

}  // namespace

std::vector<glm::vec3> surfacePoints(const ModelTapes& model, const Box& bounds, Progress& progress,
                                     std::size_t count) {
  Divider divider(model);
  tbb::enumerable_thread_specific<CellRoots> roots(model.slope(), bounds.longestSide());
  std::vector<glm::vec3> all;
  std::vector<Cell> cells = cellsOf(divider, model, bounds, count, progress);
  const std::size_t most = kSearched * cells.size();
  for (std::size_t searched = 0; !cells.empty() && searched < most;) {
    std::vector<std::vector<glm::vec3>> found(cells.size());
    std::vector<char> isOpen(cells.size(), 0);
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      if (progress.stopped()) return;
      CellRoots& local = roots.local();
      local.find(*cells[i].tape, cells[i].box, searched == 0);
      found[i] = local.points();
      isOpen[i] = local.isOpen();
    });
    searched += cells.size();
    progress.update(static_cast<double>(searched) / static_cast<double>(most));
    std::vector<Cell> open;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      all.insert(all.end(), found[i].begin(), found[i].end());
      if (isOpen[i]) open.push_back(std::move(cells[i]));
    }
    cells = divider.halved(open);
  }
  return all;
}

namespace {

// Points that one task takes.
constexpr std::size_t kAtATime = 1024;

// Any triangle within `enough`, squared, will do.
std::vector<NearestPoint> nearestIn(const TriangleTree& tree, const std::vector<glm::vec3>& points,
                                    double enough, Progress& progress) {
  std::vector<NearestPoint> nearest(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kAtATime), [&](const auto& range) {
    std::uint32_t hint = 0;
    for (std::size_t i = range.begin(); i < range.end() && !progress.stopped(); ++i) {
      nearest[i] = tree.nearest(points[i], hint, enough);
      hint = nearest[i].triangle;
    }
  });
  return nearest;
}

// Of points that follow one another. Those that are nearer than the farthest so far are looked at no closer.
SurfaceDistance distanceOf(std::span<const glm::vec3> points, const TriangleTree& tree, double limit,
                           Progress& progress) {
  SurfaceDistance all{.points = points.size()};
  std::uint32_t hint = 0;
  double farthest = -1.0;  // squared
  for (const glm::vec3& p : points) {
    if (progress.stopped()) break;
    const NearestPoint nearest = tree.nearest(p, hint, std::min(farthest, limit * limit));
    hint = nearest.triangle;
    const double distance = std::sqrt(nearest.squared);
    if (nearest.squared > farthest) farthest = nearest.squared, all.max = distance, all.farthest = p;
    if (distance > limit) ++all.beyond;
  }
  return all;
}

std::vector<FarPoint> farPoints(const std::vector<glm::vec3>& points,
                                const std::vector<NearestPoint>& nearest) {
  std::vector<FarPoint> all;
  for (std::size_t i = 0; i < points.size(); ++i) all.push_back({points[i], std::sqrt(nearest[i].squared)});
  return all;
}

// Those to climb from: half of them the farthest in each of the cells of a grid over the shape, from the
// farthest on, and then the farthest of the others.
std::vector<FarPoint> startsAmong(std::vector<FarPoint> points, double size, std::size_t count) {
  constexpr double kCellsAlong = 32.0;
  std::ranges::stable_sort(points, std::ranges::greater{}, &FarPoint::distance);
  std::set<std::array<double, 3>> taken;
  std::vector<FarPoint> starts, others;
  for (const FarPoint& p : points) {
    const glm::dvec3 cell = glm::floor(glm::dvec3(p.at) * (kCellsAlong / size));
    if (starts.size() < count / 2 && taken.insert({cell.x, cell.y, cell.z}).second)
      starts.push_back(p);
    else if (others.size() < count / 2)
      others.push_back(p);
  }
  starts.insert(starts.end(), others.begin(), others.end());
  return starts;
}

}  // namespace

std::vector<NearestPoint> nearestTriangles(const std::vector<glm::vec3>& points,
                                           const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::uvec3>& triangles, Progress& progress,
                                           double within) {
  return nearestIn(TriangleTree(positions, triangles), points, within < 0.0 ? -1.0 : within * within,
                   progress);
}

SurfaceDistance distanceToMesh(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& positions,
                               const std::vector<glm::uvec3>& triangles, Progress& progress, double limit) {
  const TriangleTree tree(positions, triangles);
  std::vector<SurfaceDistance> parts((points.size() + kAtATime - 1) / kAtATime);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    const std::size_t first = i * kAtATime;
    parts[i] = distanceOf(std::span(points).subspan(first, std::min(kAtATime, points.size() - first)), tree,
                          limit, progress);
  });
  SurfaceDistance all;
  for (const SurfaceDistance& part : parts) {
    if (part.max > all.max) all.max = part.max, all.farthest = part.farthest;
    all.points += part.points, all.beyond += part.beyond;
  }
  return all;
}

std::vector<FarPoint> farthestOfSurface(const std::vector<glm::vec3>& points, const LocalField& field,
                                        double size, const std::vector<glm::vec3>& positions,
                                        const std::vector<glm::uvec3>& triangles, Progress& progress,
                                        std::size_t climbers) {
  const TriangleTree tree(positions, triangles);
  const std::vector<NearestPoint> nearest = nearestIn(tree, points, -1.0, progress);
  if (progress.stopped()) return {};
  std::vector<FarPoint> all = farPoints(points, nearest),
                        climbed = startsAmong(all, size, std::min(climbers, triangles.size()));
  climb(climbed, field, size, tree, progress);
  all.insert(all.end(), climbed.begin(), climbed.end());
  return all;
}

SurfaceDistance farthestOf(const std::vector<FarPoint>& points, double limit) {
  SurfaceDistance all{.points = points.size()};
  for (const FarPoint& p : points) {
    if (p.distance > all.max) all.max = p.distance, all.farthest = p.at;
    if (p.distance > limit) ++all.beyond;
  }
  return all;
}

}  // namespace sdf
