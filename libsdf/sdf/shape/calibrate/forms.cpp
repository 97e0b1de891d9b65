#include "sdf/shape/calibrate/forms.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/base/box.h"
#include "sdf/expr/gradient.h"
#include "sdf/shape/formula.h"

namespace sdf {

namespace {

// The terms of a chain of sums.
void addTerms(const Expr& e, std::vector<Expr>& terms) {
  if (e.unclaimed().op() != Op::Add) return terms.push_back(e.unclaimed());
  addTerms(e.unclaimed().arg(0), terms);
  addTerms(e.unclaimed().arg(1), terms);
}

}  // namespace

bool isBeyond(const Expr& e) {
  if (e.op() != Op::Sub) return false;
  const Expr& clamped = e.arg(1).unclaimed();
  if (clamped.op() != Op::Min || clamped.arg(0).unclaimed().op() != Op::Max) return false;
  return clamped.arg(0).unclaimed().arg(0).unclaimed() == e.arg(0).unclaimed();
}

std::vector<Expr> partsOfLength(const Expr& e) {
  std::vector<Expr> parts;
  if (e.op() != Op::Sqrt) return parts;
  addTerms(e.arg(0), parts);
  for (Expr& part : parts) {
    if (part.op() != Op::Square) return {};
    part = Expr(part.arg(0));
  }
  return parts.size() == 2 || parts.size() == 3 ? parts : std::vector<Expr>{};
}

std::vector<Expr> partsOfBox(const Expr& e) {
  if (e.op() != Op::Add) return {};
  std::vector<Expr> parts = partsOfLength(e.arg(0).unclaimed());
  for (Expr& part : parts) {
    if (!isMaxWithZero(part.unclaimed())) return {};
    part = Expr(part.unclaimed().arg(0));
  }
  if (parts.empty()) return {};
  const std::vector<Expr> both = withoutClaims(std::array{e, boxDistance(parts, 0.0)});
  return both[0] == both[1] ? parts : std::vector<Expr>{};
}

std::optional<Vec3E> linearGradient(const Expr& claimed) {
  const Expr& e = claimed.unclaimed();
  if (isUniform(e)) return Vec3E(0.0);
  if (e.op() == Op::Variable) return gradientOf(e);
  const Linearity linearity = info(e.op()).linearity;
  if (linearity != Linearity::Linear && linearity != Linearity::Bilinear) return {};
  const int last = arity(e.op()) - 1;
  const auto a = linearGradient(e.arg(0)), b = a && last > 0 ? linearGradient(e.arg(last)) : a;
  if (!b) return {};
  if (linearity == Linearity::Linear) {
    const auto along = [&](const Expr& u, const Expr& v) {
      return Expr::make(e.op(), std::span<const Expr>(std::array{u, v}).first(last + 1));
    };
    return Vec3E(along(a->x, b->x), along(a->y, b->y), along(a->z, b->z));
  }
  if (isUniform(e.arg(0))) return scaled(*b, e.arg(0));
  return isUniform(e.arg(1)) ? std::optional(scaled(*a, e.arg(1))) : std::nullopt;
}

namespace {

// The coordinate that a part of a length is, or is the distance from 0 or from a segment of, else nothing.
// Where it has a kink, the part is 0.
std::optional<glm::dvec3> coordinateOf(const Expr& part, bool isCut) {
  const Expr& e = part.unclaimed();
  if (e.op() == Op::Abs || isBeyond(e)) return coordinateOf(e.arg(0), false);
  if (isCut && e.op() == Op::Sub && isUniform(e.arg(1)) && e.arg(1).range().lo >= 0.0)
    return coordinateOf(e.arg(0), false);
  const auto n = linearGradient(e);
  if (!n || !n->x.range().isPoint() || !n->y.range().isPoint() || !n->z.range().isPoint()) return {};
  return glm::dvec3(n->x.range().lo, n->y.range().lo, n->z.range().lo);
}

// Are they at right angles to each other, and of length 1?
bool areOrthonormal(std::span<const glm::dvec3> v) {
  constexpr double kRounding = 1e-12;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k)
      if (std::abs(glm::dot(v[i], v[k]) - (i == k ? 1.0 : 0.0)) > kRounding) return false;
  return true;
}

// A bound of the second derivative is 1 / r with r the less of both; `inner` is infinite for coordinates.
struct Radii {
  Expr outer, inner;
};

// The coordinates that the function depends on are added to `along`.
std::optional<Radii> curvatureRadii(const Expr& claimed, std::vector<glm::dvec3>& along) {
  const Expr& e = claimed.unclaimed();
  const bool moved = e.op() == Op::Sub || e.op() == Op::Add;
  if (moved && isUniform(e.arg(1))) return curvatureRadii(e.arg(0), along);
  if (moved && isUniform(e.arg(0))) return curvatureRadii(e.arg(1), along);
  if (e.op() == Op::Neg) return curvatureRadii(e.arg(0), along);
  const std::vector<Expr> sides = partsOfBox(e);
  const std::vector<Expr> parts = sides.empty() ? partsOfLength(e) : sides;
  if (parts.empty()) return {};
  // The length of a has the second derivative (1 - n n^T) / |a| along the parts' gradients, and at right
  // angles to them and to each other those of the parts times a_i / |a|, which is at most 1.
  Radii result{sides.empty() ? claimed : max(claimed, 0.0), kInfinity};
  for (const Expr& part : parts) {
    const Expr& p = part.unclaimed();
    const bool isCut = sides.empty() && isMaxWithZero(p);
    const Expr& inner = isCut ? p.arg(0) : part;
    if (const auto n = coordinateOf(inner, isCut || !sides.empty())) {
      along.push_back(*n);
    } else {
      const auto radii = curvatureRadii(inner, along);
      if (!radii) return {};
      for (const Expr& r : {radii->outer, radii->inner})
        if (!r.isConstant()) result.inner = result.inner.isConstant() ? r : min(result.inner, r);
    }
  }
  return result;
}

}  // namespace

std::optional<Expr> innerRadius(const Expr& e) {
  std::vector<glm::dvec3> along;
  if (partsOfLength(e.unclaimed()).empty() && partsOfBox(e.unclaimed()).empty()) return {};
  const auto radii = curvatureRadii(e, along);
  return radii && areOrthonormal(along) ? std::optional(radii->inner) : std::nullopt;
}

}  // namespace sdf
