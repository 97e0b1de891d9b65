// The border of what contours wind around.
#pragma once
#include <vector>

#include "sdf/base/result.h"
#include "sdf/outline/arc.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// Contours that neither cross nor lie on each other, with the inside of the given ones to their left: what
/// the rule says of their winding number. They may touch in points. None where nothing is inside.
///
/// Arcs are cut where they meet. Between two cuts the winding number on either side stays the same, and what
/// has the inside on one side alone is border. Points nearer to each other than 1e-10 of the size of all are
/// one. So contours that meet nowhere remain as they were. Arcs must each only rise or only fall. Error:
/// Scene, where the pieces do not close, as may be where arcs all but lie on each other. Cost: some log n an
/// arc, and as many tests as boxes of arcs meet.
Result<std::vector<ArcContour>> boundaryOf(const std::vector<ArcContour>& contours, FillRule rule);

}  // namespace sdf
