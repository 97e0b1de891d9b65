// Reading a tape at any number of points.
#pragma once
#include <algorithm>
#include <glm/vec3.hpp>

#include "sdf/eval/batch.h"

namespace sdf {

/// Calls take(k, value) for each of `count` points in turn, with output 0 of the tape at point(k).
template <class Point, class Take>
void readValues(BatchEvaluator& batch, const Tape& tape, std::size_t count, const Point& point,
                const Take& take) {
  PointRows at;
  float values[kBatchPoints];
  for (std::size_t first = 0; first < count; first += kBatchPoints) {
    const std::size_t size = std::min(count - first, kBatchPoints);
    for (std::size_t k = 0; k < size; ++k) at.set(k, glm::vec3(point(first + k)));
    batch.evaluate(tape, at.rows(), size, values);
    for (std::size_t k = 0; k < size; ++k) take(first + k, values[k]);
  }
}

}  // namespace sdf
