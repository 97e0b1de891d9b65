// What is too large or too small to be read in floats.
#pragma once
#include <optional>
#include <string>

#include "sdf/base/box.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// Why lengths of what lies in these bounds cannot be read in floats, and what helps: "it reaches 1e308 from
/// the origin; …". Nothing where they can; infinite sides are passed over.
std::optional<std::string> beyondFloats(const Box& bounds);
/// The same of a shape: of the numbers in its formulas, and of its bounds, unless it has parameters, over
/// whose whole ranges these extend.
std::optional<std::string> beyondFloats(const Shape& shape);

}  // namespace sdf
