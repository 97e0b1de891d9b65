#include "sdf/mesh/certify_reading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

using Slopes = PatchReading::Slopes;
using Term = PatchReading::Term;

constexpr int kPlace[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};  // of a second derivative in Term::h

double upwards(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// What both contain; the first where rounding has left nothing.
Interval common(const Interval& a, const Interval& b) {
  const Interval both(std::max(a.lo, b.lo), std::min(a.hi, b.hi), a.nan);
  return both.lo <= both.hi ? both : a;
}

Term constantTerm(double v) { return {constant<Interval, 3>(Interval(v)), {}, true, false}; }

// Second derivatives of g(a), given g' and g''.
void chainCurvature(const Term& a, const Interval& first, const Interval& second, Term& r) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      r.h[kPlace[i][j]] = add(mul(first, a.h[kPlace[i][j]]),
                              mul(second, i == j ? square(a.f.d[i]) : mul(a.f.d[i], a.f.d[j])));
}

void productCurvature(const Term& a, const Term& b, Term& r) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      r.h[kPlace[i][j]] = add(add(mul(a.f.v, b.h[kPlace[i][j]]), mul(b.f.v, a.h[kPlace[i][j]])),
                              add(mul(a.f.d[i], b.f.d[j]), mul(a.f.d[j], b.f.d[i])));
}

void addCurvature(const Term& a, const Term& b, const Interval& factor, Term& r) {
  for (int k = 0; k < 6; ++k) r.h[k] = add(a.h[k], mul(factor, b.h[k]));
}

struct Derivatives {
  Interval first, second;
};

// Of the smooth operations of one argument, and of abs where its argument keeps its sign.
std::optional<Derivatives> derivatives(Op op, const Interval& a) {
  switch (op) {
    case Op::Neg:
      return Derivatives{-1.0, 0.0};
    case Op::Square:
      return Derivatives{add(a, a), 2.0};
    case Op::Sin:
      return Derivatives{cos(a), neg(sin(a))};
    case Op::Cos:
      return Derivatives{neg(sin(a)), neg(cos(a))};
    case Op::Exp:
      return Derivatives{exp(a), exp(a)};
    case Op::Abs:
    case Op::AbsMinus:
      if (a.lo > 0.0) return Derivatives{1.0, 0.0};
      if (a.hi < 0.0) return Derivatives{-1.0, 0.0};
      return std::nullopt;
    case Op::Sqrt: {
      if (!(a.lo > 0.0)) return std::nullopt;
      const Interval half = div(0.5, sqrt(a));
      return Derivatives{half, neg(div(half, add(a, a)))};
    }
    default:
      return std::nullopt;
  }
}

void copyCurvature(const Term& a, Term& r) {
  r.h = a.h;
  r.curved = a.curved;
}

// The arguments of a length, less the point that it is taken from.
struct Components {
  std::array<Term, 3> q;
  int count;
};

template <class Args>
Components componentsOf(Op op, const Args& args) {
  Components c{{args(0), args(1), constantTerm(0.0)}, op == Op::Length2 ? 2 : 3};
  if (c.count == 3) c.q[2] = args(2);
  if (op == Op::Distance3)
    for (int i = 0; i < 3; ++i) c.q[i].f.v = sub(c.q[i].f.v, args(3 + i).f.v);
  return c;
}

bool isLength(Op op) { return op == Op::Length2 || op == Op::Length3 || op == Op::Distance3; }

bool isZero(const Interval& a) { return a.lo == 0.0 && a.hi == 0.0; }

// q / |q|, for one component.
Interval shareOf(const Interval& q, const Interval& length) {
  const Interval sign(q.lo >= 0.0 ? 0.0 : -1.0, q.hi <= 0.0 ? 0.0 : 1.0);
  return length.lo > 0.0 ? common(sign, div(q, length)) : sign;
}

