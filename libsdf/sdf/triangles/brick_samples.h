// The samples of one brick. Private to triangles/.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/expr/payload.h"
#include "sdf/triangles/distance.h"

namespace sdf {

/// A brick's cube is divided into 4³ parts, between whose corners its 5³ samples are interpolated.
inline constexpr int kCell = 4, kBrick = kCell + 1, kParts = kCell * kCell * kCell;
inline constexpr double kHalfDiagonal = 0.8660254038;

/// A cube that has a brick, in voxels from the least corner of all.
struct Cube {
  glm::dvec3 low;
  double side;
};

/// The i-th of its parts, along x first, then y, then z.
Cube partOf(const Cube& cube, int i);

/// The error of interpolation within a voxel of the surface, in voxels, at the points that were looked at: at
/// most, and in the middle of a part.
struct PartError {
  int part = 0;
  double worst = 0.0, middle = 0.0;
  bool crossed = false;  ///< by the surface, as the part's corners and these points show
};

/// Samples of a cube, of the distance in voxels.
class BrickSamples {
 public:
  BrickSamples(const TriangleDistance& distance, const glm::dvec3& origin, double voxel, const Cube& cube);

  double value(const glm::ivec3& at) const { return samples_[at.z][at.y][at.x].value; }
  /// The errors of all parts that have points within a voxel of the surface.
  std::vector<PartError> errors();

 private:
  ValueAndGradient read(const glm::dvec3& at);
  const ValueAndGradient& corner(const glm::ivec3& part, int c) const {
    return samples_[part.z + (c >> 2)][part.y + (c >> 1 & 1)][part.x + (c & 1)];
  }
  double bend(const glm::ivec3& part) const;
  void look(const glm::ivec3& part, std::vector<PartError>& all);

  DistanceAlong along_;
  glm::dvec3 origin_;
  double voxel_;
  Cube cube_;
  double spacing_;  // of the samples, voxels
  ValueAndGradient samples_[kBrick][kBrick][kBrick];
};

}  // namespace sdf
