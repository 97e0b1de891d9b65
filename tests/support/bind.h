// Expressions with some of their parameters fixed.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>

#include "sdf/expr/expr.h"

namespace sdf::test {

/// The expression with parameters of these names as constants of these values. Claims carry over where the
/// values lie in their parameters' ranges, for which they hold.
inline Expr bind(const Expr& e, const std::map<std::string, double>& values) {
  const auto isBound = [&](const Expr& n) {
    return n.op() == Op::Parameter && values.contains(n.parameterInfo().name);
  };
  bool covered = true;
  for (const Expr& n : topologicalOrder({&e, 1}))
    if (isBound(n) && !n.range().contains(values.at(n.parameterInfo().name))) covered = false;
  return rewrite(e, [&](const Expr& n, std::span<const Expr> args) -> std::optional<Expr> {
    if (isBound(n)) return values.at(n.parameterInfo().name);
    if (n.op() == Op::Claim && covered) return args[0].claimLipschitz(n.lipschitz());
    return std::nullopt;
  });
}

}  // namespace sdf::test
