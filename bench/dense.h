// Meshing without skipping anything: what the sparse mesher is measured against.
#pragma once
#include "handwritten.h"
#include "sdf/mesh/band/narrow_band.h"

namespace sdf::bench {

/// Evaluates every one of n³ voxels of the region (n a multiple of 64), in parallel and by rows, into dense
/// slabs; keeps the leaves that lie within a voxel of the surface, `slope` being a bound on the distance's
/// slope; extracts the surface as the mesher does.
RawSurface meshDensely(RowLoop row, int n, double slope);

}  // namespace sdf::bench
