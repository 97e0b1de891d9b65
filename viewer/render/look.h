// What a scene looks like at one moment: its camera, lights and settings as numbers.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <string>
#include <vector>

#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// Values of parameters by name; those that are missing have their present ones. "time" is one of them.
using Parameters = std::map<std::string, double>;

/// A pinhole camera, in double: it may stand far from the origin.
struct Eye {
  glm::dvec3 from{0.0, 1.5, 6.0}, to{0.0}, up{0.0, 1.0, 0.0};
  double fov = 45.0;  ///< vertical, degrees
  bool mirrored = false;
  bool operator==(const Eye&) const = default;
};

/// The eye; one that looks straight along its `up` has north, -z, up instead, as on a plan, or +y where that
/// is no better.
Eye upright(Eye eye);

struct LookLight {
  glm::vec4 vector;  ///< xyz: towards the light, of length 1, w 0; or its position, w 1
  glm::vec4 color;   ///< times its intensity; w: 1 if it casts shadows
  bool operator==(const LookLight&) const = default;
};

struct Look {
  Eye eye;
  std::vector<LookLight> lights;
  glm::vec3 ambient, fogColor;
  float fogDensity, sharpness, occlusionStrength;
};

/// The scene's own look at these values of its parameters.
Look lookOf(const Scene& scene, const Parameters& parameters);

/// The camera as a scene's text: a call of `camera`.
std::string textOf(const Eye& eye);

}  // namespace sdf::viewer
