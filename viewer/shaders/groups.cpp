#include "viewer/shaders/groups.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "sdf/base/box.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/hoist.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace {

// Fewer like operands cost less together than the passes that would draw their groups.
constexpr std::size_t kMany = 40;

// Parameters of a group: drivers have room for 1024 numbers at least, and more follow from these.
constexpr std::size_t kMostNumbers = 480;

// The same for operands that differ in nothing but constants.
std::string kindOf(const Expr& operand) {
  std::string kind;
  std::unordered_map<Expr, std::size_t> places;
  for (const Expr& node : topologicalOrder({&operand, 1})) {
    const std::size_t place = places.size();
    places.emplace(node, place);
    kind += std::to_string(static_cast<int>(node.op()));
    if (node.op() == Op::Variable) kind += "v" + std::to_string(static_cast<int>(node.variableIndex()));
    for (int i = 0; i < arity(node.op()); ++i) kind += "," + std::to_string(places.at(node.arg(i)));
    kind += ";";
  }
  return kind;
}

/// What operands of one kind have in common, and their other constants as parameters.
class Likeness {
 public:
  explicit Likeness(std::span<const Numbered> operands) {
    std::unordered_map<Expr, std::size_t> uses;
    for (const Numbered& operand : operands)
      for (const Expr& node : topologicalOrder({&operand.distance, 1})) ++uses[node];
    for (const auto& [node, count] : uses)
      if (count == operands.size()) common_.insert(node);
  }

  /// Its constants that not all have.
  std::size_t numbersOf(const Expr& operand) const {
    const std::vector<Expr> nodes = topologicalOrder({&operand, 1});
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](const Expr& node) {
      return node.isConstant() && !common_.contains(node);
    }));
  }

  /// A new parameter that stands at this value.
  Expr parameter(double v) { return Expr::parameter({"constant " + std::to_string(parameters_++), v, v, v}); }

  /// The operand with new parameters for those of its constants that not all have.
  Expr withParameters(const Expr& operand) {
    std::unordered_map<Expr, Expr> done;
    for (const Expr& node : topologicalOrder({&operand, 1})) {
      Expr made = node;
      if (common_.contains(node)) {
      } else if (node.isConstant()) {
        made = parameter(node.constantValue());
      } else if (arity(node.op()) > 0) {
        std::vector<Expr> args;
        for (int i = 0; i < arity(node.op()); ++i) args.push_back(done.at(node.arg(i)));
        made = Expr::make(node.op(), args);
      }
      done.emplace(node, made);
    }
    return done.at(operand);
  }

 private:
  std::unordered_set<Expr> common_;
  std::size_t parameters_ = 0;
};

struct Placed {
  Numbered operand;
  glm::dvec3 place;
};

// A point of its surface, or near it: that to which steps along the gradient lead from the origin.
glm::dvec3 placeOf(const Expr& operand) {
  constexpr int kSteps = 8;
  const Tape tape(operand);
  glm::dvec3 p(0.0);
  for (int i = 0; i < kSteps; ++i) {
    const auto [value, gradient] = evaluateGradient(tape, p);
    const glm::dvec3 next = p - value * gradient / glm::dot(gradient, gradient);
    if (!std::isfinite(glm::length(next))) break;
    p = next;
  }
  return p;
}

struct Members {
  std::vector<Expr> distances, numbers;

  void add(const Expr& distance, const Expr& number) {
    distances.push_back(distance);
    numbers.push_back(number);
  }

  Group joined() const {
    Expr least = distances.front();
    for (std::size_t i = 1; i < distances.size(); ++i) least = min(least, distances[i]);
    return {least, numberOfLeast(distances, numbers)};
  }
};

// A union's later operand wins a tie.
bool inOrder(const Numbered& a, const Numbered& b) { return a.number < b.number; }

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
bool split(std::span<const Numbered> alike, std::vector<Group>& result) {
  Likeness likeness(alike);
  const std::size_t numbers = likeness.numbersOf(alike.front().distance) + 1;
  if (numbers > kMostNumbers) return false;
  std::vector<Placed> placed;
  for (const Numbered& e : alike) placed.push_back({e, placeOf(e.distance)});
  const std::size_t size = sizeOf(placed.size(), numbers);
  arrange(placed, size);
  while (placed.size() % size != 0) placed.push_back(placed.back());
  for (std::size_t i = 0; i < placed.size(); i += size) {
    const std::span group(placed.data() + i, size);
    std::sort(group.begin(), group.end(),
              [](const Placed& a, const Placed& b) { return inOrder(a.operand, b.operand); });
    Members members;
    for (const Placed& p : group)
      members.add(likeness.withParameters(p.operand.distance), likeness.parameter(p.operand.number));
    result.push_back(members.joined());
  }
  return true;
}

}  // namespace

std::vector<Group> groupsOf(std::span<const Numbered> operands) {
  std::map<std::string, std::vector<Numbered>> kinds;
  for (const Numbered& e : operands) kinds[kindOf(e.distance)].push_back(e);
  std::vector<Group> result;
  std::vector<Numbered> others;
  for (const auto& [kind, alike] : kinds) {
    if (alike.size() < kMany || !split(alike, result))
      others.insert(others.end(), alike.begin(), alike.end());
  }
  std::sort(others.begin(), others.end(), inOrder);
  Members rest;
  for (const Numbered& e : others) rest.add(e.distance, e.number);
  if (!others.empty()) result.push_back(rest.joined());
  return result;
}

}  // namespace sdf::viewer
