#include "viewer/shaders/filter.h"

#include <optional>

#include "sdf/base/box.h"
#include "sdf/expr/gradient.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace {

Expr pixelTerm(const std::string& term) {
  return Expr::parameter({hidden(term), 0.0, -kInfinity, kInfinity});
}

// a * b, of which gradients leave much 0.
Expr product(const Expr& a, const Expr& b) { return a.isConstant(0.0) ? a : a.isConstant(1.0) ? b : a * b; }
Expr sum(const Expr& a, const Expr& b) { return a.isConstant(0.0) ? b : b.isConstant(0.0) ? a : a + b; }

// How far u runs within the pixel. A step e across the ray of direction d moves the point seen by
// e - d (e.n) / (d.n), so u by e.h with h = grad u - n (grad u.d) / (d.n), which is across the ray itself.
// pixelWay is d / (d.n).
Expr width(const Expr& u) {
  const Vec3E g = gradientOf(u), n = normal();
  const Expr fall = sum(sum(product(g.x, pixelTerm("pixelWay.x")), product(g.y, pixelTerm("pixelWay.y"))),
                        product(g.z, pixelTerm("pixelWay.z")));
  return pixelTerm("pixelSize") * length(Vec3E(g.x - n.x * fall, g.y - n.y * fall, g.z - n.z * fall));
}

// The mean of the wave that is 1 where floor(u) is even and -1 where it is odd. Of a box no longer than a
// square it is told by how near the next edge is, which is exact where there is none; else by the
// difference of the wave's integral, a triangle.
Expr wave(const Expr& u) {
  // Halves are multiplied by, since shaders divide slowly.
  const auto rest = [](const Expr& x) { return x - 2.0 * floor(0.5 * x); };
  const Expr w = width(u), once = 1.0 / w, sharp = 1.0 - 2.0 * rest(floor(u));
  const Expr near = sharp * min(1.0, 2.0 * abs(u - round(u)) * once);
  const auto integral = [&](const Expr& x) { return 1.0 - abs(rest(x) - 1.0); };
  return select(lessEqual(w, 1.0), near, (integral(u + 0.5 * w) - integral(u - 0.5 * w)) * once);
}

Expr share(const Expr& sharp, const Expr& mean, const Expr& width) {
  return select(less(0.0, width), clamp(0.5 - 0.5 * mean, 0.0, 1.0), sharp);
}

// Of mod(floor(u), 2) or mod(floor(u) + floor(v), 2): on which share of the pixel it is 1.
std::optional<Expr> shareOfOdd(const Expr& e) {
  if (e.op() != Op::Mod || !e.arg(1).isConstant(2.0)) return {};
  const Expr sum = e.arg(0);
  if (sum.op() == Op::Floor) return share(e, wave(sum.arg(0)), width(sum.arg(0)));
  if (sum.op() != Op::Add || sum.arg(0).op() != Op::Floor || sum.arg(1).op() != Op::Floor) return {};
  const Expr u = sum.arg(0).arg(0), v = sum.arg(1).arg(0);
  return share(e, wave(u) * wave(v), min(width(u), width(v)));
}

}  // namespace

Filtered filtered(std::span<const Expr> outputs) {
  Filtered result;
  result.outputs = rewrite(withoutClaims(outputs), [&](const Expr& e, std::span<const Expr> args) {
    std::optional<Expr> share = e.op() == Op::Select ? shareOfOdd(e.arg(0)) : std::nullopt;
    if (!share) return share;
    result.changed = true;
    return std::optional(mix(args[2], args[1], *share));
  });
  return result;
}

}  // namespace sdf::viewer
