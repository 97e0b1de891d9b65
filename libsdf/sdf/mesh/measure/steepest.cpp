#include "sdf/mesh/measure/steepest.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "sdf/eval/scalar_reading.h"

namespace sdf {
namespace {

constexpr int kPoints = 17;  // along each axis; one is the centre

}  // namespace

Steepest steepestAround(const glm::dvec3& centre, double reach, const Tape& distance) {
  const double apart = 2.0 * reach / (kPoints - 1);
  const auto pointAt = [&](int i) {
    const glm::dvec3 steps(i % kPoints, i / kPoints % kPoints, i / (kPoints * kPoints));
    return centre + apart * (steps - 0.5 * (kPoints - 1));
  };
  ScalarReading<double> reading;
  const auto read = [&](const glm::dvec3& p) {
    reading.run(distance, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
    return reading.output(0);
  };
  std::vector<double> values(kPoints * kPoints * kPoints);
  for (int i = 0; i < static_cast<int>(values.size()); ++i) values[i] = read(pointAt(i));
  Steepest steepest;
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    for (int axis = 0, stride = 1; axis < 3; ++axis, stride *= kPoints) {
      if (i / stride % kPoints == kPoints - 1) continue;
      const double slope = std::abs(values[i + stride] - values[i]) / apart;
      if (slope > steepest.slope) steepest = {slope, pointAt(i)};
    }
  // The same the way in which it changes the most there.
  const glm::dvec3& from = steepest.at;
  glm::dvec3 way;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 beside = from;
    beside[axis] += apart;
    way[axis] = read(beside) - read(from);
  }
  const glm::dvec3 step = apart / glm::length(way) * way;
  const double slope = std::abs(read(from + step) - read(from)) / apart;
  if (slope > steepest.slope) steepest.slope = slope;
  return steepest;
}

}  // namespace sdf
