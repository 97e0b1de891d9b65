#include "viewer/render/look.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

namespace sdf::viewer {
namespace {

class Reader {
 public:
  explicit Reader(const Parameters& parameters) : parameters_(parameters) {}
  double operator()(const Expr& e) const { return uniformValue(bind(e, parameters_)); }
  glm::dvec3 operator()(const Vec3E& v) const { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }

 private:
  const Parameters& parameters_;
};

LookLight lookOf(const Light& light, const Reader& value) {
  const glm::dvec3 vector = value(light.vector), color = value(light.color) * value(light.intensity);
  const bool point = light.kind == Light::Kind::Point;
  return {glm::vec4(point ? vector : glm::normalize(vector), point ? 1.0 : 0.0),
          glm::vec4(color, light.castsShadow ? 1.0 : 0.0)};
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

Look lookOf(const Scene& scene, const Parameters& parameters) {
  const Reader value(parameters);
  const Camera& c = scene.camera;
  Look look{upright({value(c.from), value(c.to), value(c.up), value(c.fov), c.mirrored}),
            {},
            glm::vec3(value(scene.ambient)),
            glm::vec3(value(scene.fog.color)),
            static_cast<float>(value(scene.fog.density)),
            static_cast<float>(value(scene.shadow.sharpness)),
            static_cast<float>(value(scene.ambientOcclusion.strength))};
  for (const Light& light : scene.lights) look.lights.push_back(lookOf(light, value));
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
