#include "sdf/model/groups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <unordered_map>

#include "sdf/expr/hoist.h"
#include "sdf/model/model.h"
#include "sdf/shape/operand.h"

namespace sdf {
namespace {

// A formula that is shared costs the loop over its rows, and a pass that draws them.
constexpr std::size_t kWorthSharing = 150;  // operations that this saves

// Operands of more operations are not joined into groups: a reading of a group would take all of them.
constexpr std::size_t kLarge = 100;

// Numbers of a group: a shader holds as many at once.
constexpr std::size_t kMostNumbers = 480;

struct Placed {
  std::size_t row;  // of its kind
  glm::dvec3 place;
};

// The middle of the bounds, along the axes along which there are any.
glm::dvec3 placeOf(const Box& bounds) {
  const glm::dvec3 centre = bounds.centre();
  const auto along = [&](int axis) { return std::isfinite(centre[axis]) ? centre[axis] : 0.0; };
  return {along(0), along(1), along(2)};
}

bool isLarge(const Alike& kind) { return operationsOf(kind.common) > kLarge; }

// How many operands a group takes: half as many as there are groups then.
std::size_t sizeOf(const Alike& kind, Grouping grouping) {
  if (grouping == Grouping::Singles || isLarge(kind)) return 1;
  const auto root =
      static_cast<std::size_t>(std::lround(std::sqrt(0.5 * static_cast<double>(kind.rows.size()))));
  return std::clamp(root, std::size_t{1},
                    std::max(kMostNumbers / (kind.parameters.size() + 1), std::size_t{1}));
}

// Puts neighbours side by side: cut across their longest side, at whole groups, again and again.
void arrange(std::span<Placed> all, std::size_t size) {
  const std::size_t groups = (all.size() + size - 1) / size;
  if (groups <= 1) return;
  Box box;
  for (const Placed& p : all) box = Box{glm::min(box.min, p.place), glm::max(box.max, p.place)};
  const glm::dvec3 sides = box.size();
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  const std::size_t cut = groups / 2 * size;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(cut), all.end(),
                   [&](const Placed& a, const Placed& b) { return a.place[axis] < b.place[axis]; });
  arrange(all.first(cut), size);
  arrange(all.subspan(cut), size);
}

// The rows of a kind in groups of neighbours; some are twice in the last one.
std::vector<std::vector<std::size_t>> grouped(const Alike& kind, std::span<const NumberedOperand> operands,
                                              Grouping grouping) {
  std::vector<Placed> placed;
  for (std::size_t row = 0; row < kind.places.size(); ++row)
    placed.push_back({row, placeOf(operands[kind.places[row]].bounds)});
  const std::size_t size = sizeOf(kind, grouping);
  arrange(placed, size);
  while (placed.size() % size != 0) placed.push_back(placed.back());
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < placed.size(); i += size) {
    std::vector<std::size_t>& group = groups.emplace_back();
    for (std::size_t k = i; k < i + size; ++k) group.push_back(placed[k].row);
    std::ranges::sort(group);  // a union's later operand wins a tie
  }
  return groups;
}

/// Names the parameters of rows.
class Names {
 public:
  explicit Names(const std::string& prefix) : prefix_(kOwnName + prefix) {}
  std::string next() { return prefix_ + std::to_string(count_++); }

 private:
  std::string prefix_;
  int count_ = 0;
};

// What all rows have: the number itself, or a parameter for it.
Expr column(NumberRows& rows, const std::vector<Expr>& numbers, Names& names) {
  if (std::ranges::all_of(numbers, [&](const Expr& e) { return e == numbers.front(); }))
    return numbers.front();
  rows.parameters.push_back(numberAmong(names.next(), numbers));
  for (std::size_t i = 0; i < numbers.size(); ++i) rows.numbers[i].push_back(numbers[i]);
  return rows.parameters.back();
}

// The middle and half the size of boxes along an axis. Where the sizes differ by no more than rounding they
// are one, and all are larger than in double by what is lost in float.
std::pair<std::vector<Expr>, std::vector<Expr>> spansOf(const std::vector<Box>& boxes, int axis) {
  constexpr double kRounding = 1e-6;
  double least = kInfinity, most = 0.0, farthest = 0.0;
  for (const Box& box : boxes) {
    least = std::min(least, 0.5 * box.size()[axis]);
    most = std::max(most, 0.5 * box.size()[axis]);
    farthest = std::max(farthest, std::abs(box.centre()[axis]));
  }
  const bool same = most - least <= kRounding * (most + farthest);
  std::pair<std::vector<Expr>, std::vector<Expr>> result;
  for (const Box& box : boxes) {
    result.first.emplace_back(box.centre()[axis]);
    result.second.emplace_back((same ? most : 0.5 * box.size()[axis]) + kRounding * (most + farthest));
  }
  return result;
}

