// Outlines as the path data of SVG gives them.
#pragma once
#include <string_view>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// Longer outlines are refused: of more curves.
inline constexpr std::size_t kMostCurves = 100'000;

/// The contours of path data, "M 0 0 L 1 0 A 1 1 0 0 1 0 1 Z" (W3C, Scalable Vector Graphics 1.1, 2011,
/// section 8.3): M, L, H, V, C, S, Q, T, A and Z, in small letters relative to where the pen is. Coordinates
/// stay as they are: y is down in SVG's drawings. Arcs of ellipses become cubic curves within 1e-7 of their
/// radii. What draws nothing is left out.
///
/// Errors: Scene, which names the character that is wrong and what should be there; and where there are more
/// than kMostCurves. Cost: linear.
Result<std::vector<Contour>> pathContours(std::string_view data);

}  // namespace sdf
