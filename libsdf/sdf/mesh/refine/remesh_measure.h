// How far a mesh in the making is from the surface, seen as closely as the field resolves features.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// First-order distances at these points, absolute.
std::vector<float> distancesAt(const std::vector<glm::vec3>& points, const LocalField& field,
                               Progress& progress);

struct DenseDistances {
  double largest = 0.0;                  ///< scene units
  std::vector<std::uint32_t> exceeding;  ///< triangles (their first half-edges) beyond the tolerance
  std::vector<std::uint32_t> vertices;   ///< those beyond it themselves
};

/// What was read of a triangle, for as long as its corners stay where they are.
struct TriangleDistances {
  std::array<glm::vec3, 3> corners{};
  std::array<float, 3> atCorners{};
  float largest = 0.0f;
  bool known = false;
};

/// First-order distances at points all over each triangle, half a voxel (LocalField::Local::voxel) apart at
/// most, and at its corners: features that the field resolves are larger than that. What is to be left as it
/// is (Hold) is passed over. Triangles that are as
/// they were in `known`, by number, are not read again. Cost: the area of the others in voxels.
DenseDistances measureDensely(const HalfEdgeMesh& mesh, const LocalField& field, double tolerance,
                              std::vector<TriangleDistances>& known, Progress& progress);

}  // namespace sdf
