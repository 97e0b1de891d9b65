// A small evaluator for tests of shapes: values of expressions in double, straight from the graph.
#pragma once
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sdf/expr/apply-inl.h"
#include "sdf/expr/expr.h"

namespace sdf::test {

/// The expression as a list of operations, made once, then evaluated at any number of points. Parameters keep
/// their present values unless others are given by name.
class Evaluator {
 public:
  explicit Evaluator(const Expr& e, const std::map<std::string, double>& parameters = {}) {
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

  double operator()(const glm::dvec3& p) const {
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

  /// Central differences with this step.
  glm::dvec3 gradient(const glm::dvec3& p, double step) const {
    glm::dvec3 g;
    for (int i = 0; i < 3; ++i) {
      glm::dvec3 ahead = p, behind = p;
      ahead[i] += step, behind[i] -= step;
      g[i] = ((*this)(ahead) - (*this)(behind)) / (ahead[i] - behind[i]);
    }
    return g;
  }

  /// Every intermediate value of the last evaluation, in topologicalOrder().
  const std::vector<double>& values() const { return values_; }

 private:
  struct Step {
    Op op = Op::Constant;
    std::array<int, 3> in{};
    double value = 0.0;
    PayloadPart payload;
  };
  std::vector<Step> steps_;
  mutable std::vector<double> values_;
};

}  // namespace sdf::test
