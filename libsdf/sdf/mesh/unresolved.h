// Surface that the samples do not see.
#pragma once
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/narrow_band.h"
#include "sdf/mesh/surface_points.h"

namespace sdf {

/// Looks at the band's suspects (NarrowBand::suspects) and counts those beside which the surface does pass
/// unseen: solids and gaps thinner than a voxel. Of a distance that never exceeds the true one, each point of
/// the surface lies within half a cell's diagonal of a sample that is a suspect or has a neighbour of the
/// other sign; a suspect is confirmed by seven probes. Call before NarrowBand::extract. Fills
/// stats.unresolved and stats.firstUnresolved.
void findUnresolved(const NarrowBand& band, const LocalField& field, Progress& progress, MeshStats& stats);

}  // namespace sdf
