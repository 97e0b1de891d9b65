// What of a scene floats cannot hold. Private to viewer/shaders.
#pragma once
#include <vector>

#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// Unsteady are the nodes of a part's formulas that have to be computed in double.
struct Unsteady {
  const Part* part;
  std::vector<Expr> nodes;
};

/// Finds the parts in which rounding to floats would move a surface by a tenth of a pixel, in a picture of a
/// thousand rows that shows all of an operand, or change a colour by half a step of a byte. Each operand is
/// looked at where it lies (sdf/eval/rounding.h).
std::vector<Unsteady> unsteadyOf(const Scene& scene);

}  // namespace sdf::viewer
