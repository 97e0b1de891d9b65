// A signed distance as textures for shaders: bricks of samples near the surface, and a coarse grid elsewhere.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sdf/expr/payload.h"
#include "sdf/triangles/distance.h"

namespace sdf {

/// The solid's box, and a quarter of its longest side around it (64 voxels at most), is divided into cells of
/// 4 voxels a side. Cells within a cell's side of the surface have a brick of 5³ samples, a voxel apart; in
/// all others the distance is interpolated between their corners. A voxel of a brick in which that is seen to
/// be off by more than 0.06, as beside sharp edges, has a brick of its own, and so once more; as long as that
/// is no more than as many again and 16,384. In a cell without a brick the distance is too large by 3 s^2 /
/// (8 D) at most, where s is a cell's side and D >= s the least distance in the cell: no ray that goes so far
/// passes a wall of more than 1.5 voxels.
struct Bricks {
  double voxel = 0.0;      ///< scene units
  glm::dvec3 origin{0.0};  ///< the first cell's least corner
  glm::ivec3 cells{0};     ///< along each axis
  glm::ivec3 columns{0};   ///< of bricks, in their texture
  std::size_t count = 0;   ///< bricks
  /// How far off interpolated distances are seen to be, within a voxel of the surface: at most, and in the
  /// root of the mean square.
  double worst = 0.0, rms = 0.0;
  /// At the cells' corners: the distance, and the brick of the cell that begins there or -1, or -2 - i, where
  /// the i-th table says more; behind them the tables, of the bricks of a cube's 4³ parts and that of the
  /// whole cube; and the samples of all bricks, in voxels.
  std::vector<PayloadVolume> volumes{{"Grid", {}, 2, false, {}}, {"Bricks", {}, 1, true, {}}};

  /// GLSL of `float NAME(vec3 p)` and `vec3 NAMESlopes(vec3 p)`; see Payload::glsl.
  std::string glsl(const std::string& name) const;
};

/// Samples the distance with so many voxels along the longest side of its box. Cost: some 0.3 microseconds a
/// sample, on all cores; the samples grow with the surface.
Bricks bricksOf(const TriangleDistance& distance, int voxels);

}  // namespace sdf
