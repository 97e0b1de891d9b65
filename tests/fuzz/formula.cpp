#include "fuzz/formula.h"

#include <algorithm>
#include <unordered_map>

#include "number/adversary.h"

namespace sdf::fuzz {
namespace {

const std::vector<Op>& graphOperations() {
  static const std::vector<Op> all = [] {
    std::vector<Op> ops = operations();
    std::erase_if(ops, [](Op op) { return info(op).fused; });
    return ops;
  }();
  return all;
}

bool isZero(double v) { return v == 0.0; }

}  // namespace

Formula::Formula(Bytes& bytes, int most) {
  for (const Variable v : {Variable::X, Variable::Y, Variable::Z}) {
    Step step{Op::Variable, {}, 0.0};
    step.in[0] = static_cast<int>(v);
    add(step, Expr::variable(v));
  }
  for (int left = 1 + bytes.below(most); left > 0 && !bytes.empty(); --left) decodeStep(bytes);
}

void Formula::decodeStep(Bytes& bytes) {
  // Beside the operations: numbers, and what the tape compiler fuses.
  enum Extra { Number, Slider, Length2, Length3, Moved, kExtras };
  const auto& ops = graphOperations();
  const int code = bytes.below(static_cast<int>(ops.size()) + kExtras);
  if (code < static_cast<int>(ops.size())) {
    std::array<int, 3> in{};
    for (int i = 0; i < arity(ops[code]); ++i) in[i] = pick(bytes);
    apply(ops[code], in);
    return;
  }
  switch (code - static_cast<int>(ops.size())) {
    case Number:
      constant(bytes.number());
      return;
    case Slider:
      parameter(bytes);
      return;
    case Length2:
      length({pick(bytes), pick(bytes), 0}, 2);
      return;
    case Length3:
      length({pick(bytes), pick(bytes), pick(bytes)}, 3);
      return;
    default: {
      std::array<int, 3> moved{};
      for (int& m : moved) {
        const int from = pick(bytes);
        m = apply(Op::Sub, {from, constant(bytes.moderate()), 0});
      }
      apply(Op::Sub, {length(moved, 3), constant(bytes.moderate()), 0});
    }
  }
}

// Mostly a recent step, so that formulas grow deep.
int Formula::pick(Bytes& bytes) const {
  const int b = static_cast<int>(bytes.byte()), count = static_cast<int>(steps_.size());
  return b < 96 ? b % std::min(count, 3) : count - 1 - b % std::min(count, 8);
}

int Formula::add(const Step& step, Expr node) {
  steps_.push_back(step);
  nodes_.push_back(std::move(node));
  return static_cast<int>(steps_.size()) - 1;
}

int Formula::constant(double value) { return add({Op::Constant, {}, value}, Expr(value)); }

// Now and then its value lies beyond its range, as a user may set it.
int Formula::parameter(Bytes& bytes) {
  const double a = bytes.moderate(), b = bytes.moderate(), t = bytes.byte() / 200.0;
  const double value = a + (b - a) * t;
  const std::string name = "p" + std::to_string(steps_.size());
  return add({Op::Parameter, {}, value}, Expr::parameter({name, value, std::min(a, b), std::max(a, b)}));
}

int Formula::apply(Op op, std::array<int, 3> in) {
  std::vector<Expr> args;
  for (int i = 0; i < arity(op); ++i) args.push_back(nodes_[in[i]]);
  return add({op, in, 0.0}, Expr::make(op, args));
}

int Formula::length(const std::array<int, 3>& in, int count) {
  int sum = apply(Op::Square, {in[0], 0, 0});
  for (int i = 1; i < count; ++i) sum = apply(Op::Add, {sum, apply(Op::Square, {in[i], 0, 0}), 0});
  const Expr& a = nodes_[in[0]];
  const Expr& b = nodes_[in[1]];
  Expr claimed = count == 2 ? sdf::length(a, b) : sdf::length(a, b, nodes_[in[2]]);
  return add({Op::Sqrt, {sum, 0, 0}, 0.0}, std::move(claimed));
}

Formula::Value Formula::evaluate(const std::array<double, 3>& p) const {
  std::vector<double> values;
  bool signMatters = false;
  for (const Step& s : steps_) {
    double v = s.value;
    if (s.op == Op::Variable) v = p[s.in[0]];
    if (arity(s.op) > 0) v = evaluateOp<double>(s.op, [&](int i) { return values[s.in[i]]; });
    const bool divides = s.op == Op::Div || s.op == Op::Mod || s.op == Op::Atan2;
    signMatters = signMatters || (divides && isZero(values[s.in[1]])) ||
                  ((s.op == Op::Atan2 || s.op == Op::Pow) && isZero(values[s.in[0]]));
    values.push_back(v);
  }
  return {values.back(), signMatters};
}

std::string text(const Expr& e) {
  std::string all;
  std::unordered_map<Expr, std::string> names;
  for (const Expr& n : topologicalOrder({&e, 1})) {
    const std::string name = "n" + std::to_string(names.size());
    std::string line = std::string(info(n.op()).name) + "(";
    for (int i = 0; i < arity(n.op()); ++i) line += (i ? ", " : "") + names.at(n.arg(i));
    if (n.op() == Op::Constant) line += sdf::text(n.constantValue());
    if (n.op() == Op::Variable) line += "xyz"[static_cast<int>(n.variableIndex())];
    if (n.op() == Op::Parameter) {
      const ParameterInfo& p = n.parameterInfo();
      line += sdf::text(p.value) + " in " + sdf::text(Interval(p.min, p.max));
    }
    all += "  " + name + " = " + line + ")   range " + sdf::text(n.range()) + ", L " +
           std::to_string(n.lipschitz()) + "\n";
    names.emplace(n, name);
  }
  return all;
}

}  // namespace sdf::fuzz
