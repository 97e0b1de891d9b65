// Gaps in the creases of a mesh.
#pragma once
#include "sdf/mesh/edit/feature_mesh.h"

namespace sdf {

/// Closes gaps in creases, which would grow as vertices go: by edges, whose place was not found exactly,
/// where facets that are no slivers meet at more than 45 degrees, and that do not end loosely. Cost: n log n.
void closeCreases(FeatureMesh& mesh);

}  // namespace sdf
