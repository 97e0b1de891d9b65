// Gaps in the creases of a mesh.
#pragma once
#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// Closes gaps in creases, which would grow as vertices go: by edges, whose place was not found exactly,
/// where facets that are no slivers meet at more than 45 degrees, that do not end loosely, and that join a
/// crease. Cost: n log n, and as often a look at such edges as the longest gap has.
void closeCreases(FeatureMesh& mesh);

}  // namespace sdf
