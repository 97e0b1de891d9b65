// Points that a mesh of a surface has, and that another one is to meet.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/to_mesh.h"

namespace sdf {

/// A mesh's vertices, points that were found on the surface, and points of the borders of its paint.
class Witnesses {
 public:
  /// All of these points.
  Witnesses(const std::vector<glm::vec3>& surface, const FeatureMesh& mesh, std::vector<glm::vec3> borders);

  /// Points of the surface, that were found since.
  void add(const std::vector<glm::vec3>& surface);

  /// Points of the surface.
  const std::vector<glm::vec3>& surface() const { return surface_; }

  /// The largest distance from a witness to another mesh's triangles, at least one.
  SurfaceDistance toSurface(const FeatureMesh& mesh, Progress& progress) const;
  /// The same from a point of a border to another mesh's creases, which its borders are among; infinite if
  /// that has none, 0 if there are no such points.
  double toBorders(const FeatureMesh& mesh, Progress& progress) const;

 private:
  std::vector<glm::vec3> surface_, borders_;
};

}  // namespace sdf
