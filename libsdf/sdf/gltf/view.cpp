#include "sdf/gltf/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace sdf {
namespace {

glm::dvec3 valueOf(const Vec3E& v) { return {uniformValue(v.x), uniformValue(v.y), uniformValue(v.z)}; }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Unit vector along v, if v has a direction.
std::optional<glm::dvec3> direction(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return v / length;
}

/// Turns -Z to `forward` with +Y as near to `up` as can be; an `up` along `forward` gives way to another
/// axis.
glm::dquat lookAlong(const glm::dvec3& forward, const glm::dvec3& up) {
  std::optional<glm::dvec3> right = direction(glm::cross(forward, up));
  constexpr double kParallel = 1e-9;  // sine below which a cross product of doubles has lost its direction
  if (!right || glm::length(glm::cross(forward, direction(up).value_or(forward))) < kParallel) {
    const glm::dvec3 other = std::abs(forward.y) < 0.5 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    right = direction(glm::cross(forward, other));
  }
  return glm::normalize(glm::quat_cast(glm::dmat3(*right, glm::cross(*right, forward), -forward)));
}

}  // namespace

std::optional<ViewCamera> viewCamera(const Scene& scene) {
  return viewCamera(scene, scene.camera.from ? std::nullopt : boundsInView(scene));
}

std::optional<ViewCamera> viewCamera(const Scene& scene, const std::optional<Box>& box) {
  const glm::dvec3 from = valueOf(scene.camera.eye());
  const glm::dvec3 up = valueOf(scene.camera.up);
  const double fov = uniformValue(scene.camera.fov);
  const std::optional<glm::dvec3> forward = direction(valueOf(scene.camera.to) - from);
  const double most = scene.maxDistance.value_or(1.0);
  const bool usable =
      forward && finite(from) && finite(up) && fov > 0.0 && fov < 180.0 && most > 0.0 && std::isfinite(most);
  if (!usable) return std::nullopt;
  ViewCamera camera{{from, lookAlong(*forward, up)}, glm::radians(fov), 0.0, 0.0};
  if (const std::optional<Box> inView = scene.camera.from ? std::nullopt : box) {
    const double radius = viewRadius(*inView);
    glm::dmat3 axes = glm::mat3_cast(camera.placement.rotation);
    axes[2] = *forward;
    const double distance = fittingDistance(*inView, axes, camera.verticalFov, kPictureAspect);
    camera.placement.position = inView->centre() - distance * *forward;
    camera.far = std::max(viewLengths(scene, radius).maxDistance, distance + radius);
  } else {
    camera.far = viewLengths(scene, std::nullopt).maxDistance;
  }
  camera.near = 1e-4 * camera.far;
  return camera;
}

std::vector<ViewLight> viewLights(const Scene& scene, const glm::dvec3& centre) {
  std::vector<ViewLight> lights;
  for (const Light& light : scene.lights) {
    const glm::dvec3 vector = valueOf(light.vector);
    const glm::dvec3 color = glm::max(valueOf(light.color), glm::dvec3(0.0));
    const double peak = std::max({color.x, color.y, color.z});
    double intensity = uniformValue(light.intensity) * peak * std::numbers::pi;
    Placement placement;
    if (light.kind == Light::Kind::Point) {
      placement.position = vector;
      intensity *= glm::dot(vector - centre, vector - centre);
    } else if (const std::optional<glm::dvec3> towards = direction(vector)) {
      placement.rotation = lookAlong(-*towards, {0.0, 1.0, 0.0});
    } else {
      continue;
    }
    if (!finite(vector) || !finite(color) || !(intensity > 0.0) || !std::isfinite(intensity)) continue;
    lights.push_back({light.kind, placement, color / peak, intensity});
  }
  return lights;
}

}  // namespace sdf
