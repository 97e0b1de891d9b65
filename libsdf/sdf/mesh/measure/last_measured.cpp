#include "sdf/mesh/measure/last_measured.h"

#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/to_mesh.h"

namespace sdf {

const std::vector<float>& LastMeasured::fromMesh(const FeatureMesh& mesh, const LocalField& field,
                                                 Progress& progress, MeshStats& stats) {
  if (!mesh_.holds(mesh, field)) {
    distances_ = measureDistance(mesh.positions, mesh.triangles, field, progress, stats_);
    mesh_ = {&field, mesh.positions, mesh.triangles};
  }
  stats.rmsDistance = stats_.rmsDistance;
  stats.maxDistance = stats_.maxDistance;
  stats.farthest = stats_.farthest;
  return distances_;
}

const std::vector<FarPoint>& LastMeasured::fromSurface(const std::vector<glm::vec3>& points,
                                                       const FeatureMesh& mesh, const LocalField& field,
                                                       double size, Progress& progress) {
  if (!surface_.holds(mesh, field)) {
    far_ = farthestOfSurface(points, field, size, mesh.positions, mesh.triangles, progress);
    surface_ = {&field, mesh.positions, mesh.triangles};
  }
  return far_;
}

}  // namespace sdf
