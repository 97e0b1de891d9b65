// Readings of many points in double, each by the tape of its region.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sdf/eval/tape.h"

namespace sdf {

/// What evaluateAll(*tape, points[i], normals[i]) gives for each i, one after the other. The points are
/// divided by space, and a tape loses on the way what intervals prove to have no part in the box of its
/// points. So a union of n operands that lie apart takes n log n operations where n points would take n^2.
std::vector<double> evaluateEach(const TapePtr& tape, std::span<const glm::dvec3> points,
                                 std::span<const glm::dvec3> normals);

}  // namespace sdf
