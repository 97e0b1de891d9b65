// A small evaluator for tests of shapes: values of expressions in double, straight from the graph.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "sdf/expr/expr.h"
#include "sdf/expr/payload.h"

namespace sdf::test {

/// The expression as a list of operations, made once, then evaluated at any number of points. Parameters keep
/// their present values unless others are given by name.
class Evaluator {
 public:
  explicit Evaluator(const Expr& e, const std::map<std::string, double>& parameters = {});

  double operator()(const glm::dvec3& p) const;

  /// Central differences with this step.
  glm::dvec3 gradient(const glm::dvec3& p, double step) const;

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
