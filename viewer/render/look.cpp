#include "viewer/render/look.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace sdf::viewer {
namespace {

// All of a look that is computed, in the order in which LookFunction::at takes it.
std::vector<Expr> numbersOf(const Scene& scene) {
  std::vector<Expr> numbers;
  const auto add = [&](const Vec3E& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
  for (const Vec3E& v :
       {scene.camera.eye(), scene.camera.to, scene.camera.up, scene.ambient, scene.fog.color})
    add(v);
  numbers.insert(numbers.end(), {scene.camera.fov, scene.camera.aperture, scene.camera.focus.value_or(0.0),
                                 scene.fog.density, scene.shadow.sharpness, scene.ambientOcclusion.strength});
  for (const Light& light : scene.lights) {
    add(light.vector);
    add(light.color);
    numbers.insert(numbers.end(), {light.intensity, light.radius});
  }
  return numbers;
}

std::string text(const glm::dvec3& v) {
  char line[96];
  std::snprintf(line, sizeof line, "{%.6g, %.6g, %.6g}", v.x, v.y, v.z);
  return line;
}

}  // namespace

Eye upright(Eye eye) {
  constexpr double kParallel = 1e-12;
  const glm::dvec3 way = glm::normalize(eye.to - eye.from);
  if (glm::length(glm::cross(way, eye.up)) > kParallel * glm::length(eye.up)) return eye;
  eye.up = std::abs(way.z) > 0.5 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, way.y > 0.0 ? 1.0 : -1.0);
  return eye;
}

Eye fitted(Eye eye, const Box& box, double aspect) {
  const Axes axes = axesOf(eye);
  const glm::dmat3 columns(axes.right, axes.up, axes.forward);
  eye.to = box.centre();
  eye.from = eye.to - fittingDistance(box, columns, glm::radians(eye.fov), aspect) * axes.forward;
  eye.focus.reset();
  eye.fittedRadius = viewRadius(box);
  return eye;
}

Axes axesOf(const Eye& eye) {
  const glm::dvec3 forward = glm::normalize(eye.to - eye.from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, eye.up));
  return {eye.mirrored ? -right : right, glm::cross(right, forward), forward};
}

Look relativeTo(Look look, const glm::dvec3& origin) {
  look.eye.from -= origin;
  look.eye.to -= origin;
  for (LookLight& light : look.lights)
    if (light.vector.w > 0.0) light.vector -= glm::dvec4(origin, 0.0);
  return look;
}

// At 2^9 ways to what is looked at floats are up to 2^-14 of this way apart, a tenth of a pixel in pictures
// of a thousand rows at the usual field of view.
glm::dvec3 originFor(const Eye& eye, const glm::dvec3& present) {
  constexpr double kFar = 0x1p9;
  const glm::dvec3 reach = glm::max(glm::abs(eye.from - present), glm::abs(eye.to - present));
  if (std::max({reach.x, reach.y, reach.z}) <= kFar * glm::length(eye.to - eye.from)) return present;
  return eye.to;
}

LookFunction::LookFunction(const Scene& scene, const std::optional<Box>& inView)
    : numbers_(numbersOf(scene)),
      lights_(scene.lights),
      mirrored_(scene.camera.mirrored),
      inView_(scene.camera.from ? std::nullopt : inView) {}

Look LookFunction::at(const Values& values, double aspect) const {
  const std::vector<double> numbers = numbers_.uniform(values);
  auto next = numbers.begin();
  const auto number = [&] { return *next++; };
  const auto vector = [&] { return glm::dvec3{number(), number(), number()}; };  // braces keep the order
  Look look;
  look.eye.from = vector();
  look.eye.to = vector();
  look.eye.up = vector();
  look.ambient = glm::vec3(vector());
  look.fogColor = glm::vec3(vector());
  look.eye.fov = number();
  look.eye.mirrored = mirrored_;
  look.eye.aperture = number();
  if (const double focus = number(); focus > 0.0) look.eye.focus = focus;
  look.eye = upright(look.eye);
  if (inView_) look.eye = fitted(look.eye, *inView_, aspect);
  look.fogDensity = static_cast<float>(number());
  look.sharpness = static_cast<float>(number());
  look.occlusionStrength = static_cast<float>(number());
  for (const Light& light : lights_) {
    const bool point = light.kind == Light::Kind::Point;
    const glm::dvec3 place = vector(), color = vector();
    look.lights.push_back({glm::dvec4(point ? place : glm::normalize(place), point ? 1.0 : 0.0),
                           glm::vec4(color * number(), light.castsShadow ? 1.0 : 0.0)});
    const double radius = number();
    look.lights.back().size = static_cast<float>(point ? radius : std::sin(glm::radians(radius)));
  }
  return look;
}

std::string textOf(const Eye& eye) {
  const auto field = [](const char* name, double value) {
    char text[48];
    std::snprintf(text, sizeof text, ", %s = %.6g", name, value);
    return std::string(text);
  };
  std::string line = "camera { from = " + text(eye.from) + ", to = " + text(eye.to);
  if (eye.up != glm::dvec3(0.0, 1.0, 0.0)) line += ", up = " + text(eye.up);
  line += field("fov", eye.fov);
  if (eye.mirrored) line += ", mirrored = true";
  if (eye.aperture > 0.0) line += field("aperture", eye.aperture);
  if (eye.focus) line += field("focus", *eye.focus);
  return line + " }";
}

}  // namespace sdf::viewer