// Slopes of |q|, which are w · dq with w = q / |q|. They are no larger than |dq|, also where the root has a
// vertical tangent; and where all w · dq >= 0 their sum is no less than the least |dq|, for |w| = 1. Where w
// is nearly dq, 2 w · dq = 1 + |dq|² - |w - dq|² is the tighter form.
void narrowLengthSlopes(const Components& c, Slopes& r) {
  Interval squares(0.0);
  for (int i = 0; i < c.count; ++i) squares = add(squares, square(c.q[i].f.v));
  const Interval length = sqrt(squares);
  for (int k = 0; k < 3; ++k) {
    Interval sum(0.0), squared(0.0), apart(0.0);
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < c.count; ++i) {
      const Interval &q = c.q[i].f.v, &d = c.q[i].f.d[k];
      if (isZero(q) && isZero(d)) continue;
      const Interval share = shareOf(q, length);
      sum = add(sum, mul(share, d));
      apart = add(apart, square(sub(share, d)));
      squared = add(squared, square(d));
      least = std::min(least, q.lo >= 0.0 ? d.lo : q.hi <= 0.0 ? -d.hi : 0.0);
    }
    const double most = sqrt(squared).hi;
    r.d[k] = common(common(sum, {-most, most}), mul(0.5, sub(add(1.0, squared), apart)));
    if (least > 0.0 && std::isfinite(least)) r.d[k].lo = std::max(r.d[k].lo, least);
  }
}

// Second derivatives of sqrt(sum of squares).
void lengthCurvature(const Components& c, Term& r) {
  Term sum = constantTerm(0.0);
  for (int i = 0; i < c.count; ++i) {
    const Term& q = c.q[i];
    Term squared = constantTerm(0.0);
    chainCurvature(q, add(q.f.v, q.f.v), 2.0, squared);
    for (int k = 0; k < 6; ++k) sum.h[k] = add(sum.h[k], squared.h[k]);
    sum.f = add(sum.f, square(q.f));
    sum.curved = sum.curved && q.curved;
  }
  const auto root = derivatives(Op::Sqrt, sum.f.v);
  r.curved = sum.curved && root;
  if (r.curved) chainCurvature(sum, root->first, root->second, r);
}

// A box's distance beside one face, |max(q, 0)| + min(q, 0), is q: the operand, where the instruction is
// that. Its parts know nothing of each other, and their sum would have slopes from 0 to 2.
std::optional<Operand> joined(const Tape& tape, const Instruction& sum) {
  const auto isZero = [&](Operand a) { return a.isConstant() && tape.constant(a.index()) == 0.0; };
  const auto made = [&](Operand a, Op op) -> const Instruction* {
    const Instruction* n = a.isValue() ? &tape.instructions()[a.index()] : nullptr;
    return n && n->op == op ? n : nullptr;
  };
  if (sum.op != Op::Add) return std::nullopt;
  for (int k = 0; k < 2; ++k) {
    const Instruction* low = made(sum.in[k], Op::Min);
    Operand rest = sum.in[1 - k];
    if (const Instruction* length = made(rest, Op::AbsMinus);
        length && tape.constant(length->constants) == 0.0)
      rest = length->in[0];
    const Instruction* high = made(rest, Op::Max);
    if (low && high && isZero(low->in[1]) && isZero(high->in[1]) && low->in[0] == high->in[0])
      return low->in[0];
  }
  return std::nullopt;
}

// A quadratic blend of two distances, min(x, y) - c h² or max(x, y) + c h² with h = max(k - |x - y|, 0), in
// units in which 4 c k = 1 (shape/blend.h): its slope is a mean of theirs, w dx + (1 - w) dy.
struct QuadraticBlend {
  Operand x, y;
  double k;
  bool isMin;
};

std::optional<QuadraticBlend> blendOf(const Tape& tape, const Instruction& sum) {
  const auto made = [&](Operand a, Op op) -> const Instruction* {
    const Instruction* n = a.isValue() ? &tape.instructions()[a.index()] : nullptr;
    return n && n->op == op ? n : nullptr;
  };
  const auto number = [&](Operand a) { return tape.constant(a.index()); };
  if (sum.op != Op::MulAdd || !sum.in[1].isConstant()) return std::nullopt;
  const Instruction* squared = made(sum.in[0], Op::Square);
  const Instruction* h = squared ? made(squared->in[0], Op::Max) : nullptr;
  const Instruction* rest =
      h && h->in[1].isConstant() && number(h->in[1]) == 0.0 ? made(h->in[0], Op::Sub) : nullptr;
  const Instruction* apart = rest && rest->in[0].isConstant() ? made(rest->in[1], Op::Abs) : nullptr;
  const Instruction* difference = apart ? made(apart->in[0], Op::Sub) : nullptr;
  if (!difference) return std::nullopt;
  const Instruction *least = made(sum.in[2], Op::Min), *most = made(sum.in[2], Op::Max);
  const Instruction* choice = least ? least : most;
  if (!choice) return std::nullopt;
  const auto& [x, y, unused] = difference->in;
  const bool same = (choice->in[0] == x && choice->in[1] == y) || (choice->in[0] == y && choice->in[1] == x);
  const double k = number(rest->in[0]), c = (least ? -1.0 : 1.0) * number(sum.in[1]);
  // Rounding of the constants bends the blend where x = y by so little that corners' rounding covers it.
  if (!same || !(k > 0.0) || !(std::abs(4.0 * c * k - 1.0) < 0x1p-50)) return std::nullopt;
  return QuadraticBlend{x, y, k, least != nullptr};
}

