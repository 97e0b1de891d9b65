#include "sdf/triangles/brick_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sdf {

Cube partOf(const Cube& cube, int i) {
  const double side = cube.side / kCell;
  return {cube.low + side * glm::dvec3(i % kCell, i / kCell % kCell, i / (kCell * kCell)), side};
}

BrickSamples::BrickSamples(const TriangleDistance& distance, const glm::dvec3& origin, double voxel,
                           const Cube& cube)
    : along_(distance), origin_(origin), voxel_(voxel), cube_(cube), spacing_(cube.side / kCell) {
  for (int z = 0; z < kBrick; ++z)
    for (int y = 0; y < kBrick; ++y)
      for (int k = 0; k < kBrick; ++k) {
        const int x = y % 2 == 0 ? k : kBrick - 1 - k;
        samples_[z][y][x] = read({x, y, z});
      }
}

ValueAndGradient BrickSamples::read(const glm::dvec3& at) {
  const TriangleDistance::Read read = along_(origin_ + voxel_ * (cube_.low + spacing_ * at));
  return {read.distance / voxel_, read.gradient};
}

std::vector<PartError> BrickSamples::errors() {
  std::vector<PartError> all;
  for (int z = 0; z < kCell; ++z)
    for (int y = 0; y < kCell; ++y)
      for (int x = 0; x < kCell; ++x) look({x, y, z}, all);
  return all;
}

// Were all slopes in the part those at its corners, interpolation would be off by no more than this.
double BrickSamples::bend(const glm::ivec3& part) const {
  glm::dvec3 mean(0.0);
  for (int c = 0; c < 8; ++c) mean += 0.125 * corner(part, c).gradient;
  double most = 0.0;
  for (int c = 0; c < 8; ++c) most = std::max(most, glm::distance(corner(part, c).gradient, mean));
  return kHalfDiagonal * spacing_ * most;
}

// At its middle and, where slopes differ, in the middles of its sides and edges.
void BrickSamples::look(const glm::ivec3& part, std::vector<PartError>& all) {
  constexpr double kStraight = 0.09;  // voxels: beside a kink that bends so far hardly half is off
  double mean = 0.0;
  int inside = 0, points = 8;
  for (int c = 0; c < 8; ++c) {
    mean += 0.125 * corner(part, c).value;
    inside += corner(part, c).value < 0.0;
  }
  const double reach = kHalfDiagonal * spacing_;  // from a point that is looked at to those around it
  if (std::abs(mean) > 1.0 + 2.0 * reach) return;
  PartError error{(part.z * kCell + part.y) * kCell + part.x};
  const bool straight = bend(part) < kStraight;
  for (int i = 0; i < 27; ++i) {
    const glm::ivec3 at(i % 3, i / 3 % 3, i / 9);  // in halves
    const bool isMiddle = at == glm::ivec3(1), isCorner = at.x != 1 && at.y != 1 && at.z != 1;
    if (isCorner || (straight && !isMiddle)) continue;
    const glm::dvec3 w = 0.5 * glm::dvec3(at);
    double interpolated = 0.0;
    for (int c = 0; c < 8; ++c)
      interpolated += ((c & 1) != 0 ? w.x : 1.0 - w.x) * ((c & 2) != 0 ? w.y : 1.0 - w.y) *
                      ((c & 4) != 0 ? w.z : 1.0 - w.z) * corner(part, c).value;
    const double truth = read(glm::dvec3(part) + w).value, off = std::abs(truth - interpolated);
    ++points, inside += truth < 0.0;
    if (std::abs(truth) > 1.0 + reach) continue;
    error.worst = std::max(error.worst, off);
    if (isMiddle) error.middle = off;
  }
  error.crossed = inside > 0 && inside < points;
  all.push_back(error);
}

}  // namespace sdf
