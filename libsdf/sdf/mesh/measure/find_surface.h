// How far points near a surface are from it.
#pragma once

#include "sdf/mesh/surface/surface_points.h"

namespace sdf {

/// Voxels from any point of a mesh to a sample of the lattice on the surface's other side, at most, where the
/// samples are the shape's. A triangle lies in the cells around a lattice edge that the surface crosses:
/// sqrt(3) to the edge's farther end. Refinement moves it by one.
inline constexpr double kFarthestVoxels = 3.0;

/// Where the surface is looked for.
enum class Look {
  Near,       ///< where the first order says, and around where that says little
  AllAround,  ///< in all directions whatever the first order says: some hundred readings a point
  Closely     ///< and around the nearest place that was met, ever more closely: some thousand readings
};

/// The distance of each point of a run to where the sign changes, negative inside. It is the first-order one
/// (Taubin 1994) where the sign changes along the gradient within a tenth of it, and, below a hundredth of a
/// voxel, in any direction within twice of it, or within eight times and such a hundredth inwards of a tip.
/// Elsewhere, and above half a voxel, the surface is looked for where the field's branches meet by first
/// order (edges, corners), along the gradient, and at the samples of the lattice up to kFarthestVoxels away,
/// and from what is found along its normal: an upper bound. Where nothing is found the first-order figure
/// stays; it may be infinite, or no number. A reading of 0 is on the surface. Other looks do so from all that
/// is above a hundredth of a voxel.
void findSurface(const PointRun& run, float* distances, Look look = Look::Near);

}  // namespace sdf
