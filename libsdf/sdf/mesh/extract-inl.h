// The surface of a sparse grid of samples. For .cpp files that know OpenVDB.
#pragma once
#include <openvdb/openvdb.h>

#include "sdf/mesh/narrow_band.h"

namespace sdf {

/// The zero set of a grid by dual marching cubes (Nielson 2004): a point for each patch of surface in a cell,
/// the mean of where it crosses the cell's edges by linear interpolation, and a quad around each crossed edge
/// of the lattice, cut along its shorter diagonal. It has the points and quads of OpenVDB's volumeToMesh
/// (Museth et al. 2013) without adaptivity. Edges count as crossed between two samples of leaves, and between
/// one and a tile. Points and triangles come leaf by leaf, in the tree's order, for any number of threads.
/// Adds leaves where the surface leaves those that there are. Cost: some 1000 instructions a leaf and 300 a
/// quad.
RawSurface extractSurface(openvdb::FloatTree& tree, double voxelSize);

}  // namespace sdf
