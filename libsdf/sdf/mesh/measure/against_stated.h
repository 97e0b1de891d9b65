// Is a mesh that of the shape, and within what is stated of it?
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "sdf/base/box.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/mesh.h"
#include "sdf/model/model.h"

namespace sdf {

/// A measured mesh. Places are named relative to the scene's origin.
struct MeasuredMesh {
  const FeatureMesh& mesh;
  std::span<const float> distances;  ///< of its vertices to the surface
  const MeshStats& stats;            ///< distances and topology
  Box bounds;                        ///< stated of the shape
  double voxel;
  glm::dvec3 origin{0.0};  ///< in the scene
};

/// "(1, 2, 3)"
std::string shownPlace(const glm::dvec3& p);

/// What is wrong with the mesh, and what to do: it leaves the bounds, is torn open, or farther from the
/// surface than kFarthestVoxels and the tolerance. The slope that is stated of the distance is blamed only
/// where a secant of it is steeper. Nothing where it is the shape's. Cost: linear in the vertices; where
/// there is a fault that of steepestAround.
std::optional<std::string> faultOf(const MeasuredMesh& m, const ModelTapes& model);

}  // namespace sdf
