// The shapes that every measurement is taken on, all within ±kRegion.
#pragma once
#include <string>

#include "sdf/shape/shape.h"

namespace sdf::bench {

inline constexpr double kRegion = 2.0;

/// S1 … S7 for i = 0 … 6: a ball, a drilled box, twenty blended balls, a gyroid sheet, a thousand balls, thin
/// parts on the lattice, and the same off the lattice.
Shape measuringShape(int i);
/// "S1" …
std::string shapeName(int i);
/// Hard union of so many balls, the centres being those of S5.
Shape balls(int count, double radius);

}  // namespace sdf::bench
