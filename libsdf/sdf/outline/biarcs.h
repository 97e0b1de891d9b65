// Béziers as arcs of circles.
#pragma once
#include <vector>

#include "sdf/outline/arc.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// The contours, or those of what their stroke covers (stroke.h), as arcs that are nowhere farther from the
/// curves than `tolerance` > 0, nor the curves from them; arcs run on in the curves' directions, so that no
/// corner comes to be where there was none. Each arc only rises or only falls. Contours of no size are left
/// out. Coordinates are finite.
///
/// A curve is halved until two arcs do (biarcs; Bolton 1975, Sabin 1976), which is proven by the Bernstein
/// coefficients of the circle's equation along it. The number of arcs grows with the cube root of
/// 1 / tolerance.
std::vector<ArcContour> arcContours(const Outline& outline, double tolerance);

}  // namespace sdf