// Narrows a blend's slopes and gives it its curvature, w d²x + (1 - w) d²y + w' (dx - dy)², where w falls
// from 1 to 0 (rises, of a maximum) by 1 / 2k as x - y goes from -k to k.
void narrowBlend(const QuadraticBlend& blend, const Term& x, const Term& y, bool wantCurvature, Term& r) {
  const Interval t = div(sub(x.f.v, y.f.v), mul(2.0, Interval(blend.k)));
  Interval w = blend.isMin ? sub(0.5, t) : add(0.5, t);
  // Of the constants' rounding; w itself never leaves 0 to 1 by more.
  w = {std::clamp(w.lo, 0.0, 1.0) - 0x1p-48, std::clamp(w.hi, 0.0, 1.0) + 0x1p-48, w.nan};
  if (w.nan) return;
  const auto mean = [&](const Interval& a, const Interval& b) { return add(b, mul(w, sub(a, b))); };
  const auto mix = [&](const Interval& a, const Interval& b) {
    // Linear in w for every a and b: the extremes are at its ends.
    const auto at = [&](double share) { return add(mul(share, a), mul(sub(1.0, Interval(share)), b)); };
    return common(hull(at(w.lo), at(w.hi)), mean(a, b));
  };
  for (int k = 0; k < 3; ++k) r.f.d[k] = common(r.f.d[k], mix(x.f.d[k], y.f.d[k]));
  if (!wantCurvature || !x.curved || !y.curved) return;
  const Interval steep = div(1.0, mul(2.0, Interval(blend.k)));
  // Between the ends the blend bends all over, beyond them nowhere.
  constexpr double kEnd = 0x1p-40;
  const Interval share(w.lo > kEnd && w.hi < 1.0 - kEnd ? 1.0 : 0.0,
                       w.hi > kEnd && w.lo < 1.0 - kEnd ? 1.0 : 0.0);
  const Interval bend = mul(blend.isMin ? neg(steep) : steep, share);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const Interval di = sub(x.f.d[i], y.f.d[i]), dj = sub(x.f.d[j], y.f.d[j]);
      const int k = kPlace[i][j];
      r.h[k] = add(mix(x.h[k], y.h[k]), mul(bend, i == j ? square(di) : mul(di, dj)));
    }
  r.curved = true;
}

// Which argument of a min or max gives the value: 0, 1, or -1 where either may.
int winner(Op op, const Interval& a, const Interval& b) {
  if (a.nan || b.nan || !(a.hi < b.lo || b.hi < a.lo)) return -1;
  return (a.hi < b.lo) == (op == Op::Min) ? 0 : 1;
}

