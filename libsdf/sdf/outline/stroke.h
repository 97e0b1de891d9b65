// Lines of a width.
#pragma once
#include <vector>

#include "sdf/outline/arc.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// What a stroke along a chain of arcs covers (W3C, Scalable Vector Graphics 1.1, 2011, section 11.4):
/// contours each of which winds once around a part of it, so that their union is all of it
/// (FillRule::NonZero). The last corner of a chain that is not closed is its end. The parallels of arcs are
/// arcs: there is no error but rounding. Dashes are strokes of their own (dashes.h).
///
/// Preconditions: the width is positive; neighbouring corners differ; arcs each only rise or only fall, as
/// those of the result do then. Cost: linear.
std::vector<ArcContour> strokeContours(const ArcContour& chain, bool isClosed, const Stroke& stroke);

}  // namespace sdf
