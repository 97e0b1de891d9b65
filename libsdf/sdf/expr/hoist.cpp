#include "sdf/expr/hoist.h"

#include <array>
#include <optional>
#include <unordered_map>

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

}  // namespace

Expr hoisted(const Expr& e) {
  std::unordered_map<Expr, Expr> done;
  for (const Expr& node : topologicalOrder({&e, 1})) {
    std::array<Expr, 3> args;
    const int count = arity(node.op());
    bool same = true;
    for (int i = 0; i < count; ++i) {
      args[i] = done.at(node.arg(i));
      same = same && args[i] == node.arg(i);
    }
    if (node.op() == Op::Min || node.op() == Op::Max)
      done.emplace(node, chosen(node.op(), args[0], args[1]));
    else
      done.emplace(node, same ? node : Expr::make(node.op(), {args.data(), static_cast<std::size_t>(count)}));
  }
  return done.at(e);
}

}  // namespace sdf