template <class Args>
void curvature(Op op, const Args& args, Term& r) {
  r.curved = false;
  if (isLength(op)) return lengthCurvature(componentsOf(op, args), r);
  const Term a = args(0);
  if (op == Op::Claim) return copyCurvature(a, r);
  if (const auto d = derivatives(op, a.f.v)) {
    r.curved = a.curved;
    if (r.curved) chainCurvature(a, d->first, d->second, r);
    return;
  }
  if (op == Op::Select) {
    const bool isFirst = a.f.v.lo > 0.0 || a.f.v.hi < 0.0, isSecond = a.f.v.isPoint() && a.f.v.lo == 0.0;
    if (!a.f.v.nan && (isFirst || isSecond)) copyCurvature(args(isFirst ? 1 : 2), r);
    return;
  }
  if (op != Op::Add && op != Op::Sub && op != Op::Mul && op != Op::MulAdd && op != Op::Div && op != Op::Min &&
      op != Op::Max)
    return;
  const Term b = args(1);
  if (op == Op::Min || op == Op::Max) {
    const int first = winner(op, a.f.v, b.f.v);
    if (first >= 0) copyCurvature(first == 0 ? a : b, r);
    return;
  }
  r.curved = a.curved && b.curved;
  if (!r.curved) return;
  if (op == Op::Add || op == Op::Sub) return addCurvature(a, b, op == Op::Add ? 1.0 : -1.0, r);
  if (op == Op::Mul) return productCurvature(a, b, r);
  if (op == Op::MulAdd) {
    const Term c = args(2);
    r.curved = c.curved;
    productCurvature(a, b, r);
    for (int k = 0; k < 6; ++k) r.h[k] = add(r.h[k], c.h[k]);
    return;
  }
  // a / b is a times 1 / b.
  r.curved = b.f.v.lo > 0.0 || b.f.v.hi < 0.0;
  if (!r.curved) return;
  const Interval one = div(1.0, b.f.v), two = square(one);
  Term inverse{chain(b.f, one, neg(two)), {}, true, false};
  chainCurvature(b, neg(two), mul(2.0, mul(one, two)), inverse);
  productCurvature(a, inverse, r);
}

}  // namespace

Patch Patch::box(const glm::dvec3& centre, const std::array<glm::dvec3, 3>& axes, const glm::dvec3& radius) {
  Patch p;
  for (int i = 0; i < 3; ++i) {
    p.centre_[i] = centre[i];
    p.radius_[i] = radius[i];
    for (int k = 0; k < 3; ++k) p.axes_[k][i] = axes[k][i];
  }
  return p;
}

Patch Patch::triangle(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec2, 3>& part) {
  Patch p;
  p.isTriangle_ = true;
  const Interval third = div(1.0, 3.0);
  Interval middle[2];
  for (int k = 0; k < 2; ++k) middle[k] = mul(third, add(part[0][k], add(part[1][k], part[2][k])));
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < 3; ++c) {
      p.corners_[c][k] = sub(part[c][k], middle[k]);
      p.radius_[k] = std::max(p.radius_[k], p.corners_[c][k].magnitude());
    }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 2; ++k) p.axes_[k][i] = sub(corners[k + 1][i], corners[0][i]);
    p.centre_[i] = add(corners[0][i], add(mul(middle[0], p.axes_[0][i]), mul(middle[1], p.axes_[1][i])));
  }
  return p;
}

Interval Patch::spread(const Interval (&slope)[3]) const {
  if (!isTriangle_) {
    double most = 0.0;
    for (int k = 0; k < 3; ++k)
      if (radius_[k] > 0.0) most = upwards(most + upwards(slope[k].magnitude() * radius_[k]));
    return {-most, most};
  }
  Interval all = add(mul(slope[0], corners_[0][0]), mul(slope[1], corners_[0][1]));
  for (int c = 1; c < 3; ++c)
    all = hull(all, add(mul(slope[0], corners_[c][0]), mul(slope[1], corners_[c][1])));
  return all;
}

PatchReading::Term PatchReading::term(Operand a) const {
  if (a.isConstant()) return constantTerm(tape_->constant(a.index()));
  return a.isVariable() ? variables_[a.index()] : terms_[a.index()];
}

PatchReading::Slopes PatchReading::atCentre(Operand a) const {
  if (a.isConstant()) return constant<Interval, 3>(Interval(tape_->constant(a.index())));
  return a.isVariable() ? centreVariables_[a.index()] : centres_[a.index()];
}

void PatchReading::narrow(const Slopes& centre, const Patch& patch, Term& t) const {
  if (t.curved)
    for (int i = 0; i < 3; ++i) {
      const Interval row[3] = {t.h[kPlace[i][0]], t.h[kPlace[i][1]], t.h[kPlace[i][2]]};
      t.f.d[i] = common(t.f.d[i], add(centre.d[i], patch.spread(row)));
    }
  if (t.clipped) return;  // the way from the centre may leave where the assumptions hold
  const bool isSloped = !centre.v.nan && !t.f.d[0].nan && !t.f.d[1].nan && !t.f.d[2].nan;
  if (isSloped) t.f.v = common(t.f.v, add(centre.v, patch.spread(t.f.d)));
}

