// The rays of a pinhole camera.
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sdf/scene/scene.h"

namespace sdf::test {

/// A camera that its scene places, with its formulas read, before a picture of this size.
class Pinhole {
 public:
  Pinhole(const Camera& camera, int width, int height);
  glm::dvec3 from() const { return from_; }
  /// Unit direction through the middle of the picture.
  glm::dvec3 ahead() const { return glm::normalize(forward_); }
  /// As far to the right and up.
  glm::dvec3 aside(const glm::dvec2& way) const { return way.x * right_ + way.y * up_; }
  /// Unit direction through a point of the picture, in pixels from its upper left corner.
  glm::dvec3 through(double column, double row) const;

 private:
  int width_, height_;
  glm::dvec3 from_, forward_, right_, up_;  // forward_ is as long as a picture of height 1 is away
};

}  // namespace sdf::test
