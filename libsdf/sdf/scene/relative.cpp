#include "sdf/scene/relative.h"

#include "sdf/shape/operators/place.h"

namespace sdf {

Scene relativeTo(const Scene& scene, const glm::dvec3& origin) {
  if (origin == glm::dvec3(0.0)) return scene;
  Scene result = scene;
  for (Part& part : result.parts) part.shape = relativeTo(part.shape, origin);
  if (result.bounds) result.bounds = Box{result.bounds->min - origin, result.bounds->max - origin};
  if (result.camera.from) {
    result.camera.from = *result.camera.from - Vec3E(origin);
    result.camera.to = result.camera.to - Vec3E(origin);
  }
  for (Light& light : result.lights)
    if (light.kind == Light::Kind::Point) light.vector = light.vector - Vec3E(origin);
  return result;
}

}  // namespace sdf
