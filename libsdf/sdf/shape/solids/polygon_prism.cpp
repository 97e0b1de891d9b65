#include "sdf/shape/solids/polygon_prism.h"

#include <algorithm>

#include "sdf/expr/gradient.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/placed.h"

namespace sdf {
namespace {

// |z| - h, as extrude() builds it.
std::optional<Expr> lidOf(const std::vector<Expr>& nodes) {
  const auto lid = std::ranges::find_if(nodes, [](const Expr& e) {
    return e.op() == Op::Sub && e.arg(0).op() == Op::Abs && isUniform(e.arg(1));
  });
  return lid == nodes.end() ? std::nullopt : std::optional(*lid);
}

// The payload, and products of it and what does not depend on space, which scaling a flat shape leaves.
std::vector<Expr> sidesIn(const std::vector<Expr>& nodes, const Expr& payload) {
  std::vector<Expr> sides{payload};
  for (const Expr& e : nodes)
    if (e.op() == Op::Mul && e != payload && withoutFactor(e) == payload) sides.push_back(e);
  return sides;
}

}  // namespace

// Equal nodes are the same node: what extrude() would build of the two distances must be f itself.
std::optional<PlacedPrism> placedPrism(Expr f) {
  f = withoutFactor(f);
  const std::vector<Expr> nodes = topologicalOrder({&f, 1});
  const auto payload = std::ranges::find(nodes, Op::Payload, &Expr::op);
  const std::optional<Expr> lid = lidOf(nodes);
  if (payload == nodes.end() || !lid || payload->payloadPart()->part != 0) return {};
  auto field = std::dynamic_pointer_cast<const PolygonField>(payload->payloadPart()->payload);
  const auto isPrism = [&](const Expr& side) {
    return withoutClaims(std::array{boxDistance(side, *lid)}).front() == f;
  };
  if (!field || std::ranges::none_of(sidesIn(nodes, *payload), isPrism)) return {};
  PlacedPrism prism{std::move(field), lid->arg(1), {payload->arg(0), payload->arg(1), lid->arg(0).arg(0)}};
  if (!std::ranges::all_of(prism.at, isLinear)) return {};
  return prism;
}

}  // namespace sdf
