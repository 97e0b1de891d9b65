#include "sdf/expr/hoist.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sdf {
namespace {

/// Two values of one function that keeps their order: its arguments, and how it is made of another.
struct Common {
  Expr a, b;
  Op op;
  std::optional<Expr> term;  // what else it is made of,
  int place = 0;             // and as which argument
};

Common commonWith(const Expr& a, const Expr& b, int place) {
  return {a.arg(1 - place), b.arg(1 - place), a.op(), a.arg(place), place};
}

std::optional<Common> common(const Expr& a, const Expr& b) {
  if (a.op() != b.op()) return std::nullopt;
  switch (a.op()) {
    case Op::Sqrt:
      return Common{a.arg(0), b.arg(0), Op::Sqrt, std::nullopt};
    case Op::Sub:
      if (a.arg(1) == b.arg(1)) return commonWith(a, b, 1);
      break;
    case Op::Add:
    case Op::Mul:
      for (const int place : {0, 1})
        if (a.arg(place) == b.arg(place) && (a.op() == Op::Add || a.arg(place).range().lo >= 0.0))
          return commonWith(a, b, place);
      break;
    default:
      break;
  }
  return std::nullopt;
}

Expr chosen(Op choice, const Expr& a, const Expr& b) {
  const std::optional<Common> g = common(a, b);
  if (!g) return Expr::make(choice, std::array{a, b});
  const Expr inner = chosen(choice, g->a, g->b);
  if (!g->term) return Expr::make(g->op, std::array{inner});
  return Expr::make(g->op, g->place == 0 ? std::array{*g->term, inner} : std::array{inner, *g->term});
}

Expr isLessEqual(const Expr& a, const Expr& b) {
  const std::optional<Common> g = common(a, b);
  return g ? isLessEqual(g->a, g->b) : lessEqual(a, b);
}

// Longer lists are joined as they come: a look at all pairs would take too long.
constexpr std::size_t kMostOperands = 64;

// The least (or greatest) of all, those of one function joined first.
Expr chosen(Op choice, const std::vector<Expr>& operands) {
  std::vector<Expr> groups;
  for (const Expr& e : operands) {
    const auto like = std::find_if(groups.begin(), groups.end(), [&](const Expr& g) { return common(g, e); });
    if (like == groups.end())
      groups.push_back(e);
    else
      *like = chosen(choice, *like, e);
  }
  for (; groups.size() > 1; groups.pop_back()) groups.front() = chosen(choice, groups.front(), groups.back());
  return groups.front();
}

class Hoister {
 public:
  std::optional<Expr> operator()(const Expr& node, std::span<const Expr> args) {
    if (node.op() != Op::Min && node.op() != Op::Max) return std::nullopt;
    std::vector<Expr> all = operands(node.arg(0), args[0], node.op());
    const std::vector<Expr> more = operands(node.arg(1), args[1], node.op());
    if (all.size() + more.size() > kMostOperands) return chosen(node.op(), args[0], args[1]);
    all.insert(all.end(), more.begin(), more.end());
    return chosen(node.op(), operands_[node] = std::move(all));
  }

 private:
  // What a minimum of minima takes the least of.
  std::vector<Expr> operands(const Expr& e, const Expr& done, Op choice) const {
    const auto list = e.op() == choice ? operands_.find(e) : operands_.end();
    return list == operands_.end() ? std::vector{done} : list->second;
  }

  std::unordered_map<Expr, std::vector<Expr>> operands_;
};

}  // namespace

Expr hoisted(const Expr& e) {
  Hoister hoister;
  return rewrite(withoutClaims({&e, 1}), std::ref(hoister)).front();
}

Expr numberOfLeast(std::span<const Expr> values, std::span<const Expr> numbers) {
  Expr least = hoisted(values.front()), number = numbers.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const Expr value = hoisted(values[i]);
    number = select(isLessEqual(value, least), numbers[i], number);
    least = chosen(Op::Min, least, value);
  }
  return number;
}

}  // namespace sdf
