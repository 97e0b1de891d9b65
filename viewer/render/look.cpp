#include "viewer/render/look.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace sdf::viewer {
namespace {

// All of a look that is computed, in the order in which Reader takes it.
std::vector<Expr> numbersOf(const Scene& scene) {
  std::vector<Expr> numbers;
  const auto add = [&](const Vec3E& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
  for (const Vec3E& v : {scene.camera.from, scene.camera.to, scene.camera.up, scene.ambient, scene.fog.color})
    add(v);
  numbers.insert(numbers.end(), {scene.camera.fov, scene.fog.density, scene.shadow.sharpness,
                                 scene.ambientOcclusion.strength});
  for (const Light& light : scene.lights) {
    add(light.vector);
    add(light.color);
    numbers.push_back(light.intensity);
  }
  return numbers;
}

/// Takes one value after the other.
class Reader {
 public:
  explicit Reader(const std::vector<double>& values) : next_(values.begin()) {}
  double number() { return *next_++; }
  glm::dvec3 vector() {
    const glm::dvec3 v(next_[0], next_[1], next_[2]);
    next_ += 3;
    return v;
  }

 private:
  std::vector<double>::const_iterator next_;
};

LookLight read(const Light& light, Reader& values) {
  const glm::dvec3 vector = values.vector(), color = values.vector();
  const bool point = light.kind == Light::Kind::Point;
  return {glm::vec4(point ? vector : glm::normalize(vector), point ? 1.0 : 0.0),
          glm::vec4(color * values.number(), light.castsShadow ? 1.0 : 0.0)};
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

LookFunction::LookFunction(const Scene& scene)
    : numbers_(numbersOf(scene)), lights_(scene.lights), mirrored_(scene.camera.mirrored) {}

Look LookFunction::at(const Values& values) const {
  const std::vector<double> numbers = numbers_.uniform(values);
  Reader next(numbers);
  Look look;
  look.eye.from = next.vector();
  look.eye.to = next.vector();
  look.eye.up = next.vector();
  look.ambient = glm::vec3(next.vector());
  look.fogColor = glm::vec3(next.vector());
  look.eye.fov = next.number();
  look.eye.mirrored = mirrored_;
  look.eye = upright(look.eye);
  look.fogDensity = static_cast<float>(next.number());
  look.sharpness = static_cast<float>(next.number());
  look.occlusionStrength = static_cast<float>(next.number());
  for (const Light& light : lights_) look.lights.push_back(read(light, next));
  return look;
}

std::string textOf(const Eye& eye) {
  char fov[32];
  std::snprintf(fov, sizeof fov, "%.6g", eye.fov);
  std::string line = "camera { from = " + text(eye.from) + ", to = " + text(eye.to);
  if (eye.up != glm::dvec3(0.0, 1.0, 0.0)) line += ", up = " + text(eye.up);
  return line + ", fov = " + fov + (eye.mirrored ? ", mirrored = true }" : " }");
}

}  // namespace sdf::viewer