// What min, max or abs chooses by.
static std::optional<Assumption> choiceOf(const Tape& tape, const Instruction& n) {
  if (n.op == Op::Min || n.op == Op::Max) {
    if (n.in[1].isConstant() && tape.constant(n.in[1].index()) == 0.0) return Assumption{n.in[0], {}, false};
    return Assumption{n.in[0], n.in[1], false};
  }
  if (n.op != Op::Abs && n.op != Op::AbsMinus) return std::nullopt;
  if (n.in[0].isValue())
    if (const Instruction& of = tape.instructions()[n.in[0].index()]; of.op == Op::Sub)
      return Assumption{of.in[0], of.in[1], false};
  return Assumption{n.in[0], {}, false};
}

const Assumption* PatchReading::known(const Operand& a, const std::optional<Operand>& b) const {
  for (const Assumption& one : assumptions_)
    if (one.a == a && one.b == b) return &one;
  return nullptr;
}

// The term of a choice that is assumed.
bool PatchReading::assume(const Instruction& n, Term& t) const {
  if (assumptions_.empty()) return false;
  const std::optional<Assumption> choice = choiceOf(*tape_, n);
  const Assumption* one = choice ? known(choice->a, choice->b) : nullptr;
  if (!one) return false;
  if (n.op == Op::Min || n.op == Op::Max) {
    const bool first = one->less == (n.op == Op::Min);
    const Interval other = term(n.in[first ? 1 : 0]).f.v;
    t = term(n.in[first ? 0 : 1]);
    (n.op == Op::Min ? t.f.v.hi : t.f.v.lo) =
        n.op == Op::Min ? std::min(t.f.v.hi, other.hi) : std::max(t.f.v.lo, other.lo);
  } else {
    t = term(n.in[0]);
    if (one->less) t.f = neg(t.f);
    t.f.v.lo = std::max(t.f.v.lo, 0.0);
    if (n.op == Op::AbsMinus) t.f.v = sub(t.f.v, Interval(tape_->constant(n.constants)));
  }
  t.curved = false;
  t.clipped = true;
  return true;
}

// Narrows a value by the assumptions that compare it with a constant, or that it is the difference of; false
// where nothing is left.
bool PatchReading::clip(std::size_t at, Term& t) const {
  const Instruction& n = tape_->instructions()[at];
  for (const Assumption& one : assumptions_) {
    const bool isDifference = n.op == Op::Sub && one.b && one.a == n.in[0] && *one.b == n.in[1];
    const bool isFirst = one.a == Operand::value(at) && (!one.b || one.b->isConstant());
    if (!isDifference && !isFirst) continue;
    const double limit = isFirst && one.b ? tape_->constant(one.b->index()) : 0.0;
    (one.less ? t.f.v.hi : t.f.v.lo) = one.less ? std::min(t.f.v.hi, limit) : std::max(t.f.v.lo, limit);
    t.clipped = true;
  }
  return !isImpossible(t);
}

// Do the assumptions leave no value, or but one that the line passes at once?
bool PatchReading::isImpossible(const Term& t) const {
  const Interval &v = t.f.v, &d = t.f.d[along_];
  return t.clipped && (v.lo > v.hi || (v.lo == v.hi && !d.nan && (d.lo > 0.0 || d.hi < 0.0)));
}

// The last choice on the tape that matters and is open.
std::optional<Assumption> PatchReading::openChoice(const Tape& tape) const {
  std::vector<bool> needed(tape.instructions().size(), false);
  const auto need = [&](Operand a) {
    if (a.isValue()) needed[a.index()] = true;
  };
  need(tape.outputs()[0]);
  for (std::size_t at = needed.size(); at-- > 0;) {
    if (!needed[at]) continue;
    const Instruction& n = tape.instructions()[at];
    if (const std::optional<Operand> q = joined(tape, n)) {
      need(*q);
      continue;
    }
    const std::optional<Assumption> choice = choiceOf(tape, n);
    const Assumption* one = choice ? known(choice->a, choice->b) : nullptr;
    const bool picks = n.op == Op::Min || n.op == Op::Max;
    if (choice && !one) {
      const Interval a = term(choice->a).f.v, b = choice->b ? term(*choice->b).f.v : Interval(0.0);
      if (a.hi > b.lo && b.hi > a.lo) return choice;
      if (picks) {
        need(n.in[(a.hi <= b.lo) == (n.op == Op::Min) ? 0 : 1]);
        continue;
      }
    }
    if (one && picks) {
      need(n.in[one->less == (n.op == Op::Min) ? 0 : 1]);
      continue;
    }
    for (int k = 0; k < rowArguments(n.op); ++k) need(n.in[k]);
  }
  return std::nullopt;
}

