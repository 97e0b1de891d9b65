#include "viewer/shaders/filter.h"

#include <optional>
#include <unordered_map>

#include "sdf/base/box.h"
#include "sdf/expr/gradient.h"

namespace sdf::viewer {
namespace {

// One of the pixel's vectors, as parameters that the writer knows to be GLSL's.
Vec3E pixelVector(const std::string& name, GlslWriter& writer) {
  const auto part = [&](const char* axis) {
    const std::string term = name + "." + axis;
    writer.substitute(term, term);
    return Expr::parameter({term, 0.0, -kInfinity, kInfinity});
  };
  return {part("x"), part("y"), part("z")};
}

class Filter {
 public:
  explicit Filter(GlslWriter& writer)
      : across_(pixelVector("pixelAcross", writer)), along_(pixelVector("pixelAlong", writer)) {}

  Filtered run(std::span<const Expr> outputs) {
    Filtered result;
    for (const Expr& e : topologicalOrder(outputs)) {
      std::vector<Expr> args;
      for (int i = 0; i < arity(e.op()); ++i) args.push_back(made_.at(e.arg(i)));
      const std::optional<Expr> share = e.op() == Op::Select ? shareOfOdd(e.arg(0)) : std::nullopt;
      result.changed = result.changed || share;
      made_.emplace(e, share ? mix(args[2], args[1], *share) : args.empty() ? e : Expr::make(e.op(), args));
    }
    for (const Expr& e : outputs) result.outputs.push_back(made_.at(e));
    return result;
  }

 private:
  // Of mod(floor(u), 2) or mod(floor(u) + floor(v), 2): on which share of the pixel it is 1.
  std::optional<Expr> shareOfOdd(const Expr& e) const {
    if (e.op() != Op::Mod || !e.arg(1).isConstant(2.0)) return {};
    const Expr sum = e.arg(0);
    if (sum.op() == Op::Floor) return share(e, wave(sum.arg(0)), width(sum.arg(0)));
    if (sum.op() != Op::Add || sum.arg(0).op() != Op::Floor || sum.arg(1).op() != Op::Floor) return {};
    const Expr u = sum.arg(0).arg(0), v = sum.arg(1).arg(0);
    return share(e, wave(u) * wave(v), min(width(u), width(v)));
  }

  static Expr share(const Expr& sharp, const Expr& mean, const Expr& width) {
    return select(less(0.0, width), clamp(0.5 - 0.5 * mean, 0.0, 1.0), sharp);
  }

  // How far u runs within the pixel, an ellipse with these axes.
  Expr width(const Expr& u) const {
    const Vec3E g = gradientOf(u);
    return sqrt(square(dot(g, across_)) + square(dot(g, along_)));
  }

  // The mean of the wave that is 1 where floor(u) is even and -1 where it is odd. Of a box no longer than a
  // square it is told by how near the next edge is, which is exact where there is none; else by the
  // difference of the wave's integral, a triangle.
  Expr wave(const Expr& u) const {
    const Expr w = width(u), sharp = 1.0 - 2.0 * mod(floor(u), 2.0);
    const Expr near = sharp * min(1.0, 2.0 * abs(u - round(u)) / w);
    const auto integral = [](const Expr& x) { return 1.0 - abs(mod(x, 2.0) - 1.0); };
    return select(lessEqual(w, 1.0), near, (integral(u + 0.5 * w) - integral(u - 0.5 * w)) / w);
  }

  Vec3E across_, along_;
  std::unordered_map<Expr, Expr> made_;
};

}  // namespace

Filtered filtered(std::span<const Expr> outputs, GlslWriter& writer) { return Filter(writer).run(outputs); }

}  // namespace sdf::viewer
