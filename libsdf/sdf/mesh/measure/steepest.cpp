#include "sdf/mesh/measure/steepest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/eval/scalar_reading.h"

namespace sdf {
namespace {

// Along each axis, chosen; one is the centre. With a reach of three voxels they are 3/8 of one apart.
constexpr int kPoints = 17;

}  // namespace

Steepest steepestAround(const glm::dvec3& centre, double reach, const Tape& distance) {
  const double apart = 2.0 * reach / (kPoints - 1);
  const auto pointAt = [&](int i) {
    const glm::dvec3 steps(i % kPoints, i / kPoints % kPoints, i / (kPoints * kPoints));
    return centre + apart * (steps - 0.5 * (kPoints - 1));
  };
  std::vector<double> values(kPoints * kPoints * kPoints);
  for (int i = 0; i < static_cast<int>(values.size()); ++i) values[i] = evaluate(distance, pointAt(i));
  Steepest steepest{0.0, centre};
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    for (int axis = 0, stride = 1; axis < 3; ++axis, stride *= kPoints) {
      if (i / stride % kPoints == kPoints - 1) continue;
      const double slope = std::abs(values[i + stride] - values[i]) / apart;
      if (slope > steepest.slope) steepest = {slope, pointAt(i)};
    }
  // The same the way in which it changes the most there.
  const auto [value, gradient] = evaluateGradient(distance, steepest.at);
  const double length = glm::length(gradient);
  if (!(length > 0.0 && std::isfinite(length))) return steepest;
  const double along = std::abs(evaluate(distance, steepest.at + apart / length * gradient) - value) / apart;
  steepest.slope = std::max(steepest.slope, along);
  return steepest;
}

}  // namespace sdf
