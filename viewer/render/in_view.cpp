#include "viewer/render/in_view.h"

#include "sdf/script/script.h"

namespace sdf::viewer {

LookFunction lookOf(const Scene& scene, const std::filesystem::path& file, const Values& parameters) {
  if (scene.camera.from) return LookFunction(scene, std::nullopt);
  if (scene.parameters.empty()) return LookFunction(scene);
  const auto fixed = loadScene(file, {.values = parameters, .time = 0.0, .fixed = true});
  return fixed ? LookFunction(scene, boundsInView(*fixed)) : LookFunction(scene);
}

}  // namespace sdf::viewer
