#include "viewer/shaders/winner.h"

#include <optional>
#include <unordered_map>
#include <unordered_set>

namespace sdf::viewer {
namespace {

/// Operands in a row, by their places.
struct Row {
  std::size_t first, last;
};

class Decider {
 public:
  Decider(const Expr& distance, Expr winner) : winner_(std::move(winner)) {
    const std::vector<Expr> operands = operandsOf(distance);
    for (std::size_t i = 0; i < operands.size(); ++i) rows_.emplace(operands[i], Row{i, i});
    for (const Expr& e : topologicalOrder({&distance, 1})) {
      if (e.op() != Op::Min) continue;
      const auto a = rowOf(e.arg(0)), b = rowOf(e.arg(1));
      if (a && b && a->last + 1 == b->first) rows_.emplace(e, Row{a->first, b->last});
    }
  }

  // An attribute of what has this distance.
  Expr decided(const Expr& attribute, const Expr& distance) const {
    if (distance.op() != Op::Min || attribute.op() != Op::Select) return attribute;
    const Expr choice = attribute.arg(0), a = distance.arg(0), b = distance.arg(1);
    const auto first = rowOf(a), second = rowOf(b);
    // As unite writes it: the second where it is no farther.
    const bool ofUnion = choice.op() == Op::LessEqual && choice.arg(0) == b && choice.arg(1) == a;
    if (!ofUnion || !first || !second || first->last >= second->first) return attribute;
    return select(less(static_cast<double>(second->first) - 0.5, winner_), decided(attribute.arg(1), b),
                  decided(attribute.arg(2), a));
  }

 private:
  std::optional<Row> rowOf(const Expr& e) const {
    const auto found = rows_.find(e);
    return found == rows_.end() ? std::nullopt : std::optional(found->second);
  }

  Expr winner_;
  std::unordered_map<Expr, Row> rows_;
};

}  // namespace

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

std::vector<Expr> decided(std::span<const Expr> attributes, const Expr& distance, const Expr& winner) {
  const Decider decider(distance, winner);
  std::vector<Expr> result;
  for (const Expr& e : attributes) result.push_back(decider.decided(e, distance));
  return result;
}

}  // namespace sdf::viewer
