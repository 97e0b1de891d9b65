// The distance to a polygon, or to contours of arcs, as a texture for shaders. Private to shape/.
#pragma once
#include <string>

#include "sdf/expr/payload.h"
#include "sdf/shape/solids/polygon_tree.h"

namespace sdf {

/// The polygon's box, and half of its longest side around it, is divided into square cells, and these into 16
/// each where that is needed. A cell has a list of all sides that are nearest to some point in it, so that
/// the distance there is exact but for floats; or, where there are many and the polygon is farther off than
/// the cell is large, a bicubic patch (Ferguson 1964) through distances and gradients at its corners. A patch
/// is seen to be off by no more than kPatchError of the longest side, at 16 points, unless there are too many
/// cells. Beyond the cells the distance is too small: it is the root of the squares of the way to them and of
/// the distance there, which no surface is nearer than.
struct PolygonCells {
  static constexpr double kPatchError = 0x1p-11;

  /// One of four channels: a head, the cells, and what they name.
  PayloadVolume volume{"Cells", {}, 4, false, {}};
  int lists = 0, patches = 0;  ///< so many cells
  int longest = 0;             ///< sides in a list

  /// Cost: some microseconds a cell, on all cores; of those there are some for each side, and 200,000 at
  /// most.
  explicit PolygonCells(const PolygonDistance& distance);

  /// GLSL of `float NAME(vec3 p)` and `vec3 NAMESlopes(vec3 p)`, the same for all polygons, and for all
  /// outlines that have arcs; see Payload::glsl.
  static std::string glsl(const std::string& name, bool hasArcs);
};

}  // namespace sdf
