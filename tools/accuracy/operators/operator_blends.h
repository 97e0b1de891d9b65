// The smooth minima as their sources define them, one by one, in plain doubles.
#pragma once
#include <array>

#include "sdf/shape/operators/booleans.h"

namespace sdf::accuracy {

struct Smooth {
  Blend::Kind kind;
  const char* name;
  double (*lower)(double a, double b, double k);  ///< the smooth minimum
  double depth;                                   ///< lower is below min by at most depth k, where a = b
  double curvature;                               ///< its second derivative by a - b is at most curvature / k
};

/// Every kind but the hard one.
extern const std::array<Smooth, 4> kSmooths;

}  // namespace sdf::accuracy
