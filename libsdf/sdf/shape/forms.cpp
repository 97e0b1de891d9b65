#include "sdf/shape/forms.h"

#include <array>

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
  if (e.op() != Op::Neg && e.op() != Op::Add && e.op() != Op::Sub && e.op() != Op::Mul) return {};
  const auto a = linearGradient(e.arg(0));
  if (!a) return {};
  if (e.op() == Op::Neg) return scaled(*a, -1.0);
  const auto b = linearGradient(e.arg(1));
  if (!b) return {};
  if (e.op() == Op::Add) return *a + *b;
  if (e.op() == Op::Sub) return *a - *b;
  if (isUniform(e.arg(0))) return scaled(*b, e.arg(0));
  return isUniform(e.arg(1)) ? std::optional(scaled(*a, e.arg(1))) : std::nullopt;
}

}  // namespace sdf
