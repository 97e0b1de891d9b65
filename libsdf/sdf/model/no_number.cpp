#include "sdf/model/no_number.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "sdf/base/random_point.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/origin.h"

namespace sdf {
namespace {

// Reads all nodes of a graph at a place, and follows those that its value depends on.
class NodeReading {
 public:
  NodeReading(const Expr& e, const Values& values)
      : nodes_(topologicalOrder({&e, 1})), tape_(Function(nodes_).at(values)) {
    for (const Expr& n : nodes_) place_.emplace(n.node(), place_.size());
  }

  // The innermost node that is no number at p, and that the value depends on.
  std::optional<Expr> noNumberAt(const glm::dvec3& p) const {
    const std::vector<double> value = evaluateAll(*tape_, p);
    const bool any = std::ranges::any_of(value, [](double v) { return std::isnan(v); });
    return any ? innermost(value) : std::nullopt;
  }

  int size() const { return static_cast<int>(nodes_.size()); }

 private:
  // From the value down; arguments come before their users.
  std::optional<Expr> innermost(const std::vector<double>& value) const {
    std::vector<char> matters(nodes_.size(), 0);
    matters.back() = 1;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      if (!matters[i]) continue;
      const Expr& n = nodes_[i];
      bool isFirst = std::isnan(value[i]);
      for (int k = 0; k < arity(n.op()); ++k) {
        if (n.op() == Op::Select && k == (value[placeOf(n, 0)] != 0.0 ? 2 : 1)) continue;
        matters[placeOf(n, k)] = 1;
        isFirst = isFirst && !std::isnan(value[placeOf(n, k)]);
      }
      if (isFirst) return n;
    }
    return std::nullopt;
  }
  std::size_t placeOf(const Expr& n, int argument) const { return place_.at(n.arg(argument).node()); }

  std::vector<Expr> nodes_;
  TapePtr tape_;  // of all of them
  std::unordered_map<const Node*, std::size_t> place_;
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