// How far the position is beyond the boxes, by the axis along which that is most.
Expr beyond(const std::vector<Box>& boxes, NumberRows& rows, Names& names) {
  const auto gap = [&](int axis, const Expr& along) {
    const auto [middles, halves] = spansOf(boxes, axis);
    const Expr off = abs(along - column(rows, middles, names));
    return off - column(rows, halves, names);
  };
  const auto [x, y, z] = position();
  const Expr gaps[] = {gap(0, x), gap(1, y), gap(2, z)};  // braces keep the order
  return max(max(gaps[0], gaps[1]), gaps[2]);
}

// The step of a kind whose distance and gap are known.
void addStep(OperandKind& kind) {
  const Steep all{kind.distance, kind.slope};
  const Marchable divided = leastOf({&all, 1});
  const bool goesToBounds = divided.slope > 1.0 && !kind.gap.isConstant(-kInfinity);
  kind.step = goesToBounds ? max(divided.step, kind.gap) : divided.step;
  kind.stepGrowth = goesToBounds ? 1.0 : kind.growth * divided.slope;
}

OperandKind kindOf(const Alike& alike, std::span<const NumberedOperand> operands, Grouping grouping,
                   Names& names) {
  const auto groups = grouped(alike, operands, grouping);
  OperandKind kind;
  kind.groups.numbers.resize(groups.size());
  std::vector<Box> boxes;
  bool known = true;
  for (const auto& group : groups) {
    Box& box = boxes.emplace_back();
    for (const std::size_t row : group) {
      const NumberedOperand& operand = operands[alike.places[row]];
      box = unite(box, operand.bounds);
      kind.growth = std::max(kind.growth, operand.growth);
      kind.slope = std::max(kind.slope, operand.slope);
    }
    known = known && box.finite();
  }
  // To look at the bounds of what a list names takes as long as to read it.
  const bool looks = grouping == Grouping::Neighbours || isLarge(alike) || !isOneLipschitz(kind.slope);
  kind.gap = known && looks ? beyond(boxes, kind.groups, names) : Expr(-kInfinity);
  kind.gapNumbers = kind.groups.parameters.size();
  if (known && groups.front().size() == 1) kind.singles = boxes;
  std::vector<Expr> distances, numbers;
  for (std::size_t k = 0; k < groups.front().size(); ++k) {
    std::unordered_map<Expr, Expr> own;  // for the kind's parameters
    const auto member = [&](const auto& numberIn) {
      std::vector<Expr> all;
      for (const auto& group : groups) all.push_back(numberIn(group[k]));
      return column(kind.groups, all, names);
    };
    for (std::size_t i = 0; i < alike.parameters.size(); ++i)
      own.emplace(alike.parameters[i], member([&](std::size_t row) { return alike.rows[row][i]; }));
    distances.push_back(rewrite(alike.common.front(), [&](const Expr& e, std::span<const Expr>) {
      const auto found = own.find(e);
      return found == own.end() ? std::nullopt : std::optional(found->second);
    }));
    numbers.push_back(member([&](std::size_t row) { return Expr(operands[alike.places[row]].number); }));
  }
  kind.distance = distances.front();
  for (std::size_t k = 1; k < distances.size(); ++k) kind.distance = min(kind.distance, distances[k]);
  kind.nearest = indexOfMin(distances, numbers);
  addStep(kind);
  return kind;
}

// What sharing the formula of a kind saves.
std::size_t savedBy(const Alike& kind) { return operationsOf(kind.common) * (kind.places.size() - 1); }

// What choosing its numbers one by one would take.
std::size_t choicesAmong(const Alike& sort) { return sort.parameters.size() * (sort.places.size() - 1); }

// The attribute where the number is that of one of these, from `first` on.
Expr chosen(std::span<const Attributes> all, int attribute, double first, const Expr& number) {
  if (all.size() == 1) return all.front()[static_cast<std::size_t>(attribute)];
  const std::size_t half = all.size() / 2;
  const double middle = first + static_cast<double>(half);
  const Expr low = chosen(all.first(half), attribute, first, number);
  const Expr high = chosen(all.subspan(half), attribute, middle, number);
  return low == high ? low : select(less(middle - 0.5, number), high, low);
}

