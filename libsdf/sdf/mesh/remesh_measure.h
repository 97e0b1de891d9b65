// How far a mesh in the making is from the surface, seen as closely as the field resolves features.
#pragma once
#include <cstdint>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/local_field.h"
#include "sdf/mesh/remesh_topology.h"

namespace sdf {

/// First-order distances at these points, absolute.
std::vector<float> distancesAt(const std::vector<glm::vec3>& points, const LocalField& field,
                               Progress& progress);

struct DenseDistances {
  double largest = 0.0;                  ///< scene units
  double rms = 0.0;                      ///< weighted by area
  std::vector<std::uint32_t> exceeding;  ///< triangles (their first half-edges) beyond the tolerance
  std::vector<std::uint32_t> vertices;   ///< those beyond it themselves
};

/// First-order distances at points all over each triangle, half a voxel (LocalField::Local::voxel) apart at
/// most, and at its corners: features that the field resolves are larger than that. Cost: the area in voxels.
DenseDistances measureDensely(const RemeshTopology& mesh, const LocalField& field, double tolerance,
                              Progress& progress);

}  // namespace sdf
