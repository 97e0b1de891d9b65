// Extruded polygons and outlines that are nothing but moved.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "sdf/shape/shape.h"
#include "sdf/shape/solids/polygon_field.h"

namespace sdf {

/// A polygon of many sides, or an outline of curves, that was extruded, and only moved, turned and scaled,
/// before or after.
struct PlacedPrism {
  std::shared_ptr<const PolygonField> field;
  Expr halfHeight;         ///< does not depend on space
  std::array<Expr, 3> at;  ///< the prism's own coordinates of the scene's position, linear functions of that
};

/// The distance f, which has no claims, as that of a prism, if it is one. Cost: the nodes of f.
std::optional<PlacedPrism> placedPrism(Expr f);

}  // namespace sdf
