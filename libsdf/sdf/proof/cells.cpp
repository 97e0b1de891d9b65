#include "sdf/proof/cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sdf/base/disjoint_sets.h"

namespace sdf {
namespace {

constexpr int kGridDepth = 4, kGrid = 1 << kGridDepth;  // parts that sides are known of
constexpr int kDeepest = 9;
constexpr double kFinest = 1.0 / 32;  // of the voxel size: cells are not divided further
constexpr double kHopeless = 0.25;    // where no prism is proven, so that none helps
constexpr std::uint64_t kMostCells = 150'000;

// The first cell that was seen at each corner: a hash table with open addressing.
class Corners {
 public:
  explicit Corners(std::size_t most) : slots_(std::bit_ceil(2 * most + 1)) {}
  // That cell: `cell`, if there was none.
  std::uint32_t first(const glm::ivec3& at, std::uint32_t cell) {
    const std::uint64_t key =
        1 + ((static_cast<std::uint64_t>(at.x) << 40) | (static_cast<std::uint64_t>(at.y) << 20) |
             static_cast<std::uint64_t>(at.z));
    std::size_t i = (key * 0x9e3779b97f4a7c15u) >> 20 & (slots_.size() - 1);
    while (slots_[i].key != 0 && slots_[i].key != key) i = (i + 1) & (slots_.size() - 1);
    if (slots_[i].key == 0) slots_[i] = {key, cell};
    return slots_[i].cell;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;  // 0: empty
    std::uint32_t cell = 0;
  };
  std::vector<Slot> slots_;
};

}  // namespace

Box CellProver::boxOf(const Cell& cell) const {
  const double share = std::ldexp(1.0, -cell.depth);
  const glm::dvec3 size = box_.size();
  const glm::dvec3 at(cell.at);
  // Cells that touch have the same ends, for these are rounded alike.
  return {box_.min + at * share * size, box_.min + (at + 1.0) * share * size};
}

void CellProver::findSides(const std::vector<std::uint32_t>& triangles) {
  sides_.assign(kGrid * kGrid * kGrid, kInfinity);
  const glm::dvec3 scale = static_cast<double>(kGrid) / box_.size();
  for (const std::uint32_t t : triangles) {
    const Box b = shell_.boxOf(t);
    // A part more on either side covers rounding.
    const auto part = [&](const glm::dvec3& p, double more) {
      return glm::ivec3(glm::clamp(glm::floor((p - box_.min) * scale + more), 0.0, kGrid - 1.0));
    };
    const glm::ivec3 lo = part(b.min, -1e-6), hi = part(b.max, 1e-6);
    const double sides = proofs_[t].sides;
    for (int x = lo.x; x <= hi.x; ++x)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int z = lo.z; z <= hi.z; ++z) {
          double& least = sides_[(x * kGrid + y) * kGrid + z];
          least = std::min(least, sides);
        }
  }
}

double CellProver::sidesAt(const Cell& cell) const {
  const int up = std::max(0, cell.depth - kGridDepth), down = std::max(0, kGridDepth - cell.depth);
  const glm::ivec3 lo = (cell.at >> up) << down, hi = lo + (1 << down);
  double least = kInfinity;
  for (int x = lo.x; x < hi.x; ++x)
    for (int y = lo.y; y < hi.y; ++y)
      for (int z = lo.z; z < hi.z; ++z) least = std::min(least, sides_[(x * kGrid + y) * kGrid + z]);
  return least;
}

void CellProver::fail(const Cell& cell) {
  if (proof_.unproven++ > 0) return;
  const Box box = boxOf(cell);
  proof_.first = box.centre();
  proof_.size = box.longestSide();
}

CellProof CellProver::prove(const Tape& tape, const Box& box, const std::vector<std::uint32_t>& triangles,
                            double finest) {
  proof_ = {};
  box_ = box;
  finest_ = finest;
  findSides(triangles);
  for (std::vector<Cell> cells{{{0, 0, 0}, 0}}; !cells.empty();) {
    std::vector<Cell> inside;
    for (std::vector<Cell> next; !cells.empty(); cells.swap(next)) {
      next.clear();
      look(tape, cells, inside, next);
    }
    for (const Cell& cell : outsideOf(inside)) divide(cell, false, cells);
  }
  return proof_;
}

void CellProver::look(const Tape& tape, const std::vector<Cell>& cells, std::vector<Cell>& inside,
                      std::vector<Cell>& next) {
  std::vector<Box> boxes;
  for (const Cell& c : cells) boxes.push_back(boxOf(c));
  std::vector<Interval> values(boxes.size());
  reading_.boxes(tape, boxes, values.data());
  proof_.cells += cells.size();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Interval& v = values[i];
    if (!v.nan && (v.lo > 0.0 || v.hi < 0.0)) continue;
    const double sides = sidesAt(cells[i]);
    const bool isSided = sides > 0.0 && sides < kInfinity;
    if (!v.nan && isSided && v.magnitude() < sides)
      inside.push_back(cells[i]);
    else
      divide(cells[i], !isSided, next);
  }
}

// Its eighths, if they are not too small; no prism is proven near what is hopeless.
void CellProver::divide(const Cell& cell, bool isHopeless, std::vector<Cell>& parts) {
  const double side = std::ldexp(box_.longestSide(), -cell.depth);
  if (cell.depth == kDeepest || side <= (isHopeless ? kHopeless : kFinest) * finest_ ||
      proof_.cells > kMostCells)
    return fail(cell);
  for (int k = 0; k < 8; ++k)
    parts.push_back({2 * cell.at + glm::ivec3(k & 1, k >> 1 & 1, k >> 2), cell.depth + 1});
}

std::vector<CellProver::Cell> CellProver::outsideOf(const std::vector<Cell>& inside) const {
  DisjointSets groups(inside.size());  // of what touches
  Corners corners(4 * inside.size());
  for (std::uint32_t i = 0; i < inside.size(); ++i)
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 at = inside[i].at + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
      groups.join(i, corners.first(at << (kDeepest - inside[i].depth), i));
    }
  // 1: in the shell; -1: outside it, or not known.
  std::vector<std::int8_t> known(inside.size(), 0);
  for (std::uint32_t i = 0; i < inside.size(); ++i) {
    std::int8_t& group = known[groups.of(i)];
    if (group != 0) continue;
    const Box box = boxOf(inside[i]);
    if (const std::optional<int> degree =
            degree_.at(box.min + glm::dvec3(0.4871, 0.5137, 0.5419) * box.size()))
      group = *degree != 0 ? 1 : -1;
  }
  std::vector<Cell> outside;
  for (std::uint32_t i = 0; i < inside.size(); ++i)
    if (known[groups.of(i)] != 1) outside.push_back(inside[i]);
  return outside;
}

}  // namespace sdf
