// Small files: positions in as few bits as the mesh's accuracy is worth.
#pragma once
#include "sdf/gltf/part.h"

namespace sdf {

/// Has .glb and .gltf files hold the part compressed, by EXT_meshopt_compression and KHR_mesh_quantization,
/// which readers then must know. Fills ExportPart::grid and rounds the positions to whole steps of 2^grid:
/// the largest power of two of which half a cell's diagonal, the farthest that a point moves, is at most a
/// tenth of stats.rmsDistance, and what stats.maxDistance leaves of a tolerance that is kept, within 22 and 6
/// binary digits of the largest coordinate. That length is added to rmsDistance and maxDistance, as no point
/// of the mesh moves by more. Points that were equal stay so. Other formats hold the rounded positions.
/// Precondition: finite positions.
void compress(ExportPart& part);

}  // namespace sdf
