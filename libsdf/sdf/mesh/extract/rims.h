// Outlines of arcs as polygons, and what holes these have. Private to mesh/.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "sdf/shape/solids/polygon_tree.h"

namespace sdf {

/// A corner of a polygon; those of the outline itself are sharp, if it turns there by more than 5 degrees.
struct RimPoint {
  glm::dvec2 at;
  bool isSharp;
};
/// Has the inside to its left.
using Rim = std::vector<RimPoint>;

/// The outline's contours as polygons with corners on them, and chords that are nowhere farther from it than
/// `tolerance`; as few as go when each is as long as it may be. Contours of segments alone are left as they
/// are. Cost: the sides times those along a chord.
std::vector<Rim> rimsOf(const PolygonDistance& outline, double tolerance);

/// Polygons that fill the rims' inside together, as indices of the points of all rims, one after the other:
/// an outer rim, and on edges there and back those within it that bound its holes (Eberly 2008, Triangulation
/// by Ear Clipping). Nothing where a hole lies in no rim, or sees none.
std::optional<std::vector<std::vector<std::uint32_t>>> bridgedRims(const std::vector<Rim>& rims);

}  // namespace sdf
