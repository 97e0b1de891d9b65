#include "sdf/mesh/measure/to_mesh.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/measure/read_values.h"

namespace sdf {
namespace {

// Cells of the whole; and of one operand of many, between these.
constexpr std::size_t kCells = 2048, kFewestCells = 64;
// A box is halved so often at most: what is left of it is a point then, up to the rounding of floats.
constexpr int kMostHalvings = 60;
// Tapes are specialised to cells at every third halving, when these have half the side.
constexpr int kSpecialised = 3;
// Of the bounds' sides: what lies on a face of them is inside of the cells.
constexpr double kMargin = 1e-3;
// Readings along a line; how often a piece of it is halved in which the slope lets the sign change twice, of
// which (1 - cos a) / 2 is left each time at an angle of a to the surface's normal; and the halvings of a
// piece in which it does change, as many as a float has bits.
constexpr std::size_t kAlong = 9;
constexpr int kIsolations = 5;
constexpr int kBisections = 24;

struct Cell {
  Box box;
  TapePtr tape;  // of the distance, as it is in the box
};

// Halves a box into cells that may hold a part of the surface.
class Divider {
 public:
  explicit Divider(const ModelTapes& model) : model_(model) {}

  /// As many cells as that or more, where there is a surface to be divided.
  std::vector<Cell> divide(const Box& box, std::size_t count, Progress& progress) {
    std::vector<Cell> cells{{box, tapeIn(box)}};
    for (int k = 1; k <= kMostHalvings && !cells.empty() && cells.size() < count && !progress.stopped();
         ++k) {
      std::vector<std::vector<Cell>> halves(cells.size());
      tbb::parallel_for(std::size_t{0}, cells.size(),
                        [&](std::size_t i) { halves[i] = halvesOf(cells[i], k % kSpecialised == 0); });
      cells.clear();
      for (std::vector<Cell>& two : halves)
        cells.insert(cells.end(), std::move_iterator(two.begin()), std::move_iterator(two.end()));
    }
    return cells;
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

  std::vector<Cell> halvesOf(const Cell& cell, bool specialise) {
    Scratch& scratch = scratch_.local();
    const glm::dvec3 size = cell.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<Cell> halves;
    for (const bool upper : {false, true}) {
      Cell half = cell;
      (upper ? half.box.min : half.box.max)[axis] = cell.box.centre()[axis];
      const Interval v = evaluate(*cell.tape, half.box, scratch.reading);
      if (!v.nan && (v.lo > 0.0 || v.hi < 0.0)) continue;
      if (specialise && cell.tape->decisionCount() > 0) {
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

// Points of the surface in a cell, on the lines along the axes through its centre.
class Roots {
 public:
  explicit Roots(double slope) : slope_(static_cast<float>(slope)) {}

  const std::vector<glm::vec3>& in(const Cell& cell) {
    const glm::vec3 min(cell.box.min), max(cell.box.max), centre(cell.box.centre());
    std::vector<Reading> along(3 * kAlong);
    for (std::size_t i = 0; i < along.size(); ++i) {
      const std::size_t axis = i / kAlong, k = i % kAlong;
      along[i].at = centre;
      along[i].at[axis] = min[axis] + (max[axis] - min[axis]) * (static_cast<float>(k) / (kAlong - 1));
    }
    read(*cell.tape, along);
    pieces_.clear();
    inside_.clear();
    outside_.clear();
    for (std::size_t i = 0; i + 1 < along.size(); ++i)
      if (i % kAlong != kAlong - 1) take({along[i], along[i + 1]});
    isolate(*cell.tape);
    bisect(*cell.tape);
    return outside_;  // a reading of 0 is outside
  }

 private:
  struct Reading {
    glm::vec3 at;
    float value;
  };
  struct Piece {
    Reading from, to;
  };

  void read(const Tape& tape, std::vector<Reading>& readings) {
    readValues(
        batch_, tape, readings.size(), [&](std::size_t i) { return readings[i].at; },
        [&](std::size_t i, float value) { readings[i].value = value; });
  }

  // Keeps a piece in which the sign changes, or may do so twice: the surface is |f| / slope away at least.
  void take(const Piece& piece) {
    const bool first = piece.from.value < 0.0f, second = piece.to.value < 0.0f;
    if (first != second) {
      inside_.push_back((first ? piece.from : piece.to).at);
      outside_.push_back((first ? piece.to : piece.from).at);
    } else if (std::abs(piece.from.value) + std::abs(piece.to.value) <
               slope_ * glm::distance(piece.from.at, piece.to.at)) {
      pieces_.push_back(piece);
    }
  }

  // Of the part that neither end's distance excludes.
  glm::vec3 middleOf(const Piece& piece) const {
    const glm::vec3 way = piece.to.at - piece.from.at;
    const float by = (std::abs(piece.from.value) - std::abs(piece.to.value)) / (slope_ * glm::length(way));
    return piece.from.at + 0.5f * (1.0f + by) * way;
  }

  void isolate(const Tape& tape) {
    if (slope_ == kInfinity) return;
    for (int k = 0; k < kIsolations && !pieces_.empty(); ++k) {
      const std::vector<Piece> halved = std::exchange(pieces_, {});
      std::vector<Reading> middles;
      for (const Piece& piece : halved) middles.push_back({middleOf(piece), 0.0f});
      read(tape, middles);
      for (std::size_t i = 0; i < halved.size(); ++i) {
        take({halved[i].from, middles[i]});
        take({middles[i], halved[i].to});
      }
    }
  }

  void bisect(const Tape& tape) {
    std::vector<Reading> middles(inside_.size());
    for (int k = 0; k < kBisections && !middles.empty(); ++k) {
      for (std::size_t i = 0; i < middles.size(); ++i) middles[i].at = 0.5f * (inside_[i] + outside_[i]);
      read(tape, middles);
      for (std::size_t i = 0; i < middles.size(); ++i)
        (middles[i].value < 0.0f ? inside_ : outside_)[i] = middles[i].at;
    }
  }

  float slope_;
  BatchEvaluator batch_;
  std::vector<Piece> pieces_;  // open: as the two ends tell, the sign may change twice between them
  std::vector<glm::vec3> inside_, outside_;
};

std::vector<Cell> cellsOf(const ModelTapes& model, const Box& bounds, Progress& progress) {
  Divider divider(model);
  std::vector<Cell> cells = divider.divide(bounds.grown(kMargin * bounds.longestSide()), kCells, progress);
  const std::size_t operands = model.all().size();
  if (operands < 2) return cells;
  for (const std::uint32_t operand : model.all()) {
    const Box box = intersect(model.boundsOf(operand), bounds);
    if (box.empty() || !box.finite() || box.contains(bounds)) continue;
    std::vector<Cell> more = divider.divide(box.grown(kMargin * box.longestSide()),
                                            std::max(kCells / operands, kFewestCells), progress);
    cells.insert(cells.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
  }
  return cells;
}

}  // namespace

std::vector<glm::vec3> surfacePoints(const ModelTapes& model, const Box& bounds, Progress& progress) {
  const std::vector<Cell> cells = cellsOf(model, bounds, progress);
  std::vector<std::vector<glm::vec3>> found(cells.size());
  tbb::enumerable_thread_specific<Roots> roots(model.slope());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
    if (progress.stopped()) return;
    found[i] = roots.local().in(cells[i]);
    progress.update(static_cast<double>(++done) / static_cast<double>(cells.size()));
  });
  std::vector<glm::vec3> all;
  for (const std::vector<glm::vec3>& here : found) all.insert(all.end(), here.begin(), here.end());
  return all;
}

std::vector<NearestPoint> nearestTriangles(const std::vector<glm::vec3>& points,
                                           const std::vector<glm::vec3>& positions,
                                           const std::vector<glm::uvec3>& triangles, Progress& progress) {
  constexpr std::size_t kAtATime = 256;
  const TriangleTree tree(positions, triangles);
  std::vector<NearestPoint> nearest(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kAtATime), [&](const auto& range) {
    std::uint32_t hint = 0;
    for (std::size_t i = range.begin(); i < range.end() && !progress.stopped(); ++i) {
      nearest[i] = tree.nearest(points[i], hint);
      hint = nearest[i].triangle;
    }
  });
  return nearest;
}

SurfaceDistance distanceToMesh(const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& positions,
                               const std::vector<glm::uvec3>& triangles, Progress& progress) {
  const std::vector<NearestPoint> nearest = nearestTriangles(points, positions, triangles, progress);
  SurfaceDistance all{.points = points.size()};
  if (progress.stopped()) return all;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double d = std::sqrt(nearest[i].squared); d > all.max) all.max = d, all.farthest = points[i];
  return all;
}

}  // namespace sdf
