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

std::optional<Row> together(const Row& a, const Row& b) {
  if (a.last + 1 == b.first) return Row{a.first, b.last};
  if (b.last + 1 == a.first) return Row{b.first, a.last};
  return std::nullopt;
}

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

std::vector<Expr> decided(std::span<const Expr> outputs, std::span<const Expr> operands, const Expr& winner) {
  std::unordered_map<Expr, Row> rows;
  for (std::size_t i = 0; i < operands.size(); ++i) rows.emplace(operands[i], Row{i, i});
  const auto rowOf = [&](const Expr& e) {
    const auto found = rows.find(e);
    return found == rows.end() ? std::nullopt : std::optional(found->second);
  };
  // What it is if the winner is on either side; elsewhere another comparison leaves this one out.
  const auto decision = [&](const Expr& e) -> std::optional<Expr> {
    if (e.op() != Op::Less && e.op() != Op::LessEqual) return std::nullopt;
    const auto a = rowOf(e.arg(0)), b = rowOf(e.arg(1));
    if (!a || !b) return std::nullopt;
    const auto edge = [](std::size_t place) { return Expr(static_cast<double>(place) - 0.5); };
    if (a->last < b->first) return less(winner, edge(b->first));
    if (b->last < a->first) return less(edge(a->first), winner);
    return std::nullopt;
  };
  std::unordered_map<Expr, Expr> made;
  for (const Expr& e : topologicalOrder(outputs)) {
    if (e.op() == Op::Min) {
      const auto a = rowOf(e.arg(0)), b = rowOf(e.arg(1));
      if (const auto both = a && b ? together(*a, *b) : std::nullopt) rows.emplace(e, *both);
    }
    std::vector<Expr> args;
    for (int i = 0; i < arity(e.op()); ++i) args.push_back(made.at(e.arg(i)));
    const auto known = decision(e);
    made.emplace(e, known ? *known : args.empty() ? e : Expr::make(e.op(), args));
  }
  std::vector<Expr> result;
  for (const Expr& e : outputs) result.push_back(made.at(e));
  return result;
}

}  // namespace sdf::viewer
