// Looking for the edges and corners of a surface from points near it.
#pragma once
#include <vector>

#include "sdf/mesh/measure/search.h"

namespace sdf {

/// Where the sign changes on the way from each of at most kBatchPoints points to the edge or the
/// corner where the field's branches meet by first order: planes on which each is 0, up to three of them;
/// nowhere where that is more than kFarthestVoxels away. A way ends a little behind, where the next branch
/// is found.
std::vector<Met> meetBranches(const PointRun& run, const std::vector<Way>& points);

}  // namespace sdf
