#include "viewer/shaders/unsteady.h"

#include <span>

#include "sdf/eval/rounding.h"
#include "sdf/shape/operators/booleans.h"

namespace sdf::viewer {
namespace {

constexpr double kOfSize = 0x1p-14;
constexpr double kSeen = 80.0;  // where there are no bounds: what views see by themselves

void add(const Shape& shape, std::vector<Expr>& nodes) {
  if (shape.outer) {
    for (const Shape& operand : shape.outer->operands) add(operand, nodes);
    return;
  }
  const Box box =
      shape.bounds.finite() ? shape.bounds : intersect(shape.bounds, Box::centred(glm::dvec3(kSeen)));
  if (box.empty()) return;
  std::vector<Expr> outputs{shape.distance};
  for (const Expr& e : shape.surface)
    if (!e.isConstant() && dependsOnSpace(e)) outputs.push_back(e);
  const Accuracy accuracy{box, kOfSize * box.longestSide()};
  // Shaders are written with and without claims.
  for (const std::vector<Expr>& all : {outputs, withoutClaims(outputs)}) {
    const std::vector<Expr> exact = exactNodes(all, accuracy);
    if (exact.empty()) return;
    nodes.insert(nodes.end(), exact.begin(), exact.end());
  }
}

}  // namespace

std::vector<Unsteady> unsteadyOf(const Scene& scene) {
  std::vector<Unsteady> all;
  for (const Part& part : scene.parts) {
    Unsteady one{&part, {}};
    add(part.shape, one.nodes);
    if (!one.nodes.empty()) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace sdf::viewer
