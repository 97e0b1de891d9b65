// Strokes that are interrupted.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "sdf/outline/arc.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// A part of a chain, whose last corner is its end; of length 0 it is one corner.
struct Dash {
  ArcContour chain;
  glm::dvec2 along;  ///< where it leads at its end, of length 1
};

/// The dashes of a stroke along a chain of arcs (W3C, Scalable Vector Graphics 2, 2018, section 13.5.6), by
/// the arcs' lengths. One that runs over the end of a closed chain goes on at its beginning.
///
/// Preconditions: Stroke::isDashed; neighbouring corners differ; not closed, the last corner is the end.
/// Cost: linear in arcs and dashes (mostDashes).
std::vector<Dash> dashesOf(const ArcContour& chain, bool isClosed, const Stroke& stroke);

/// No outline of these curves has more dashes: none is longer than the lines between its control points.
double mostDashes(const Outline& outline);

}  // namespace sdf
