#include "sdf/model/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "sdf/base/fnv.h"
#include "sdf/eval/batch.h"

namespace sdf {
namespace {

// Cubes around the bounds: some for each group, so that a list names few.
constexpr double kCubesPerGroup = 24.0, kLeastCubes = 4096.0, kMostCubes = 65536.0;
constexpr double kMargin = 4.0;  // in cubes, on each side: what is just above a surface is read most
constexpr double kReach = 8.0;   // in cubes

constexpr double kRounding = 1e-5;  // of a float reading, relative to what goes into it

bool isGivenByData(const Expr& e) {
  return std::ranges::any_of(topologicalOrder({&e, 1}),
                             [](const Expr& node) { return node.op() == Op::Payload; });
}

std::size_t groupsOf(const std::vector<OperandKind>& kinds) {
  return std::accumulate(
      kinds.begin(), kinds.end(), std::size_t{0},
      [](std::size_t sum, const OperandKind& kind) { return sum + kind.groups.numbers.size(); });
}

Box boundsOf(const std::vector<OperandKind>& kinds) {
  Box box;
  for (const OperandKind& kind : kinds)
    for (const Box& single : kind.singles) box = unite(box, single);
  return box;
}

// About as many cubes within the bounds as are wanted.
CellGrid gridAround(const Box& bounds, std::size_t groups) {
  const double wanted = std::clamp(kCubesPerGroup * static_cast<double>(groups), kLeastCubes, kMostCubes);
  glm::dvec3 counts(0.0);
  double size = 0.0;
  for (double along = 1.0; counts.x * counts.y * counts.z < wanted; ++along) {
    size = bounds.longestSide() / along;
    counts = glm::ceil(bounds.size() / size + kRounding);
  }
  CellGrid grid{bounds.centre(), kReach * size, kMargin * size, {}};
  const glm::dvec3 half = size * (0.5 * counts + kMargin);
  int first = 0;
  for (int i = 0; i < CellGrid::kLevels; ++i) {
    CellGrid::Level& level = grid.levels[static_cast<std::size_t>(i)];
    level.half = half + grid.reach * (std::ldexp(1.0, i) - 1.0);
    level.size = std::ldexp(size, i);
    level.side = glm::ivec3(glm::ceil(2.0 * level.half / level.size - kRounding));
    level.first = std::exchange(first, first + CellGrid::count(level.side));
  }
  return grid;
}

std::vector<Expr> numbersOf(const std::vector<OperandKind>& kinds) {
  std::vector<Expr> all;
  for (const OperandKind& kind : kinds)
    for (const std::vector<Expr>& row : kind.groups.numbers) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// Some cells of a level: from `low` up to, but not including, `high` along each axis.
struct Block {
  int level;
  glm::ivec3 low, high;
};

/// What may be the nearest in some blocks: a part of one list for each.
struct Candidates {
  std::vector<Block> blocks;
  std::vector<std::size_t> begins{0};  // of each block's groups, and the end of the last's
  std::vector<int> groups;             // counted over all kinds, ascending

  std::span<const int> of(std::size_t block) const {
    return std::span(groups).subspan(begins[block], begins[block + 1] - begins[block]);
  }
  void add(const Block& block, std::span<const int> among) {
    blocks.push_back(block);
    groups.insert(groups.end(), among.begin(), among.end());
    begins.push_back(groups.size());
  }
};

/// How far it is from a block's middle to a group, and how far that lets one go.
struct Reading {
  float distance, step;
};

struct Hash {
  std::size_t operator()(const std::vector<int>& list) const {
    std::size_t hash = kFnvBegin<std::size_t>;
    for (const int i : list) hash = fnv(hash, static_cast<std::size_t>(i));
    return hash;
  }
};

/// The lists of one kind, like ones once.
class ListWriter {
 public:
  CellLists::List add(std::span<const int> list);
  std::vector<int> take() { return std::move(entries_); }

 private:
  std::vector<int> entries_;
  std::unordered_map<std::vector<int>, int, Hash> begins_;
};

CellLists::List ListWriter::add(std::span<const int> list) {
  const auto [found, isNew] =
      begins_.try_emplace(std::vector(list.begin(), list.end()), static_cast<int>(entries_.size()));
  if (isNew) entries_.insert(entries_.end(), list.begin(), list.end());
  return {found->second, static_cast<int>(list.size())};
}

/// One group of a kind at some values.
struct GroupAtValues {
  TapePtr tape;  // of the distance, and the step
  double slope;
  std::size_t kind;
  int number;  // among those of the kind
};

// Reads every candidate at its block's middle, group by group.
std::vector<Reading> readingsOf(const Candidates& open, std::span<const glm::dvec3> middles,
                                std::span<const GroupAtValues> groups) {
  std::vector<std::size_t> ends(groups.size() + 1, 0);
  for (const int group : open.groups) ++ends[static_cast<std::size_t>(group) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  struct Place {
    std::size_t block, candidate;
  };
  std::vector<Place> places(open.groups.size());
  std::vector<std::size_t> next(ends.begin(), ends.end() - 1);
  for (std::size_t block = 0; block < open.blocks.size(); ++block)
    for (std::size_t i = open.begins[block]; i < open.begins[block + 1]; ++i)
      places[next[static_cast<std::size_t>(open.groups[i])]++] = {block, i};
  std::vector<Reading> readings(places.size());
  BatchEvaluator evaluator;
  PointRows points;
  std::array<float, kBatchPoints> distances, steps;
  for (std::size_t group = 0; group < groups.size(); ++group)
    for (std::size_t first = ends[group]; first < ends[group + 1]; first += kBatchPoints) {
      const std::size_t count = std::min(kBatchPoints, ends[group + 1] - first);
      for (std::size_t i = 0; i < count; ++i) points.set(i, glm::vec3(middles[places[first + i].block]));
      evaluator.evaluate(*groups[group].tape, points.rows(), count,
                         std::array{distances.data(), steps.data()});
      for (std::size_t i = 0; i < count; ++i)
        readings[places[first + i].candidate] = {distances[i], steps[i]};
    }
  return readings;
}

// Those whose distance or step may be the least somewhere within the radius. What is not a number stays.
std::vector<int> nearest(std::span<const int> among, std::span<const Reading> readings,
                         std::span<const GroupAtValues> groups, double radius, double slack) {
  double distance = kInfinity, step = kInfinity;
  const auto slope = [&](std::size_t i) { return groups[static_cast<std::size_t>(among[i])].slope; };
  for (std::size_t i = 0; i < among.size(); ++i) {
    distance = std::min(distance, readings[i].distance + slope(i) * radius);
    step = std::min(step, readings[i].step + radius);
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < among.size(); ++i)
    if (!(readings[i].distance - slope(i) * radius > distance + slack) ||
        !(readings[i].step - radius > step + slack))
      result.push_back(among[i]);
  return result;
}

// The block's eighths, or its halves or quarters where it is one cell thick.
void halve(const Block& block, std::span<const int> among, Candidates& next) {
  const glm::ivec3 size = block.high - block.low, middle = block.low + (size + 1) / 2;
  for (int i = 0; i < 8; ++i) {
    Block part = block;
    for (int axis = 0; axis < 3; ++axis) (i >> axis & 1 ? part.low : part.high)[axis] = middle[axis];
    if (glm::all(glm::lessThan(part.low, part.high))) next.add(part, among);
  }
}

/// Halves blocks of a grid's cells until they are cells, or one group alone is the nearest.
class Sorting {
 public:
  Sorting(const CellGrid& grid, std::span<const GroupAtValues> groups, std::size_t kinds);
  CellLists lists();

 private:
  Box boxOf(const Block& block) const;
  // Never looked at: the box of the level before covers it.
  bool isCovered(const Block& block, const Box& box) const;
  void sort(const Block& block, std::span<const int> among, std::span<const Reading> readings);
  std::vector<CellLists::List> listsOf(std::span<const int> groups);
  void list(const Block& block, std::span<const int> groups);

  CellGrid grid_;
  std::span<const GroupAtValues> groups_;
  std::vector<ListWriter> writers_;  // by kind
  CellLists lists_;
  Candidates open_, next_;
};

Sorting::Sorting(const CellGrid& grid, std::span<const GroupAtValues> groups, std::size_t kinds)
    : grid_(grid), groups_(groups), writers_(kinds) {
  std::vector<int> all(groups.size());
  std::iota(all.begin(), all.end(), 0);
  for (int i = 0; i < CellGrid::kLevels; ++i)
    open_.add({i, glm::ivec3(0), grid.levels[static_cast<std::size_t>(i)].side}, all);
  lists_.lists.resize(kinds * static_cast<std::size_t>(grid.cells() + 1));
  const std::ptrdiff_t beyond = grid.cells() - 1;
  std::ranges::copy(listsOf(all), lists_.lists.begin() + beyond * static_cast<std::ptrdiff_t>(kinds));
}

CellLists Sorting::lists() {
  while (!open_.blocks.empty()) {
    std::vector<glm::dvec3> middles;
    for (const Block& block : open_.blocks) middles.push_back(boxOf(block).centre());
    const std::vector<Reading> readings = readingsOf(open_, middles, groups_);
    for (std::size_t i = 0; i < open_.blocks.size(); ++i)
      sort(open_.blocks[i], open_.of(i), std::span(readings).subspan(open_.begins[i]));
    open_ = std::exchange(next_, {});
  }
  for (ListWriter& writer : writers_) lists_.entries.push_back(writer.take());
  return std::move(lists_);
}

Box Sorting::boxOf(const Block& block) const {
  return unite(grid_.boxOf(block.level, block.low), grid_.boxOf(block.level, block.high - 1));
}

bool Sorting::isCovered(const Block& block, const Box& box) const {
  if (block.level == 0) return false;
  const CellGrid::Level& before = grid_.levels[static_cast<std::size_t>(block.level - 1)];
  const glm::dvec3 half = before.half - kRounding * before.size;
  return Box{grid_.middle - half, grid_.middle + half}.contains(box);
}

void Sorting::sort(const Block& block, std::span<const int> among, std::span<const Reading> readings) {
  const Box box = boxOf(block);
  if (isCovered(block, box)) return;
  const double radius = 0.5 * glm::length(box.size());
  const glm::dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double slack = kRounding * (farthest.x + farthest.y + farthest.z);
  const std::vector<int> left = nearest(among, readings, groups_, radius, slack);
  if (left.size() <= 1 || block.high - block.low == glm::ivec3(1))
    list(block, left);
  else
    halve(block, left, next_);
}

std::vector<CellLists::List> Sorting::listsOf(std::span<const int> groups) {
  std::vector<std::vector<int>> byKind(writers_.size());
  for (const int group : groups) {
    const GroupAtValues& g = groups_[static_cast<std::size_t>(group)];
    byKind[g.kind].push_back(g.number);
  }
  std::vector<CellLists::List> result;
  for (std::size_t kind = 0; kind < byKind.size(); ++kind) result.push_back(writers_[kind].add(byKind[kind]));
  return result;
}

void Sorting::list(const Block& block, std::span<const int> groups) {
  const std::vector<CellLists::List> all = listsOf(groups);
  for (int z = block.low.z; z < block.high.z; ++z)
    for (int y = block.low.y; y < block.high.y; ++y)
      for (int x = block.low.x; x < block.high.x; ++x)
        std::ranges::copy(all, lists_.lists.begin() + static_cast<std::ptrdiff_t>(all.size()) *
                                                          grid_.cell(block.level, {x, y, z}));
}

}  // namespace

int CellGrid::cell(int level, const glm::ivec3& c) const {
  const auto& [half, size, side, first] = levels[static_cast<std::size_t>(level)];
  return first + (c.z * side.y + c.y) * side.x + c.x;
}

int CellGrid::cellAt(const glm::dvec3& p) const {
  const glm::dvec3 off = p - middle;
  for (int i = 0; i < kLevels; ++i) {
    const auto& [half, size, side, first] = levels[static_cast<std::size_t>(i)];
    if (glm::all(glm::lessThan(glm::abs(off), half)))
      return cell(i, glm::clamp(glm::ivec3((off + half) / size), glm::ivec3(0), side - 1));
  }
  return cells() - 1;
}

Box CellGrid::boxOf(int level, const glm::ivec3& c) const {
  const auto& [half, size, side, first] = levels[static_cast<std::size_t>(level)];
  const glm::dvec3 low = middle - half + size * glm::dvec3(c);
  return {low, low + size};
}

bool CellSorter::worthwhile(const std::vector<OperandKind>& kinds) {
  const std::size_t groups = groupsOf(kinds);
  return groups >= kFewest && groups <= kMost && std::ranges::none_of(kinds, [](const OperandKind& kind) {
           return kind.singles.empty() || isGivenByData(kind.distance);
         });
}

CellSorter::CellSorter(const std::vector<OperandKind>& kinds)
    : numbers_(numbersOf(kinds)), grid_(gridAround(boundsOf(kinds), groupsOf(kinds))) {
  for (const OperandKind& kind : kinds) {
    kinds_.push_back(
        {Function({kind.distance, kind.step}), {}, static_cast<int>(kind.groups.numbers.size()), kind.slope});
    std::vector<std::string>& names = kinds_.back().names;
    for (const Expr& parameter : kind.groups.parameters) names.push_back(parameter.parameterInfo().name);
  }
}

std::vector<std::string> CellSorter::inputs() const {
  std::vector<std::string> names;
  const auto add = [&](const Function& function, const std::vector<std::string>& own) {
    for (const ParameterInfo& input : function.inputs())
      if (std::ranges::find(own, input.name) == own.end()) names.push_back(input.name);
  };
  add(numbers_, {});
  for (const Kind& kind : kinds_) add(kind.read, kind.names);
  return names;
}

CellLists CellSorter::lists(const Values& values) const {
  const std::vector<double> numbers = numbers_.uniform(values);
  auto number = numbers.begin();
  std::vector<GroupAtValues> groups;
  for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
    const auto& [read, names, count, slope] = kinds_[kind];
    Values own = values;
    for (int i = 0; i < count; ++i) {
      for (const std::string& name : names) own[name] = *number++;
      groups.push_back({read.at(own), slope, kind, i});
    }
  }
  return Sorting(grid_, groups, kinds_.size()).lists();
}

}  // namespace sdf
