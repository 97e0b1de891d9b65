// The scene's camera and lights as numbers in glTF's terms.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/scene/fit.h"

namespace sdf {

/// A place from which one looks, or shines, along the local -Z.
struct Placement {
  glm::dvec3 position{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
};

struct ViewCamera {
  Placement placement;
  double verticalFov;  ///< radians, below pi
  double near;         ///< scene units; a 10,000th of `far`, which a 24-bit depth buffer resolves
  double far;          ///< the scene's maxDistance, or as far as all of the scene reaches
};

/// KHR_lights_punctual multiplies by albedo / pi where the scene's Phong light multiplies by albedo, so
/// intensities are pi times the scene's. Its point lights fall off with the squared distance and the scene's
/// do not: their candela are such that both agree at the distance of `centre`.
struct ViewLight {
  Light::Kind kind;
  Placement placement;
  glm::dvec3 color;  ///< linear RGB, largest component 1
  double intensity;  ///< lux for directional lights, candela for point lights
};

/// The scene's camera; a fitted one shows all of the scene in pictures of kPictureAspect and wider. Nothing
/// where the camera's numbers do not make one (not finite, or it looks at where it stands).
std::optional<ViewCamera> viewCamera(const Scene& scene);
/// The same where a fitted camera shows this box, if there is one.
std::optional<ViewCamera> viewCamera(const Scene& scene, const std::optional<Box>& box);

/// The lights that shine: finite numbers, and neither black nor without direction.
std::vector<ViewLight> viewLights(const Scene& scene, const glm::dvec3& centre);

}  // namespace sdf
