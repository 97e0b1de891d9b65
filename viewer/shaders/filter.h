// Patterns with sharp edges, averaged over what a pixel covers.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "sdf/eval/glsl.h"

namespace sdf::viewer {

/// What `filtered` reads of a pixel: the ray's direction by its product with the normal, and how wide its
/// cone is at the surface; 0 leaves patterns sharp.
inline constexpr const char* kFootprintVariables = "vec3 pixelWay = vec3(0.0);\nfloat pixelSize = 0.0;\n";

struct Filtered {
  std::vector<Expr> outputs;
  bool changed = false;  ///< there was something to filter, so that kFootprintVariables are needed
};

/// The outputs, in which every choice between two values by whether floor(u), or floor(u) + floor(v), is odd
/// (stripes, checkerboards) has become the mean over the pixel: exact for the box that u and v run through in
/// it (Quilez, "Box-filtered checkerboard", 2017). It does not matter how the pattern was moved or bent: u's
/// gradient tells how fast it runs. Names the pixel's vectors to the writer. Cost: the size of the graph.
Filtered filtered(std::span<const Expr> outputs, GlslWriter& writer);

}  // namespace sdf::viewer
