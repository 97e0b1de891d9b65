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

namespace sdf::viewer {
namespace {

// Fewer like operands cost less together than the passes that would draw their groups.
constexpr std::size_t kMany = 40;

// Numbers that a group's parameters may be: every driver has room for 1024, and some are the scene's own.
constexpr std::size_t kMostNumbers = 960;

std::vector<Expr> operandsOf(const Expr& distance) {
  std::vector<Expr> result, open{distance};
  std::unordered_set<Expr> seen;
  while (!open.empty()) {
    const Expr e = open.back();
    open.pop_back();
    if (!seen.insert(e).second) continue;
    if (e.op() == Op::Min)
      open.insert(open.end(), {e.arg(1), e.arg(0)});
    else
      result.push_back(e);
  }
  return result;
}

Expr leastOf(std::span<const Expr> all) {
  Expr least = all.front();
  for (const Expr& other : all.subspan(1)) least = min(least, other);
  return least;
}

/// What the operands of a union have in common, and how they are made otherwise.
class Likeness {
 public:
  explicit Likeness(std::span<const Expr> operands) {
    std::unordered_map<Expr, std::size_t> uses;
    for (const Expr& e : operands)
      for (const Expr& node : topologicalOrder({&e, 1})) ++uses[node];
    for (const auto& [node, count] : uses)
      if (count == operands.size()) common_.emplace(node, common_.size());
  }

  /// The same for operands that differ in nothing but constants.
  std::string kindOf(const Expr& operand) const {
    std::string kind;
    std::unordered_map<Expr, std::size_t> places;
    for (const Expr& node : topologicalOrder({&operand, 1})) {
      const std::size_t place = places.size();
      places.emplace(node, place);
      if (const auto shared = common_.find(node); shared != common_.end()) {
        kind += "common " + std::to_string(shared->second);
      } else if (!node.isConstant()) {
        kind += std::to_string(static_cast<int>(node.op()));
        if (node.op() == Op::Variable) kind += "v" + std::to_string(static_cast<int>(node.variableIndex()));
        for (int i = 0; i < arity(node.op()); ++i) kind += "," + std::to_string(places.at(node.arg(i)));
      }
      kind += ";";
    }
    return kind;
  }

  /// Its constants that not all have.
  std::size_t numbersOf(const Expr& operand) const {
    const std::vector<Expr> nodes = topologicalOrder({&operand, 1});
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](const Expr& node) {
      return node.isConstant() && !common_.contains(node);
    }));
  }

  /// The operand with new parameters for those of its constants that not all have.
  Expr withParameters(const Expr& operand) {
    std::unordered_map<Expr, Expr> done;
    for (const Expr& node : topologicalOrder({&operand, 1})) {
      Expr made = node;
      if (common_.contains(node)) {
      } else if (node.isConstant()) {
        const double v = node.constantValue();
        made = Expr::parameter({"constant " + std::to_string(parameters_++), v, v, v});
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
  std::unordered_map<Expr, std::size_t> common_;
  std::size_t parameters_ = 0;
};

struct Placed {
  Expr operand;
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

}  // namespace

std::vector<Expr> groupsOf(const Expr& distance) {
  const std::vector<Expr> operands = operandsOf(distance);
  if (operands.size() < kMany) return {distance};
  Likeness likeness(operands);
  std::map<std::string, std::vector<Placed>> kinds;
  for (const Expr& e : operands) kinds[likeness.kindOf(e)].push_back({e, placeOf(e)});
  std::vector<Expr> result, others;
  for (auto& [kind, alike] : kinds) {
    if (alike.size() < kMany) {
      for (const Placed& p : alike) others.push_back(p.operand);
      continue;
    }
    const std::size_t numbers = likeness.numbersOf(alike.front().operand);
    const auto root = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(alike.size()))));
    const std::size_t size =
        std::clamp(kMostNumbers / std::max(numbers, std::size_t{1}), std::size_t{1}, root);
    arrange(alike, size);
    while (alike.size() % size != 0) alike.push_back(alike.back());
    for (std::size_t i = 0; i < alike.size(); i += size) {
      std::vector<Expr> group;
      for (std::size_t k = i; k < i + size; ++k) group.push_back(likeness.withParameters(alike[k].operand));
      result.push_back(leastOf(group));
    }
  }
  if (result.empty()) return {distance};
  if (!others.empty()) result.push_back(leastOf(others));
  return result;
}

}  // namespace sdf::viewer
