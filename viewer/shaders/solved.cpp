#include "viewer/shaders/solved.h"

#include <cmath>

#include "sdf/expr/gradient.h"

namespace sdf::viewer {
namespace {

/// scale * sqrt(square) + offset, where only `square` depends on space.
struct RootForm {
  Expr square, scale = 1.0, offset = 0.0;
};

std::optional<RootForm> rootFormOf(const Expr& claimed) {
  const Expr& e = claimed.unclaimed();
  if (e.op() == Op::Sqrt) return RootForm{e.arg(0)};
  const OpInfo& op = info(e.op());
  if (op.arity != 2 || op.linearity == Linearity::Nonlinear) return std::nullopt;
  const int place = dependsOnSpace(e.arg(1)) ? 1 : 0;
  const Expr& held = e.arg(1 - place);
  if (place == 1 && (op.symmetry == Symmetry::Ordered || dependsOnSpace(held))) return std::nullopt;
  std::optional<RootForm> form = rootFormOf(e.arg(place));
  if (!form) return form;
  form->offset = Expr::make(e.op(), std::array{form->offset, held});
  if (op.linearity != Linearity::Linear) form->scale = Expr::make(e.op(), std::array{form->scale, held});
  return form;
}

// k > 0 if that is the gradient of k |p - c|^2 + e: its second derivatives are 2k along the axes and 0
// across, but for what turning rounds.
std::optional<double> curvatureOf(const Vec3E& gradient) {
  const Expr* const slopes[] = {&gradient.x, &gradient.y, &gradient.z};
  double bend[3][3];
  for (int i = 0; i < 3; ++i) {
    const Vec3E second = gradientOf(*slopes[i]);
    const Expr* const row[] = {&second.x, &second.y, &second.z};
    for (int j = 0; j < 3; ++j) {
      if (!row[j]->isConstant()) return {};
      bend[i][j] = row[j]->constantValue();
    }
  }
  const double k = 0.5 * bend[0][0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(bend[i][j] - (i == j ? 2.0 * k : 0.0)) <= 1e-12 * k)) return {};
  return k > 0.0 ? std::optional(k) : std::nullopt;
}

}  // namespace

std::optional<HalfSpace> halfSpaceOf(const Shape& shape, const NumberedOperand& operand) {
  if (shape.outer) return {};
  const Expr& distance = shape.distance;
  const Vec3E g = gradientOf(distance);
  if (dependsOnSpace(g.x) || dependsOnSpace(g.y) || dependsOnSpace(g.z)) return {};
  const Expr steep = length(g), once = steep.isConstant(1.0) ? Expr(1.0) : 1.0 / steep;
  return HalfSpace{operand, distance * once, dot(g, normal()) * once};
}

std::optional<Ball> ballOf(const Shape& shape) {
  if (shape.outer) return {};
  const auto form = rootFormOf(shape.distance);
  if (!form || !(form->scale.range().lo > 0.0)) return {};
  const Vec3E gradient = gradientOf(form->square);
  const auto k = curvatureOf(gradient);
  if (!k) return {};
  const auto at = [](const Expr& e, const std::array<Expr, 3>& p) { return remap(e, p, 1.0); };
  const std::array<Expr, 3> zero{0.0, 0.0, 0.0};
  const auto centre = [&](const Expr& slope) { return at(slope, zero) * (-0.5 / *k); };
  const Vec3E c{centre(gradient.x), centre(gradient.y), centre(gradient.z)};
  const Expr least = at(form->square, {c.x, c.y, c.z}), root = max(0.0, -form->offset / form->scale);
  return Ball{c, (square(root) - least) / *k};
}

}  // namespace sdf::viewer
