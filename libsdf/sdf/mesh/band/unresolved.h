// What is thinner than a voxel, and so falls between the samples of a band.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/mesh.h"

namespace sdf {

/// Looks at the band's suspects (NarrowBand::suspects) and counts those beside which the surface does pass
/// unseen: solids and gaps thinner than a voxel. Of a distance that never exceeds the true one, each point of
/// the surface lies within half a cell's diagonal of a sample that is a suspect or has a neighbour of the
/// other sign; a suspect is confirmed by seven probes. How thick it is there is measured along the gradient:
/// what holds a ball holds a sample too where voxels are 1 / sqrt(3) as long as the ball is wide. Call before
/// NarrowBand::extract. Fills stats.unresolved, stats.firstUnresolved and stats.resolvingVoxel.
void findUnresolved(const NarrowBand& band, const LocalField& field, Progress& progress, MeshStats& stats);

}  // namespace sdf
