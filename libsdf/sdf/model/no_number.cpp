#include "sdf/model/no_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "sdf/base/random_point.h"
#include "sdf/expr/apply-inl.h"
#include "sdf/expr/origin.h"

namespace sdf {
namespace {

// Reads all nodes of a graph at a place, and follows those that its value depends on.
class NodeReading {
 public:
  NodeReading(const Expr& e, const Values& values) : nodes_(topologicalOrder({&e, 1})) {
    std::unordered_map<const Node*, int> places;
    for (const Expr& n : nodes_) {
      Arguments arguments{};
      for (int i = 0; i < countOf(n); ++i) arguments[i] = places.at(n.arg(i).node());
      arguments_.push_back(arguments);
      places.emplace(n.node(), static_cast<int>(places.size()));
      value_.push_back(fixedValue(n, values));
    }
  }

  // The innermost node that is no number at p, and that the value depends on.
  std::optional<Expr> noNumberAt(const glm::dvec3& p) {
    bool any = false;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      read(i, p);
      any = any || std::isnan(value_[i]);
    }
    return any ? innermost() : std::nullopt;
  }

  int size() const { return static_cast<int>(nodes_.size()); }

 private:
  using Arguments = std::array<int, 3>;

  static bool isRead(const Expr& n) {
    return n.op() != Op::Constant && n.op() != Op::Parameter && n.op() != Op::Variable;
  }
  static int countOf(const Expr& n) { return isRead(n) ? arity(n.op()) : 0; }

  static double fixedValue(const Expr& n, const Values& values) {
    if (n.op() == Op::Constant) return n.constantValue();
    if (n.op() != Op::Parameter) return 0.0;
    const auto given = values.find(n.parameterInfo().name);
    return given == values.end() ? n.parameterInfo().value : given->second;
  }

  void read(std::size_t i, const glm::dvec3& p) {
    const Expr& n = nodes_[i];
    if (n.op() == Op::Variable && n.variableIndex() <= Variable::Z)
      value_[i] = p[static_cast<int>(n.variableIndex())];
    else if (isRead(n))
      value_[i] =
          evaluateOp<double>(n.op(), n.payloadPart(), [&](int k) { return value_[arguments_[i][k]]; });
  }

  // From the value down; arguments come before their users.
  std::optional<Expr> innermost() const {
    std::vector<char> matters(nodes_.size(), 0);
    matters.back() = 1;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      if (!matters[i]) continue;
      bool isFirst = std::isnan(value_[i]);
      const int count = countOf(nodes_[i]);
      for (int k = 0; k < count; ++k) {
        if (nodes_[i].op() == Op::Select && k == (value_[arguments_[i][0]] != 0.0 ? 2 : 1)) continue;
        matters[arguments_[i][k]] = 1;
        isFirst = isFirst && !std::isnan(value_[arguments_[i][k]]);
      }
      if (isFirst) return nodes_[i];
    }
    return std::nullopt;
  }

  std::vector<Expr> nodes_;
  std::vector<Arguments> arguments_;
  std::vector<double> value_;
};

bool mayBeNoNumber(const Expr& e) {
  for (const Expr& n : topologicalOrder({&e, 1}))
    if (n.range().nan) return true;
  return false;
}

std::string percent(double share) {
  const double whole = std::round(100.0 * share);
  return std::to_string(std::max(1, static_cast<int>(whole))) + " %";
}

}  // namespace

std::optional<NoNumber> findNoNumber(const Expr& e, const Box& box, const Values& values, int places) {
  if (!mayBeNoNumber(e)) return std::nullopt;
  NodeReading reading(e, values);
  constexpr int kMostReadings = 4'000'000, kLeast = 16;
  places = std::min(places, std::max(kLeast, kMostReadings / reading.size()));
  std::mt19937 random(1);
  std::optional<NoNumber> found;
  int count = 0;
  for (int i = 0; i < places; ++i) {
    const glm::dvec3 p = pointIn(box, random);
    const std::optional<Expr> at = reading.noNumberAt(p);
    if (!at) continue;
    if (count++ == 0) found = NoNumber{p, 0.0, originOf(*at)};
  }
  if (found) found->share = static_cast<double>(count) / places;
  return found;
}

std::string textOf(const NoNumber& found, const std::string& place) {
  return (found.origin.empty() ? "the distance" : found.origin) + " is no number at " + place + ", as at " +
         percent(found.share) +
         " of the places that were tried, and the shape is arbitrary there. Let it be a number everywhere "
         "within the bounds, as by sqrt(max(a, 0)) in place of sqrt(a)";
}

}  // namespace sdf
