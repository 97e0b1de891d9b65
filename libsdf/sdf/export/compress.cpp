#include "sdf/export/compress.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdf/meshfile/meshopt.h"

namespace sdf {
namespace {

/// What rounding may add to the error of the mesh.
constexpr double kShare = 0.1;
/// Half a cell's diagonal, in steps.
constexpr double kFarthest = 0.5 * std::numbers::sqrt3;
/// Bits that the largest coordinate has on the finest grid, and fewer on the coarsest.
constexpr int kMostBits = 22, kFewer = 16;
/// encodePoints takes none below.
constexpr int kLeastExponent = -126;

double largestCoordinate(const Mesh& mesh) {
  float largest = 0.0f;
  for (const glm::vec3& p : mesh.positions)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

int gridFor(const ExportPart& part) {
  // The largest coordinate is below 2^exponent.
  int exponent = 0;
  std::frexp(largestCoordinate(part.mesh), &exponent);
  const int finest = std::max(exponent - kMostBits, kLeastExponent);
  double most = kShare * part.stats.rmsDistance;
  if (part.stats.tolerance > part.stats.maxDistance)
    most = std::min(most, part.stats.tolerance - part.stats.maxDistance);
  const double wished = most / kFarthest;
  return wished > 0.0 ? std::clamp(std::ilogb(wished), finest, finest + kFewer) : finest;
}

}  // namespace

void compress(ExportPart& part) {
  part.grid = gridFor(part);
  const int grid = *part.grid;
  const auto rounded = [&](float v) { return std::ldexp(std::nearbyint(std::ldexp(v, -grid)), grid); };
  for (glm::vec3& p : part.mesh.positions) p = {rounded(p.x), rounded(p.y), rounded(p.z)};
  const double farthest = kFarthest * std::ldexp(1.0, grid);
  part.stats.rmsDistance += farthest;
  part.stats.maxDistance += farthest;
  if (part.stats.provenDistance > 0.0) part.stats.provenDistance += farthest;
}

}  // namespace sdf
