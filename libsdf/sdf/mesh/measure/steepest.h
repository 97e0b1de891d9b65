// Does a distance keep the slope that is stated of it?
#pragma once
#include <glm/vec3.hpp>

#include "sdf/eval/tape.h"

namespace sdf {

/// A place, and the change of a distance over the way from it to another, by its length.
struct Steepest {
  double slope = 0.0;
  glm::dvec3 at{0.0};
};

/// The steepest of the distance, output 0 of the tape, between neighbours in a lattice of points around
/// `centre`, up to `reach` > 0 away along each axis, and from there along its gradient. In double: what is
/// beyond a slope that is stated by more than roundings refutes it. Nothing is seen of what lies between the
/// points. 0 at the centre where it changes nowhere. Cost: 5000 readings.
Steepest steepestAround(const glm::dvec3& centre, double reach, const Tape& distance);

}  // namespace sdf
