// A graph's value node by node, for any number type: no tape, no fusing, no folding.
#pragma once
#include <array>
#include <unordered_map>

#include "sdf/expr/apply-inl.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// Parameters take their present values. number(double) makes a T of a constant.
template <class T, class Number>
T evaluateGraph(const Expr& e, const std::array<T, kVariableCount>& variables, const Number& number) {
  std::unordered_map<const Node*, T> values;
  for (const Expr& n : topologicalOrder({&e, 1})) {
    T value{};
    if (n.op() == Op::Constant)
      value = number(n.constantValue());
    else if (n.op() == Op::Parameter)
      value = number(n.parameterInfo().value);
    else if (n.op() == Op::Variable)
      value = variables[static_cast<int>(n.variableIndex())];
    else
      value = evaluateOp<T>(n.op(), n.payloadPart(), [&](int i) { return values.at(n.arg(i).node()); });
    values.emplace(n.node(), value);
  }
  return values.at(e.node());
}

inline double evaluateGraph(const Expr& e, double x, double y = 0.0, double z = 0.0) {
  return evaluateGraph<double>(e, {x, y, z, 0.0, 0.0, 0.0}, [](double v) { return v; });
}
/// Encloses the real value at a point: a few ulps wide, or as wide as a jump that the point lies on.
inline Interval enclosureAt(const Expr& e, const std::array<double, 3>& p) {
  return evaluateGraph<Interval>(e, {Interval(p[0]), Interval(p[1]), Interval(p[2]), {}, {}, {}},
                                 [](double v) { return Interval(v); });
}

}  // namespace sdf
