#include "viewer/reference/cpu_camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/reference/cpu_uniform.h"

namespace sdf::test {

Pinhole::Pinhole(const Camera& camera, int width, int height)
    : width_(width), height_(height), from_(uniform(camera.eye())) {
  const glm::dvec3 ahead = glm::normalize(uniform(camera.to) - from_);
  right_ = glm::normalize(glm::cross(ahead, uniform(camera.up)));
  up_ = glm::cross(right_, ahead);
  if (camera.mirrored) right_ = -right_;
  forward_ = ahead / (2.0 * std::tan(0.5 * glm::radians(uniformValue(camera.fov))));
}

glm::dvec3 Pinhole::through(double column, double row) const {
  const double u = (column - 0.5 * width_) / height_, v = (0.5 * height_ - row) / height_;
  return glm::normalize(u * right_ + v * up_ + forward_);
}

}  // namespace sdf::test
