#include "viewer/render/in_view.h"

namespace sdf::viewer {
namespace {

Result<std::optional<Box>> inViewAt(const Scene& scene, const SceneFile& file, const Values& parameters,
                                    double time) {
  if (scene.parameters.empty()) return boundsInView(scene);
  const auto fixed = file.load({.values = parameters, .tolerant = true, .time = time, .fixed = true});
  if (!fixed) return fixed.error();
  return boundsInView(*fixed);
}

}  // namespace

Result<Box> boxInView(const Scene& scene, const SceneFile& file, const Values& parameters, double time) {
  const auto inView = inViewAt(scene, file, parameters, time);
  if (!inView) return inView.error();
  if (*inView) return **inView;
  return Error{ErrorKind::Scene, file.path.string() +
                                     ": the scene is unbounded, so it cannot all be in view; give "
                                     "bounds({x0,y0,z0}, {x1,y1,z1}) in it, or place the camera"};
}

LookFunction lookOf(const Scene& scene, const SceneFile& file, const Values& parameters) {
  if (scene.camera.from) return LookFunction(scene, std::nullopt);
  const auto inView = inViewAt(scene, file, parameters, 0.0);
  return inView ? LookFunction(scene, *inView) : LookFunction(scene);  // it may have no shape at time 0
}

}  // namespace sdf::viewer
