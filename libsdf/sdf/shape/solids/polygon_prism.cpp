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

}  // namespace

// Equal nodes are the same node: what extrude() would build of the two distances must be f itself.
std::optional<PlacedPrism> placedPrism(Expr f) {
  f = withoutFactor(f);
  const std::vector<Expr> nodes = topologicalOrder({&f, 1});
  const auto side = std::ranges::find(nodes, Op::Payload, &Expr::op);
  const std::optional<Expr> lid = lidOf(nodes);
  if (side == nodes.end() || !lid || side->payloadPart()->part != 0) return {};
  auto field = std::dynamic_pointer_cast<const PolygonField>(side->payloadPart()->payload);
  if (!field || withoutClaims(std::array{boxDistance(*side, *lid)}).front() != f) return {};
  PlacedPrism prism{std::move(field), lid->arg(1), {side->arg(0), side->arg(1), lid->arg(0).arg(0)}};
  if (!std::ranges::all_of(prism.at, isLinear)) return {};
  return prism;
}

}  // namespace sdf
