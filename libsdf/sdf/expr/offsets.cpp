#include "sdf/expr/offsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>

namespace sdf {
namespace {

// More terms than these are added up as they were written: else sums of many would be written anew for each
// use of a part of them.
constexpr std::size_t kMostTerms = 6;

// The sum of multiples of what depends on space, and of an offset; factors and offset depend on parameters
// alone.
struct Sum {
  struct Term {
    Expr of, factor;
  };
  std::vector<Term> terms;
  Expr offset = 0.0;

  bool isUniform() const { return terms.empty(); }
};

Sum alone(const Expr& e) { return {{{e, 1.0}}, 0.0}; }

Expr plus(const Expr& a, const Expr& b) {
  if (b.isConstant(0.0)) return a;
  if (a.isConstant(0.0)) return b;
  return b.isConstant() && b.constantValue() < 0.0 ? a - Expr(-b.constantValue()) : a + b;
}

Expr times(const Expr& a, const Expr& factor) { return factor.isConstant(1.0) ? a : a * factor; }

Expr written(const Sum& sum, const Expr& offset) {
  if (sum.isUniform()) return offset;
  Expr all = times(sum.terms[0].of, sum.terms[0].factor);
  for (std::size_t i = 1; i < sum.terms.size(); ++i) {
    const auto& [of, factor] = sum.terms[i];
    all = factor.isConstant(-1.0) ? all - of : all + times(of, factor);
  }
  return plus(all, offset);
}
Expr written(const Sum& sum) { return written(sum, sum.offset); }
// Less so much.
Expr less(const Sum& sum, const Expr& by) { return written(sum, sum.offset - by); }

Sum scaled(Sum sum, const Expr& by, Op op) {
  const auto scale = [&](const Expr& e) { return op == Op::Div ? e / by : e * by; };
  for (Sum::Term& term : sum.terms) term.factor = scale(term.factor);
  sum.offset = scale(sum.offset);
  return sum;
}

Sum added(const Sum& a, const Sum& b) {
  Sum sum = a;
  for (const Sum::Term& term : b.terms) {
    const auto known = std::ranges::find(sum.terms, term.of, &Sum::Term::of);
    if (known == sum.terms.end())
      sum.terms.push_back(term);
    else
      known->factor = known->factor + term.factor;
  }
  std::erase_if(sum.terms, [](const Sum::Term& term) { return term.factor.isConstant(0.0); });
  sum.offset = a.offset + b.offset;
  if (sum.terms.size() <= kMostTerms) return sum;
  Sum whole = alone(written(a, 0.0) + written(b, 0.0));
  whole.offset = sum.offset;
  return whole;
}

class Gatherer {
 public:
  explicit Gatherer(const glm::dvec3& origin) : origin_(origin) {}

  std::vector<Expr> run(std::span<const Expr> graphs) {
    for (const Expr& e : topologicalOrder(graphs)) sums_.emplace(e, gathered(e));
    std::vector<Expr> result;
    for (const Expr& e : graphs) result.push_back(written(sums_.at(e)));
    return result;
  }

 private:
  const Sum& argument(const Expr& e, int k) const { return sums_.at(e.arg(k)); }

  Sum gathered(const Expr& e) const {
    if (e.op() == Op::Variable) return variable(e);
    const int count = arity(e.op());
    bool uniform = true;
    for (int k = 0; k < count; ++k) uniform = uniform && argument(e, k).isUniform();
    if (uniform) return {{}, e};
    switch (e.op()) {
      case Op::Claim:
        return claimed(e);
      case Op::Neg:
        return scaled(argument(e, 0), -1.0, Op::Mul);
      case Op::Add:
        return added(argument(e, 0), argument(e, 1));
      case Op::Sub:
        return added(argument(e, 0), scaled(argument(e, 1), -1.0, Op::Mul));
      case Op::Mul:
      case Op::Div:
        return product(e);
      case Op::Floor:
      case Op::Ceil:
      case Op::Round:
        return stepped(e);
      case Op::Sin:
      case Op::Cos:
      case Op::Tan:
        return periodic(e, 2.0 * std::numbers::pi);
      case Op::Mod:
        return argument(e, 1).isUniform() ? periodic(e, e.arg(1)) : remade(e);
      default:
        return choiceOf(e.op()) == Choice::NoChoice ? remade(e) : chosen(e);
    }
  }

  Sum variable(const Expr& e) const {
    Sum sum = alone(e);
    if (e.variableIndex() <= Variable::Z) sum.offset = origin_[static_cast<int>(e.variableIndex())];
    return sum;
  }

  // A coordinate's claim says no more than its form.
  Sum claimed(const Expr& e) const {
    Sum sum = argument(e, 0);
    const bool linear =
        std::ranges::all_of(sum.terms, [](const Sum::Term& t) { return t.of.op() == Op::Variable; });
    if (linear) return sum;
    Sum result = alone(written(sum, 0.0).claimLipschitz(e.lipschitz()));
    result.offset = sum.offset;
    return result;
  }

  Sum product(const Expr& e) const {
    const Sum &a = argument(e, 0), &b = argument(e, 1);
    if (b.isUniform()) return scaled(a, b.offset, e.op());
    return e.op() == Op::Mul && a.isUniform() ? scaled(b, a.offset, Op::Mul) : remade(e);
  }

  // An even number is taken out: halves are rounded to even ones.
  Sum stepped(const Expr& e) const {
    const Sum& a = argument(e, 0);
    const Expr whole = 2.0 * floor(a.offset * 0.5);
    Sum sum = alone(Expr::make(e.op(), std::array{less(a, whole)}));
    sum.offset = whole;
    return sum;
  }

  Sum periodic(const Expr& e, const Expr& period) const {
    const Sum& a = argument(e, 0);
    const Expr within = less(a, period * floor(a.offset / period));
    return alone(e.op() == Op::Mod ? mod(within, e.arg(1)) : Expr::make(e.op(), std::array{within}));
  }

  // Both sides are moved alike.
  Sum chosen(const Expr& e) const {
    const bool selects = choiceOf(e.op()) == Choice::Selected;
    const Sum &a = argument(e, selects ? 1 : 0), &b = argument(e, selects ? 2 : 1);
    const Expr& by = (a.isUniform() ? b : a).offset;
    std::vector<Expr> args;
    if (selects) args.push_back(written(argument(e, 0)));
    if (a.isUniform() && b.isUniform()) return remade(e);
    args.push_back(less(a, by));
    args.push_back(less(b, by));
    Sum sum = alone(Expr::make(e.op(), args));
    if (!isComparison(e.op())) sum.offset = by;
    return sum;
  }

  Sum remade(const Expr& e) const {
    std::vector<Expr> args;
    for (int k = 0; k < arity(e.op()); ++k) args.push_back(written(argument(e, k)));
    if (const PayloadPart* part = e.payloadPart())
      return alone(Expr::payload(*part, {args[0], args[1], args[2]}));
    return alone(Expr::make(e.op(), args));
  }

  glm::dvec3 origin_;
  std::unordered_map<Expr, Sum> sums_;
};

}  // namespace

std::vector<Expr> relativeTo(std::span<const Expr> graphs, const glm::dvec3& origin) {
  return Gatherer(origin).run(graphs);
}

}  // namespace sdf
