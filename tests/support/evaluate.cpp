#include "support/evaluate.h"

#include <unordered_map>

#include "sdf/expr/apply-inl.h"

namespace sdf::test {

Evaluator::Evaluator(const Expr& e, const std::map<std::string, double>& parameters) {
  std::unordered_map<Expr, int> place;
  for (const Expr& n : topologicalOrder({&e, 1})) {
    Step step;
    step.op = n.op();
    if (n.op() == Op::Constant) step.value = n.constantValue();
    if (n.op() == Op::Variable) step.in[0] = static_cast<int>(n.variableIndex());
    if (n.op() == Op::Parameter) {
      const auto given = parameters.find(n.parameterInfo().name);
      step.value = given == parameters.end() ? n.parameterInfo().value : given->second;
    }
    if (n.payloadPart()) step.payload = *n.payloadPart();
    for (int i = 0; i < arity(n.op()); ++i) step.in[i] = place.at(n.arg(i));
    place.emplace(n, static_cast<int>(steps_.size()));
    steps_.push_back(step);
  }
  values_.resize(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) values_[i] = steps_[i].value;
}

double Evaluator::operator()(const glm::dvec3& p) const {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& s = steps_[i];
    if (s.op == Op::Variable)
      values_[i] = s.in[0] < 3 ? p[s.in[0]] : 0.0;
    else if (s.op != Op::Constant && s.op != Op::Parameter)
      values_[i] = evaluateOp<double>(s.op, s.payload.payload ? &s.payload : nullptr,
                                      [&](int a) { return values_[s.in[a]]; });
  }
  return values_.back();
}

glm::dvec3 Evaluator::gradient(const glm::dvec3& p, double step) const {
  glm::dvec3 g;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 ahead = p, behind = p;
    ahead[i] += step, behind[i] -= step;
    g[i] = ((*this)(ahead) - (*this)(behind)) / (ahead[i] - behind[i]);
  }
  return g;
}

}  // namespace sdf::test
