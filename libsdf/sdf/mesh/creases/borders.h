// Cutting a mesh along the borders of its paint.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Fills mesh.materials, and makes creases where materials meet or where colours jump by more than
/// kColorJump. Triangles that show more than one paint at their corners, a little inside, are cut, at points
/// found by halving along their edges to 1/128 of these; one with three paints around a point inside it.
/// Those that a border does not cross straight, as where it has a corner or four squares of a board meet, are
/// divided before, into edges of a sixteenth. What is narrower than an edge may be missed, and where pieces
/// would cross edges stay whole. Positions that were there stay. Returns the positions of the borders'
/// vertices, which other creases do not have. Cost: a reading for each corner; n log n.
std::vector<glm::vec3> cutAtBorders(FeatureMesh& mesh, const LocalField& field, Progress& progress);

}  // namespace sdf
