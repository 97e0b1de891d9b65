// The batch readings: float, SIMD, hundreds of points a call, with the best instruction set that the machine
// has. eval/promise.h says how accurate they are. A tape that floats do not do for (Tape::isExact) is read in
// double instead, at the same points: then they give what evaluate(tape, p) gives, rounded once.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sdf/eval/tape.h"

namespace sdf {

/// Largest number of points that the readings take in one pass; longer arrays are cut.
inline constexpr std::size_t kBatchPoints = 512;

/// Rows of coordinates. Rows that the tape does not use may be null.
struct Rows {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const float* nx = nullptr;
  const float* ny = nullptr;
  const float* nz = nullptr;
};

/// A block of points in rows: what one pass takes.
struct PointRows {
  float x[kBatchPoints], y[kBatchPoints], z[kBatchPoints];

  void set(std::size_t i, const glm::vec3& p) { x[i] = p.x, y[i] = p.y, z[i] = p.z; }
  glm::vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
  Rows rows() const { return {x, y, z}; }
  Rows rows(const PointRows& normals) const { return {x, y, z, normals.x, normals.y, normals.z}; }
};

/// Scratch memory for the batch readings; one per thread.
class BatchEvaluator {
 public:
  BatchEvaluator();
  ~BatchEvaluator();
  BatchEvaluator(BatchEvaluator&&) noexcept;

  /// Values of all outputs at `count` points: out[i][k] is output i at point k. Rows must not overlap the
  /// inputs.
  void evaluate(const Tape& tape, const Rows& in, std::size_t count, std::span<float* const> out);
  void evaluate(const Tape& tape, const Rows& in, std::size_t count, float* out) {
    evaluate(tape, in, count, std::span<float* const>(&out, 1));
  }

  /// Value and gradient of output 0 at `count` points.
  void evaluateGradient(const Tape& tape, const Rows& in, std::size_t count, float* value, float* dx,
                        float* dy, float* dz);

  /// Values of output 0 at `count` <= kBatchPoints centres, and what the ball of radius `radius` around each
  /// decides from the proven slopes: decisions[i * count + k] for decidable instruction i, ball k (Decision,
  /// tape order). `slack` is added to every margin to cover float rounding.
  void evaluateBalls(const Tape& tape, const Rows& in, std::size_t count, float radius, float slack,
                     float* value, std::vector<Decision>& decisions);

  /// Name of the instruction set in use, e.g. "AVX3".
  static const char* targetName();

  /// Values of output 0 at points in double, read in double whatever the tape: where the distance of the
  /// floats around a point matters.
  void evaluateExactly(const Tape& tape, std::span<const glm::dvec3> points, float* out);
  void evaluateGradientExactly(const Tape& tape, std::span<const glm::dvec3> points, float* value, float* dx,
                               float* dy, float* dz);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace sdf
