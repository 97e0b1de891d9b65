// How large a mesh is, and where it balances.
#pragma once
#include "sdf/mesh/mesh.h"

namespace sdf {

/// Area, and of a watertight mesh the volume and the centre of mass of what it encloses, by the divergence
/// theorem (Mirtich 1996): what overlaps counts twice. Exact up to rounding. Fills these of the stats, which
/// know whether it is watertight. Cost: linear.
void measureSolid(const Mesh& mesh, MeshStats& stats);

}  // namespace sdf