// Reads the tape; false where the assumptions contradict each other.
bool PatchReading::read(const Tape& tape, const Patch& patch, bool wantCurvature) {
  tape_ = &tape;
  for (int i = 0; i < static_cast<int>(kVariableCount); ++i) {
    Term& x = variables_[i];
    x = {constant<Interval, 3>(Interval(-1.0, 1.0)), {}, true, false};
    if (i < 3) {
      x.f.v = patch.centre()[i];
      for (int k = 0; k < 3; ++k) x.f.d[k] = patch.axes()[k][i];
    }
    centreVariables_[i] = x.f;
    if (i < 3) x.f.v = add(x.f.v, patch.spread(x.f.d));
  }
  const std::size_t count = tape.instructions().size();
  terms_.resize(count);
  centres_.resize(count);
  for (std::size_t at = 0; at < count; ++at) {
    const Instruction& n = tape.instructions()[at];
    Term& t = terms_[at];
    if (const std::optional<Operand> q = joined(tape, n)) {
      t = term(*q);
      centres_[at] = atCentre(*q);
      continue;
    }
    const int rows = rowArguments(n.op);
    const PayloadPart* payload = tape.payload(n);
    const auto args = [&](int k) {
      return k < rows ? term(n.in[k]) : constantTerm(tape.constant(n.constants + k - rows));
    };
    if (!assume(n, t)) {
      centres_[at] = evaluateOp<Slopes>(n.op, payload, [&](int k) {
        return k < rows ? atCentre(n.in[k])
                        : constant<Interval, 3>(Interval(tape.constant(n.constants + k - rows)));
      });
      t.f = evaluateOp<Slopes>(n.op, payload, [&](int k) { return args(k).f; });
      t.curved = false;
      t.clipped = false;
      for (int k = 0; k < rows && !assumptions_.empty(); ++k) t.clipped = t.clipped || term(n.in[k]).clipped;
      if (isLength(n.op)) narrowLengthSlopes(componentsOf(n.op, args), t.f);
      if (wantCurvature && !payload) curvature(n.op, args, t);
      if (const std::optional<QuadraticBlend> blend = blendOf(tape, n))
        narrowBlend(*blend, term(blend->x), term(blend->y), wantCurvature, t);
      narrow(centres_[at], patch, t);
    }
    if (!assumptions_.empty() && !clip(at, t)) return false;
  }
  return true;
}

PatchBounds PatchReading::run(const Tape& tape, const Patch& patch, bool curvature) {
  assumptions_.clear();
  read(tape, patch, curvature);
  const Term out = term(tape.outputs()[0]);
  return {out.f.v, {out.f.d[0], out.f.d[1], out.f.d[2]}, out.h, curvature && out.curved};
}

double PatchReading::leastSlopeOfCases(const Tape& tape, const Patch& patch, int k, int& runs) {
  constexpr int kMostRuns = 40;
  if (++runs > kMostRuns) return 0.0;
  if (!read(tape, patch, assumptions_.empty())) return std::numeric_limits<double>::infinity();
  const Interval slope = term(tape.outputs()[0]).f.d[k];
  // Without bounds a line may not be differentiable almost everywhere, or jump.
  if (assumptions_.empty() && (slope.nan || !std::isfinite(slope.lo) || !std::isfinite(slope.hi))) return 0.0;
  if (slope.nan) return 0.0;
  if (slope.lo > 0.0) return slope.lo;
  std::optional<Assumption> open = openChoice(tape);
  if (!open) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const bool less : {false, true}) {
    open->less = less;
    assumptions_.push_back(*open);
    least = std::min(least, leastSlopeOfCases(tape, patch, k, runs));
    assumptions_.pop_back();
    if (!(least > 0.0)) break;
  }
  return least;
}

double PatchReading::leastSlope(const Tape& tape, const Patch& patch, int k) {
  assumptions_.clear();
  along_ = k;
  int runs = 0;
  const double least = leastSlopeOfCases(tape, patch, k, runs);
  assumptions_.clear();
  return std::isfinite(least) ? least : 0.0;
}

}  // namespace sdf
