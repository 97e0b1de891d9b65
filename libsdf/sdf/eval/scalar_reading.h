// Readings one point (or one box) at a time: double, intervals, and duals of either.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/eval/tape.h"
#include "sdf/expr/apply-inl.h"

namespace sdf {

/// Runs a tape with number type T, keeping every intermediate value. Not thread-safe; cheap to make.
template <class T>
class ScalarReading {
 public:
  /// Evaluates the tape for the given variables (x, y, z, and the normal where it is used).
  void run(const Tape& tape, const std::array<T, kVariableCount>& variables);

  T output(std::size_t i = 0) const { return value(tape_->outputs()[i]); }
  T value(Operand a) const {
    if (a.isConstant()) return number(tape_->constant(a.index()));
    return a.isVariable() ? variables_[a.index()] : values_[a.index()];
  }

 private:
  static T number(double v) {
    if constexpr (requires(T t) { t.d; })
      return constant<decltype(T::v), sizeof(T::d) / sizeof(T::v)>(v);
    else
      return T(v);
  }

  const Tape* tape_ = nullptr;
  std::array<T, kVariableCount> variables_;
  std::vector<T> values_;
};

template <class T>
void ScalarReading<T>::run(const Tape& tape, const std::array<T, kVariableCount>& variables) {
  tape_ = &tape;
  variables_ = variables;
  values_.resize(tape.instructions().size());
  T* next = values_.data();
  for (const Instruction& instruction : tape.instructions())
    *next++ = evaluateOp<T>(instruction.op, tape.payload(instruction), [&](int k) {
      const int rows = rowArguments(instruction.op);
      return k < rows ? value(instruction.in[k]) : number(tape.constant(instruction.constants + k - rows));
    });
}

extern template class ScalarReading<double>;
extern template class ScalarReading<Interval>;

/// The reference reading: output 0 in double at p (and, where the tape uses it, the unit normal n). This is
/// the oracle.
double evaluate(const Tape& tape, const glm::dvec3& p, const glm::dvec3& n = {});
/// All outputs.
std::vector<double> evaluateAll(const Tape& tape, const glm::dvec3& p, const glm::dvec3& n = {});
/// Value and gradient of output 0 in double. At a crease the gradient of one side; at sqrt(0) the slope is 0.
ValueAndGradient evaluateGradient(const Tape& tape, const glm::dvec3& p);

/// The interval reading of output 0 over a box, whose sides may be infinite. Variables of the normal range
/// over [-1, 1].
Interval evaluate(const Tape& tape, const Box& box);
/// The same without allocating, once the workspace has grown.
Interval evaluate(const Tape& tape, const Box& box, ScalarReading<Interval>& workspace);
/// The same, and what the box decides of every min, max, select and comparison, in tape order.
Interval evaluate(const Tape& tape, const Box& box, ScalarReading<Interval>& workspace,
                  std::vector<Decision>& decisions);

/// Upper bound of the slope of output 0 over a box, from interval derivatives; infinite where it may jump or
/// diverge.
double lipschitzOver(const Tape& tape, const Box& box);
/// The same of an output that is known to be continuous, as one of bounded slope is, however it is put
/// together out of parts that jump.
double lipschitzOfContinuous(const Tape& tape, const Box& box);

}  // namespace sdf
