#include "sdf/proof/patterns.h"

#include <algorithm>
#include <cmath>

namespace sdf {
namespace {

class Finder {
 public:
  explicit Finder(const Tape& tape) : tape_(tape) {}

  Pattern find(const Instruction& n) const {
    if (n.op == Op::Add)
      for (int k = 0; k < 2; ++k)
        if (const Pattern p = boxDistance(n.in[1 - k], n.in[k]); p.kind != Pattern::None) return p;
    return n.op == Op::MulAdd ? blend(n) : Pattern{};
  }

 private:
  const Instruction* made(Operand a, Op op) const {
    const Instruction* n = a.isValue() ? &tape_.instructions()[a.index()] : nullptr;
    return n && n->op == op ? n : nullptr;
  }
  double number(Operand a) const { return tape_.constant(a.index()); }
  bool isZero(Operand a) const { return a.isConstant() && number(a) == 0.0; }

  // The leaves of a tree of maxima, of which p's parts are some; false where they are more than three.
  bool leaves(Operand a, Pattern& p) const {
    const bool isPart = std::find(p.parts.begin(), p.parts.begin() + p.count, a) != p.parts.begin() + p.count;
    const Instruction* both = isPart ? nullptr : made(a, Op::Max);
    if (both) return leaves(both->in[0], p) && leaves(both->in[1], p);
    if (p.otherCount == 3) return false;
    p.others[p.otherCount++] = a;
    return true;
  }

  // Takes max(p, 0) as a part of a length; false where it is another term.
  bool component(Operand a, Pattern& p) const {
    if (isZero(a)) return true;
    const Instruction* clipped = made(a, Op::Max);
    if (!clipped || !isZero(clipped->in[1]) || p.count == 3) return false;
    p.parts[p.count++] = clipped->in[0];
    return true;
  }

  bool components(Operand outside, Pattern& p) const {
    for (const Op op : {Op::AbsMinus, Op::Length2, Op::Length3})
      if (const Instruction* length = made(outside, op)) {
        if (tape_.constant(length->constants) != 0.0) return false;
        for (int i = 0; i < rowArguments(op); ++i)
          if (!component(length->in[i], p)) return false;
        return p.count > 0;
      }
    return component(outside, p) && p.count > 0;
  }

  Pattern boxDistance(Operand outside, Operand inside) const {
    const Instruction* low = made(inside, Op::Min);
    if (!low || !isZero(low->in[1])) return {};
    Pattern p;
    p.outside = outside, p.inside = inside, p.most = low->in[0];
    if (!components(outside, p) || !leaves(p.most, p)) return {};
    for (int i = 0; i < p.count; ++i) {
      const auto end = p.others.begin() + p.otherCount, at = std::find(p.others.begin(), end, p.parts[i]);
      p.isInside[i] = at != end;
      if (p.isInside[i]) *at = p.others[--p.otherCount];
    }
    p.kind = Pattern::BoxDistance;
    if (p.count == 2) findCorner(p);
    return p;
  }

  // a x as x and a.
  std::pair<Operand, double> factors(Operand product) const {
    const Instruction* n = made(product, Op::Mul);
    if (!n) return {product, 1.0};
    for (int k = 0; k < 2; ++k)
      if (n->in[k].isConstant()) return {n->in[1 - k], number(n->in[k])};
    return {product, 1.0};
  }

  void findCorner(Pattern& p) const {
    const Instruction* out = made(p.most, Op::Max);
    const Instruction* past = out ? made(p.parts[p.parts[0] == p.most], Op::Sub) : nullptr;
    if (!past) return;
    const auto [low, a] = factors(past->in[0]);
    const auto [high, b] = factors(past->in[1]);
    const Instruction* least = made(low, Op::Min);
    if (!least || high != p.most || least->in != out->in) return;
    // Constants are rounded: as if y were 1 + e times itself, |e| less than half of that, for which the
    // slope's bounds have room (narrowCorner).
    if (!(a > 0.0) || !(std::abs(a * a - b * b - 1.0) < 1e-10)) return;
    p.kind = Pattern::Corner;
    p.sides = {out->in[0], out->in[1]};
    p.k = b / a;
  }

  Pattern blend(const Instruction& sum) const {
    if (!sum.in[1].isConstant()) return {};
    const Instruction* squared = made(sum.in[0], Op::Square);
    const Instruction* h = squared ? made(squared->in[0], Op::Max) : nullptr;
    const Instruction* rest = h && isZero(h->in[1]) ? made(h->in[0], Op::Sub) : nullptr;
    const Instruction* apart = rest && rest->in[0].isConstant() ? made(rest->in[1], Op::Abs) : nullptr;
    const Instruction* difference = apart ? made(apart->in[0], Op::Sub) : nullptr;
    if (!difference) return {};
    const Instruction* least = made(sum.in[2], Op::Min);
    const Instruction* choice = least ? least : made(sum.in[2], Op::Max);
    if (!choice) return {};
    const Operand x = difference->in[0], y = difference->in[1];
    const bool same =
        (choice->in[0] == x && choice->in[1] == y) || (choice->in[0] == y && choice->in[1] == x);
    const double k = number(rest->in[0]), c = (least ? -1.0 : 1.0) * number(sum.in[1]);
    // Rounding of the constants bends the blend where x = y by so little that corners' rounding covers it.
    if (!same || !(k > 0.0) || !(std::abs(4.0 * c * k - 1.0) < 0x1p-50)) return {};
    Pattern p;
    p.kind = Pattern::Blend;
    p.parts = {x, y};
    p.count = 2;
    p.k = k;
    p.isMin = least != nullptr;
    return p;
  }

  const Tape& tape_;
};

}  // namespace

void findPatterns(const Tape& tape, std::vector<Pattern>& out) {
  const Finder finder(tape);
  out.clear();
  for (const Instruction& n : tape.instructions()) out.push_back(finder.find(n));
}

}  // namespace sdf
