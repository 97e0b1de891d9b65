// What a NarrowBand holds. For the .cpp files of NarrowBand only.
#pragma once
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "sdf/mesh/narrow_band.h"

namespace sdf {

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

}  // namespace sdf
