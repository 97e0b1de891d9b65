#include "viewer/render/scene_mesh.h"

#include <utility>

#include "sdf/mesh/mesher.h"

namespace sdf::viewer {

Result<SceneMesh> meshScene(Scene scene, const MeshSettings& settings, Progress& progress) {
  const auto size = exportSize(scene.parts, scene.bounds, progress);
  if (!size) return size.error();
  const bool uniform = settings.voxelSize && !settings.tolerance;
  const bool ofDiagonal = settings.toleranceOfDiagonal || !settings.tolerance;
  const double asked = settings.tolerance.value_or(kDefaultTolerance);
  const double tolerance = uniform ? 0.0 : asked * (ofDiagonal ? size->diagonal : 1.0);
  const MeshOptions options{.voxelSize = settings.voxelSize.value_or(size->voxelSize),
                            .tolerance = tolerance,
                            .strict = settings.tolerance.has_value(),
                            .keepsFiles = !settings.tolerance,
                            .bounds = scene.bounds};
  SceneMesh result{std::move(scene), {}, tolerance, size->diagonal};
  for (const Part& part : result.scene.parts) {
    auto meshed = meshShape(part.shape, part.name, options, progress);
    if (!meshed) return meshed.error();
    if (tolerance > 0.0) meshed->stats.tolerance = tolerance;
    result.parts.push_back({part.name, std::move(meshed->mesh), meshed->stats});
  }
  return result;
}

}  // namespace sdf::viewer
