// The batch readings in double. Private to eval/.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sdf/eval/batch.h"

namespace sdf {

/// The readings of BatchEvaluator, in double and rounded once: they give what evaluate(tape, p) gives. An
/// operation is looked up once for a row of points, so that a point costs a fraction of what it costs alone.
class ExactBatch {
 public:
  ExactBatch();
  ~ExactBatch();

  void evaluate(const Tape& tape, const Rows& in, std::size_t count, std::span<float* const> out);
  void evaluate(const Tape& tape, std::span<const glm::dvec3> points, float* out);
  /// Value and derivatives of output 0, in that order.
  void evaluateGradient(const Tape& tape, const Rows& in, std::size_t count, float* const (&out)[4]);
  void evaluateGradient(const Tape& tape, std::span<const glm::dvec3> points, float* const (&out)[4]);
  void evaluateBalls(const Tape& tape, const Rows& in, std::size_t count, double radius, double slack,
                     float* value, Decision* decisions);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace sdf