Attributes chosen(std::span<const Attributes> all, const Expr& number) {
  Attributes result;
  for (int i = 0; i < kAttributeCount; ++i) result[static_cast<std::size_t>(i)] = chosen(all, i, 0.0, number);
  return result;
}

NumberedOperand numbered(const Shape& shape, double number) {
  return {withoutClaims({&shape.distance, 1}).front(),
          shape.bounds,
          growthOf(shape.claim),
          number,
          slopeOf(shape),
          steepOf(shape).copies};
}

Attributes attributesFrom(const std::vector<Expr>& list) {
  Attributes result;
  std::ranges::copy(list, result.begin());
  return result;
}

}  // namespace

bool isHardUnion(const Shape& shape) { return shape.outer && shape.outer->blend.kind == Blend::Kind::Hard; }

std::vector<NumberedOperand> operandsOf(const Shape& shape, double first) {
  if (!isHardUnion(shape)) return {numbered(shape, first)};
  std::vector<NumberedOperand> result;
  for (const Shape& operand : shape.outer->operands)
    result.push_back(numbered(operand, first + static_cast<double>(result.size())));
  return result;
}

Expr numberOfNearest(std::span<const NumberedOperand> operands) {
  std::vector<Expr> distances, numbers;
  for (const NumberedOperand& operand : operands) {
    distances.push_back(operand.distance);
    numbers.emplace_back(operand.number);
  }
  return indexOfMin(distances, numbers);
}

OperandSurfaces surfaceOf(const Shape& shape, const Expr& number, bool mayShare) {
  OperandSurfaces result{shape.surface, {}};
  if (!isHardUnion(shape)) return result;
  const std::span<const Shape> operands = shape.outer->operands;
  std::vector<std::vector<Expr>> lists;
  std::vector<Attributes> own;
  for (const Shape& operand : operands) {
    // The number of the material is a number beside others, and no shader shows it.
    lists.emplace_back(operand.surface.begin(), operand.surface.end());
    own.push_back(operand.surface);
  }
  const std::vector<Alike> sorts = groupByStructure(lists, kOwnName + std::string("surface "));
  std::size_t saved = 0;
  for (const Alike& sort : sorts) saved += savedBy(sort) + choicesAmong(sort);
  if (!mayShare || saved < kWorthSharing) {
    result.attributes = chosen(own, number);
    return result;
  }
  Names names("look ");
  std::vector<Attributes> looks;
  std::vector<Expr> which(operands.size(), Expr(0.0));
  NumberRows& rows = result.operands;
  rows.numbers.resize(operands.size());
  for (const Alike& sort : sorts) {
    for (const std::size_t place : sort.places) which[place] = static_cast<double>(looks.size());
    looks.push_back(attributesFrom(sort.common));
  }
  result.attributes = chosen(looks, column(rows, which, names));
  for (const Alike& sort : sorts) {
    const std::size_t first = rows.parameters.size();
    rows.parameters.insert(rows.parameters.end(), sort.parameters.begin(), sort.parameters.end());
    for (auto& row : rows.numbers) row.resize(rows.parameters.size(), Expr(0.0));
    for (std::size_t i = 0; i < sort.places.size(); ++i)
      std::ranges::copy(sort.rows[i],
                        rows.numbers[sort.places[i]].begin() + static_cast<std::ptrdiff_t>(first));
  }
  return result;
}

Kinds kindsOf(std::span<const NumberedOperand> operands, Grouping grouping) {
  std::vector<std::vector<Expr>> distances;
  for (const NumberedOperand& operand : operands) distances.push_back({operand.distance});
  Kinds kinds;
  Names names("group ");
  for (const Alike& alike : groupByStructure(distances, kOwnName + std::string("operand "))) {
    if (savedBy(alike) >= kWorthSharing && alike.parameters.size() < kMostNumbers)
      kinds.many.push_back(kindOf(alike, operands, grouping, names));
    else
      for (const std::size_t place : alike.places) kinds.others.push_back(operands[place]);
  }
  std::ranges::sort(kinds.others, {}, &NumberedOperand::number);
  return kinds;
}

}  // namespace sdf
