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

/// What is wrong with a mesh, and what to do.
struct MeshFault {
  std::string what;
  glm::dvec3 at;  ///< relative as the mesh is
};

/// The point that is farthest outside of the bounds, if that is farther than is allowed.
std::optional<glm::vec3> farthestOutside(std::span<const glm::vec3> points, const Box& bounds,
                                         double allowed);

/// The surface leaves the bounds. Nothing where it does not.
std::optional<MeshFault> leavesBounds(const MeasuredMesh& m);

/// The mesh leaves the bounds, is torn open, or farther from the surface than kFarthestVoxels and the
/// tolerance. The slope that is stated of the distance is blamed only where a secant of it is steeper.
/// Nothing where the mesh is the shape's. Cost: linear in the vertices; where there is a fault that of
/// steepestAround.
std::optional<MeshFault> faultOf(const MeasuredMesh& m, const ModelTapes& model);

}  // namespace sdf
