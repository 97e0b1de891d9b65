#include "viewer/app/orbit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace sdf::viewer {
namespace {

// The steepest view, from the horizon: at the zenith itself, `up` would not say which way is up.
const double kSteepest = glm::half_pi<double>() - 1e-4;
const double kTurnOfHeight = glm::pi<double>();
constexpr double kDolly = 0.9;
constexpr double kNearest = 1e-12, kFarthest = 1e12;  // of a dolly, scene units

Eye shifted(Eye eye, const glm::dvec3& shift) {
  eye.from += shift;
  eye.to += shift;
  return eye;
}

/// The direction turned leftwards about `pole` and then raised towards it.
glm::dvec3 rotated(const glm::dvec3& direction, const glm::dvec3& up, double left, double raised) {
  const glm::dvec3 pole = glm::normalize(up), d = glm::angleAxis(left, pole) * direction;
  const glm::dvec3 level = d - glm::dot(d, pole) * pole;
  const double elevation = std::atan2(glm::dot(d, pole), glm::length(level));
  const double wanted = std::clamp(elevation + raised, -kSteepest, kSteepest);
  return std::cos(wanted) * glm::normalize(level) + std::sin(wanted) * pole;
}

/// Radians to the left of an unmirrored camera.
double leftOf(const Eye& eye, double right) { return eye.mirrored ? right : -right; }

}  // namespace

Eye orbited(Eye eye, glm::dvec2 drag) {
  const glm::dvec3 offset = eye.from - eye.to;
  const double far = glm::length(offset), left = leftOf(eye, drag.x * kTurnOfHeight);
  eye.from = eye.to + far * rotated(offset / far, eye.up, left, -drag.y * kTurnOfHeight);
  return eye;
}

Eye turned(Eye eye, glm::dvec2 drag) {
  const glm::dvec3 offset = eye.to - eye.from;
  const double far = glm::length(offset), angle = glm::radians(eye.fov);
  eye.to = eye.from + far * rotated(offset / far, eye.up, leftOf(eye, drag.x * angle), drag.y * angle);
  return eye;
}

Eye panned(Eye eye, glm::dvec2 drag) {
  const Axes axes = axesOf(eye);
  const double height = 2.0 * std::tan(0.5 * glm::radians(eye.fov)) * glm::length(eye.to - eye.from);
  return shifted(eye, -height * (drag.x * axes.right + drag.y * axes.up));
}

Eye dollied(Eye eye, double steps) {
  const glm::dvec3 offset = eye.from - eye.to;
  const double far = glm::length(offset);
  eye.from = eye.to + std::clamp(far * std::pow(kDolly, steps), kNearest, kFarthest) / far * offset;
  return eye;
}

Eye flown(Eye eye, const glm::dvec3& way) {
  const Axes axes = axesOf(eye);
  return shifted(
      eye, glm::length(eye.to - eye.from) * (way.x * axes.right + way.y * axes.up + way.z * axes.forward));
}

Eye seenFrom(Eye eye, Side side) {
  const glm::dvec3 pole = glm::normalize(eye.up);
  const glm::dvec3 across = std::abs(pole.x) > 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 front = glm::normalize(glm::cross(across, pole)), right = glm::cross(pole, front);
  const glm::dvec3 top = rotated(front, eye.up, 0.0, kSteepest);
  const glm::dvec3 bottom = rotated(front, eye.up, 0.0, -kSteepest);
  const glm::dvec3 sides[] = {front, -front, -right, right, top, bottom};
  eye.from = eye.to + glm::length(eye.from - eye.to) * sides[static_cast<int>(side)];
  return eye;
}

}  // namespace sdf::viewer
