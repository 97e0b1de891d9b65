// What a NarrowBand holds, and the surface in it. For .cpp files that know OpenVDB.
#pragma once
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "sdf/mesh/band/narrow_band.h"

namespace sdf {

inline constexpr int kLeaf = openvdb::FloatTree::LeafNodeType::DIM;  // voxels along a leaf

struct CoordHash {
  std::size_t operator()(const openvdb::Coord& c) const { return c.hash<20>(); }
};

/// Of a voxel's slope: a sample this near to zero may be the rounding of a film of no thickness.
inline constexpr float kFilm = 1e-4f;

struct NarrowBand::Grid {
  openvdb::FloatGrid::Ptr grid;  ///< until extraction a leaf's transient data says if it may have films
  double voxelSize = 0.0;
  double lipschitz = std::numeric_limits<double>::infinity();  // over the bounds, where known
  std::unordered_map<openvdb::Coord, LocalTapes, CoordHash> tapes;
  std::uint64_t samples = 0;
  NotNumbers notNumbers;

  /// Slope bound of the distance in a leaf; 1 where none is known, as of a distance.
  double slopeAt(const openvdb::Coord& leaf) const { return slopeOf(*tapes.at(leaf).distance, lipschitz); }
  static double slopeOf(const Tape& distance, double everywhere) {
    const double slope = std::min<double>(distance.lipschitz(), everywhere);
    return std::isfinite(slope) ? slope : 1.0;
  }
};

/// The zero set of a grid by dual marching cubes (Nielson 2004): a point for each patch of surface in a cell,
/// the mean of where it crosses the cell's edges by linear interpolation, and a quad around each crossed edge
/// of the lattice, cut along its shorter diagonal. It has the points and quads of OpenVDB's volumeToMesh
/// (Museth et al. 2013) without adaptivity. Edges count as crossed between two samples of leaves, and between
/// one and a tile. Points and triangles come leaf by leaf, in the tree's order, for any number of threads.
/// Adds leaves where the surface leaves those that there are. Cost: some 1000 instructions a leaf and 300 a
/// quad.
RawSurface extractSurface(openvdb::FloatTree& tree, double voxelSize);

}  // namespace sdf
