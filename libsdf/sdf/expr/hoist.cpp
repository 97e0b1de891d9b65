#include "sdf/expr/hoist.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sdf {
namespace {

// Of two values of one function that keeps their order, the place of the argument in which they differ.
std::optional<int> difference(const Expr& a, const Expr& b) {
  const Increasing increasing = info(a.op()).increasing;
  if (a.op() != b.op() || increasing == Increasing::Unstated) return std::nullopt;
  if (arity(a.op()) == 1) return 0;
  for (int held = increasing == Increasing::First ? 1 : 0; held < 2; ++held)
    if (a.arg(held) == b.arg(held) &&
        (increasing != Increasing::BothIfPositive || a.arg(held).range().lo >= 0.0))
      return 1 - held;
  return std::nullopt;
}

Expr chosen(Op choice, const Expr& a, const Expr& b) {
  const std::optional<int> place = difference(a, b);
  if (!place) return Expr::make(choice, std::array{a, b});
  std::vector<Expr> args;
  for (int i = 0; i < arity(a.op()); ++i)
    args.push_back(i == *place ? chosen(choice, a.arg(i), b.arg(i)) : a.arg(i));
  return Expr::make(a.op(), args);
}

// A length of which e is a part?
bool isLengthWith(const Expr& e, const Expr& length) {
  if (length.op() != Op::Sqrt || length.arg(0).op() != Op::Add) return false;
  const Expr &part = e.op() == Op::Neg ? e.arg(0) : e, &sum = length.arg(0);
  const Expr &a = sum.arg(0), &b = sum.arg(1);
  return a.op() == Op::Square && b.op() == Op::Square && (a.arg(0) == part || b.arg(0) == part);
}

Expr isLessEqual(const Expr& a, const Expr& b) {
  const std::optional<int> place = difference(a, b);
  return place ? isLessEqual(a.arg(*place), b.arg(*place)) : lessEqual(a, b);
}

// Longer lists are joined as they come: a look at all pairs would take too long.
constexpr std::size_t kMostOperands = 64;

// The least (or greatest) of all, those of one function joined first.
Expr chosen(Op choice, const std::vector<Expr>& operands) {
  std::vector<Expr> groups;
  for (const Expr& e : operands) {
    const auto like = std::find_if(groups.begin(), groups.end(),
                                   [&](const Expr& g) { return difference(g, e).has_value(); });
    if (like == groups.end())
      groups.push_back(e);
    else
      *like = chosen(choice, *like, e);
  }
  for (; groups.size() > 1; groups.pop_back()) groups.front() = chosen(choice, groups.front(), groups.back());
  return groups.front();
}

}  // namespace

Expr hoisted(const Expr& e) {
  std::unordered_map<Expr, std::vector<Expr>> lists;  // what a minimum of minima takes the least of
  const auto operands = [&](const Expr& node, const Expr& made, Op choice) {
    const auto list = node.op() == choice ? lists.find(node) : lists.end();
    return list == lists.end() ? std::vector{made} : list->second;
  };
  const auto hoist = [&](const Expr& node, std::span<const Expr> args) -> std::optional<Expr> {
    if (!isMinOrMax(node.op())) return std::nullopt;
    if (node.op() == Op::Max && isLengthWith(args[0], args[1])) return args[1];
    std::vector<Expr> all = operands(node.arg(0), args[0], node.op());
    const std::vector<Expr> more = operands(node.arg(1), args[1], node.op());
    if (all.size() + more.size() > kMostOperands) return chosen(node.op(), args[0], args[1]);
    all.insert(all.end(), more.begin(), more.end());
    return chosen(node.op(), lists[node] = std::move(all));
  };
  return rewrite(withoutClaims({&e, 1}), hoist).front();
}

Expr indexOfMin(std::span<const Expr> values, std::span<const Expr> numbers) {
  Expr least = hoisted(values.front()), number = numbers.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Expr value = hoisted(values[i]);
    number = select(isLessEqual(value, least), numbers[i], number);
    least = chosen(Op::Min, least, value);
  }
  return number;
}

}  // namespace sdf
