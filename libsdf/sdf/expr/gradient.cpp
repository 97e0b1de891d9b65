#include "sdf/expr/gradient.h"

#include <concepts>
#include <unordered_map>

#include "sdf/expr/apply-inl.h"

namespace sdf {
namespace {

/// A number type whose numbers are expressions. Derivatives are full of zeros and ones, so sums and products
/// with them are taken at once.
struct Symbol {
  Expr e;
  Symbol(double v = 0.0) : e(v) {}             // NOLINT: as other number types
  Symbol(Expr value) : e(std::move(value)) {}  // NOLINT
};

bool is(const Symbol& a, double v) { return a.e.isConstant(v); }

Symbol neg(const Symbol& a) { return is(a, 0.0) ? a : Symbol(neg(a.e)); }
Symbol add(const Symbol& a, const Symbol& b) {
  return is(a, 0.0) ? b : is(b, 0.0) ? a : Symbol(add(a.e, b.e));
}
Symbol sub(const Symbol& a, const Symbol& b) {
  return is(b, 0.0) ? a : is(a, 0.0) ? neg(b) : Symbol(sub(a.e, b.e));
}
Symbol mul(const Symbol& a, const Symbol& b) {
  if (is(a, 0.0) || is(b, 0.0)) return 0.0;
  return is(a, 1.0) ? b : is(b, 1.0) ? a : Symbol(mul(a.e, b.e));
}
Symbol div(const Symbol& a, const Symbol& b) { return is(a, 0.0) ? a : Symbol(div(a.e, b.e)); }
Symbol select(const Symbol& c, const Symbol& a, const Symbol& b) {
  return a.e == b.e ? a : Symbol(select(c.e, a.e, b.e));
}
Symbol mulAdd(const Symbol& a, const Symbol& b, const Symbol& c) { return add(mul(a, b), c); }
Symbol squareAdd(const Symbol& a, const Symbol& c) { return add(Symbol(square(a.e)), c); }
Symbol stepSlope(const Symbol& /*step*/) { return 0.0; }
Symbol choiceSlope(const Symbol& c, const Symbol& a, const Symbol& b) { return select(c, a, b); }

std::array<Symbol, 4> payloadSlopes(const PayloadPart& part, const Symbol& a, const Symbol& b,
                                    const Symbol& c) {
  const std::array<Expr, 3> at{a.e, b.e, c.e};
  if (part.part != 0) return {Expr::payload(part, at), NAN, NAN, NAN};
  const auto slope = [&](int k) { return Expr::payload({part.payload, k}, at); };
  return {Expr::payload(part, at), slope(1), slope(2), slope(3)};
}

// The others are the operations of expressions.
#define SDF_UNARY(name, call, ...) \
  Symbol call(const std::same_as<Symbol> auto& a) { return call(a.e); }
#define SDF_BINARY(name, call, ...) \
  Symbol call(const std::same_as<Symbol> auto& a, const Symbol& b) { return call(a.e, b.e); }
#include "sdf/expr/ops.def"

using SymbolicDual = Dual<Symbol, 3>;

SymbolicDual leaf(const Expr& e) {
  SymbolicDual r = constant<Symbol, 3>(e);
  if (e.op() == Op::Variable && e.variableIndex() <= Variable::Z)
    r.d[static_cast<int>(e.variableIndex())] = 1.0;
  return r;
}

}  // namespace

Vec3E gradientOf(const Expr& e) {
  std::unordered_map<Expr, SymbolicDual> duals;
  for (const Expr& node : topologicalOrder({&e, 1}))
    duals.emplace(node, arity(node.op()) == 0
                            ? leaf(node)
                            : evaluateOp<SymbolicDual>(node.op(), node.payloadPart(),
                                                       [&](int i) { return duals.at(node.arg(i)); }));
  const SymbolicDual& result = duals.at(e);
  return {result.d[0].e, result.d[1].e, result.d[2].e};
}

}  // namespace sdf
