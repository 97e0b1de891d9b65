#include "sdf/model/groups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "sdf/expr/hoist.h"
#include "sdf/expr/payload.h"
#include "sdf/model/model.h"

namespace sdf {
namespace {

constexpr char kOwn = '\x01';  // begins the names of groups' constants, and no scene's

// Fewer like operands cost less together than the passes that would draw their groups.
constexpr std::size_t kMany = 40;

// Parameters of a group: drivers have room for 1024 numbers at least, and more follow from these.
constexpr std::size_t kMostNumbers = 480;

// The same for operands that differ in nothing but constants. Payloads are numbered as they are met.
std::string kindOf(const Expr& operand, std::unordered_map<const Payload*, std::size_t>& payloads) {
  std::string kind;
  std::unordered_map<Expr, std::size_t> places;
  for (const Expr& node : topologicalOrder({&operand, 1})) {
    const std::size_t place = places.size();
    places.emplace(node, place);
    kind += std::to_string(static_cast<int>(node.op()));
    if (node.op() == Op::Variable) kind += "v" + std::to_string(static_cast<int>(node.variableIndex()));
    if (const PayloadPart* p = node.payloadPart())
      kind += "p" + std::to_string(payloads.try_emplace(p->payload.get(), payloads.size()).first->second) +
              "." + std::to_string(p->part);
    for (int i = 0; i < arity(node.op()); ++i) kind += "," + std::to_string(places.at(node.arg(i)));
    kind += ";";
  }
  return kind;
}

/// What operands of one kind have in common, and their other constants as parameters.
class Likeness {
 public:
  explicit Likeness(std::span<const NumberedOperand> operands) {
    std::unordered_map<Expr, std::size_t> uses;
    for (const NumberedOperand& operand : operands)
      for (const Expr& node : topologicalOrder({&operand.distance, 1})) ++uses[node];
    for (const auto& [node, count] : uses)
      if (count == operands.size()) common_.insert(node);
  }

  /// Its constants that not all have.
  std::size_t numbersOf(const Expr& operand) const {
    const auto own = [&](const Expr& node) { return node.isConstant() && !common_.contains(node); };
    return static_cast<std::size_t>(std::ranges::count_if(topologicalOrder({&operand, 1}), own));
  }

  /// A new parameter whose default is this value.
  Expr parameter(double v) {
    return Expr::parameter({kOwn + std::string("constant ") + std::to_string(parameters_++), v, v, v});
  }

  /// The operand with new parameters for those of its constants that not all have.
  Expr withParameters(const Expr& operand) {
    return rewrite(operand, [&](const Expr& node, std::span<const Expr>) -> std::optional<Expr> {
      if (common_.contains(node)) return node;
      if (node.isConstant()) return parameter(node.constantValue());
      return std::nullopt;
    });
  }

 private:
  std::unordered_set<Expr> common_;
  std::size_t parameters_ = 0;
};

struct Placed {
  NumberedOperand operand;
  glm::dvec3 place;
};

// The middle of the bounds, along the axes along which there are any.
glm::dvec3 placeOf(const Box& bounds) {
  const glm::dvec3 centre = bounds.centre();
  const auto along = [&](int axis) { return std::isfinite(centre[axis]) ? centre[axis] : 0.0; };
  return {along(0), along(1), along(2)};
}

struct Members {
  std::vector<Expr> distances, numbers;
  std::vector<Steep> steeps;

  void add(const Steep& steep, const Expr& number) {
    distances.push_back(steep.distance);
    numbers.push_back(number);
    steeps.push_back(steep);
  }

  OperandGroup joined() const {
    Expr least = distances.front();
    for (std::size_t i = 1; i < distances.size(); ++i) least = min(least, distances[i]);
    const bool isSteep = std::ranges::any_of(steeps, [](const Steep& s) { return s.slope != 1.0; });
    const Marchable steep = isSteep ? leastOf(steeps) : Marchable{least, least, 1.0};
    return {steep.distance, steep.step, numberOfLeast(distances, numbers)};
  }
};

// How many of so many operands a group takes: half as many as there are groups then.
std::size_t sizeOf(std::size_t operands, std::size_t numbersEach) {
  const auto root = static_cast<std::size_t>(std::lround(std::sqrt(0.5 * static_cast<double>(operands))));
  return std::clamp(kMostNumbers / numbersEach, std::size_t{1}, root);
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

// Adds the groups of one kind, unless it has too many numbers.
bool split(std::span<const NumberedOperand> alike, std::vector<OperandGroup>& result) {
  Likeness likeness(alike);
  const std::size_t numbers = likeness.numbersOf(alike.front().distance) + 1;
  if (numbers > kMostNumbers) return false;
  std::vector<Placed> placed;
  for (const NumberedOperand& e : alike) placed.push_back({e, placeOf(e.bounds)});
  const std::size_t size = sizeOf(placed.size(), numbers);
  // One for all, so that they stay alike.
  const double slope = std::ranges::max(alike, {}, &NumberedOperand::slope).slope;
  arrange(placed, size);
  while (placed.size() % size != 0) placed.push_back(placed.back());
  for (std::size_t i = 0; i < placed.size(); i += size) {
    const std::span group(placed.data() + i, size);
    // A union's later operand wins a tie.
    std::ranges::sort(group, {}, [](const Placed& p) { return p.operand.number; });
    Members members;
    for (const Placed& p : group)
      members.add({likeness.withParameters(p.operand.distance), slope}, likeness.parameter(p.operand.number));
    result.push_back(members.joined());
  }
  return true;
}

// The attribute of the operand of this number, one of those from `first` on.
Expr chosen(std::span<const Shape> operands, int attribute, double first, const Expr& number) {
  if (operands.size() == 1) return operands.front().surface[attribute];
  const std::size_t half = operands.size() / 2;
  const double middle = first + static_cast<double>(half);
  const Expr low = chosen(operands.first(half), attribute, first, number);
  const Expr high = chosen(operands.subspan(half), attribute, middle, number);
  return low == high ? low : select(less(middle - 0.5, number), high, low);
}

bool isHardUnion(const Shape& shape) { return shape.outer && shape.outer->blend.kind == Blend::Kind::Hard; }

NumberedOperand numbered(const Shape& shape, double number) {
  return {withoutClaims({&shape.distance, 1}).front(), shape.bounds, number, slopeOf(shape)};
}

}  // namespace

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
  return numberOfLeast(distances, numbers);
}

Attributes surfaceOf(const Shape& shape, const Expr& number) {
  Attributes result = shape.surface;
  if (isHardUnion(shape))
    for (int i = 0; i < kAttributeCount; ++i) result[i] = chosen(shape.outer->operands, i, 0.0, number);
  return result;
}

bool isGroupConstant(const std::string& name) { return name.starts_with(kOwn); }

std::vector<OperandGroup> groupsOf(std::span<const NumberedOperand> operands) {
  std::map<std::string, std::vector<NumberedOperand>> kinds;
  std::unordered_map<const Payload*, std::size_t> payloads;
  for (const NumberedOperand& e : operands) kinds[kindOf(e.distance, payloads)].push_back(e);
  std::vector<OperandGroup> result;
  std::vector<NumberedOperand> others;
  for (const auto& [kind, alike] : kinds) {
    if (alike.size() < kMany || !split(alike, result))
      others.insert(others.end(), alike.begin(), alike.end());
  }
  std::ranges::sort(others, {}, &NumberedOperand::number);
  Members rest;
  for (const NumberedOperand& e : others) rest.add({e.distance, e.slope, e.bounds}, e.number);
  if (!others.empty()) result.push_back(rest.joined());
  return result;
}

}  // namespace sdf
