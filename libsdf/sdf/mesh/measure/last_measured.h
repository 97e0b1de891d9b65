// What was measured of a mesh, kept for who asks again.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/measure/climb.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Keeps what was measured last, from the mesh and from the surface. It holds for a mesh with the same
/// positions and triangles in the same field; a reference is good until something else is measured.
class LastMeasured {
 public:
  /// measureDistance, and what that fills of the stats.
  const std::vector<float>& fromMesh(const FeatureMesh& mesh, const LocalField& field, Progress& progress,
                                     MeshStats& stats);
  /// farthestOfSurface, of these points or of those that the same mesh was asked about before.
  const std::vector<FarPoint>& fromSurface(const std::vector<glm::vec3>& points, const FeatureMesh& mesh,
                                           const LocalField& field, double size, Progress& progress);

 private:
  struct Key {
    const LocalField* field = nullptr;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    bool holds(const FeatureMesh& mesh, const LocalField& in) const {
      return field == &in && positions == mesh.positions && triangles == mesh.triangles;
    }
  };
  Key mesh_, surface_;
  MeshStats stats_;
  std::vector<float> distances_;
  std::vector<FarPoint> far_;
};

}  // namespace sdf
