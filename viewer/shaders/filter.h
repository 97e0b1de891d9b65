// Patterns with sharp edges, averaged over what a pixel covers.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::viewer {

/// The GLSL variables that filtered patterns read of a pixel: the ray's direction by its product with the
/// normal, and how wide its cone is at the surface; 0 leaves patterns sharp.
inline constexpr const char* kFootprintVariables = "vec3 pixelWay = vec3(0.0);\nfloat pixelSize = 0.0;\n";
/// The terms over these variables for which filtered patterns have the parameters hidden(term).
inline constexpr const char* kFootprintTerms[] = {"pixelWay.x", "pixelWay.y", "pixelWay.z", "pixelSize"};

/// Filtered outputs are what `filtered` makes of some.
struct Filtered {
  std::vector<Expr> outputs;
  bool changed = false;  ///< there was something to filter
};

/// Returns the outputs, in which every choice between two values by whether floor(u), or floor(u) + floor(v),
/// is odd (stripes, checkerboards) has become the mean over the pixel: exact for the box that u and v run
/// through in it (Quilez, "Box-filtered checkerboard", 2017). It does not matter how the pattern was moved or
/// bent: u's gradient tells how fast it runs. Cost: the size of the graph.
Filtered filtered(std::span<const Expr> outputs);

}  // namespace sdf::viewer
