// How well triangles that show the surface's colours at their corners show them in between.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Do all triangles with a side longer than a voxel (LocalField::Local::voxel) show the colours of the
/// surface within kColorTolerance, if their corners show those that are there? Looks at places half a voxel
/// apart, and kBorderTolerances times `tolerance`, which is the distance's, from the triangles' sides. Cost:
/// the area in voxels.
bool keepsColors(const FeatureMesh& mesh, double tolerance, const LocalField& field, Progress& progress);

}  // namespace sdf
