#include "sdf/expr/gradient.h"

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

#define SDF_SYMBOL_UNARY(call) \
  Symbol call(const Symbol& a) { return call(a.e); }
SDF_SYMBOL_UNARY(abs)
SDF_SYMBOL_UNARY(sqrt)
SDF_SYMBOL_UNARY(square)
SDF_SYMBOL_UNARY(sin)
SDF_SYMBOL_UNARY(cos)
SDF_SYMBOL_UNARY(tan)
SDF_SYMBOL_UNARY(asin)
SDF_SYMBOL_UNARY(acos)
SDF_SYMBOL_UNARY(atan)
SDF_SYMBOL_UNARY(exp)
SDF_SYMBOL_UNARY(log)
SDF_SYMBOL_UNARY(floor)
SDF_SYMBOL_UNARY(ceil)
SDF_SYMBOL_UNARY(round)
#undef SDF_SYMBOL_UNARY

#define SDF_SYMBOL_BINARY(call) \
  Symbol call(const Symbol& a, const Symbol& b) { return call(a.e, b.e); }
SDF_SYMBOL_BINARY(min)
SDF_SYMBOL_BINARY(max)
SDF_SYMBOL_BINARY(pow)
SDF_SYMBOL_BINARY(atan2)
SDF_SYMBOL_BINARY(mod)
SDF_SYMBOL_BINARY(less)
SDF_SYMBOL_BINARY(lessEqual)
SDF_SYMBOL_BINARY(equal)
#undef SDF_SYMBOL_BINARY

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
