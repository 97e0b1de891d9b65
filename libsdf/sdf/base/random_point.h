// Points at random, the same on every machine.
#pragma once
#include <random>

#include "sdf/base/box.h"

namespace sdf {

/// A point of a finite box, evenly spread: one draw for each coordinate, x first.
inline glm::dvec3 pointIn(const Box& box, std::mt19937& random) {
  glm::dvec3 p;
  for (int i = 0; i < 3; ++i) p[i] = box.min[i] + box.size()[i] * (static_cast<double>(random()) / 0x1p32);
  return p;
}

}  // namespace sdf
