// What a scene looks like at one moment: its camera, lights and settings as numbers.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "sdf/eval/function.h"
#include "sdf/scene/fit.h"

namespace sdf::viewer {

/// An Eye is a camera, in double: it may stand far from the origin.
struct Eye {
  glm::dvec3 from{3.4, 2.6, 4.6}, to{0.0}, up{0.0, 1.0, 0.0};
  double fov = 45.0;  ///< vertical, degrees
  bool mirrored = false;
  double aperture = 0.0;                 ///< radius of its lens; 0: a pinhole
  std::optional<double> focus{};         ///< how far ahead a lens sees sharply; none: as far as `to`
  std::optional<double> fittedRadius{};  ///< of what the eye was fitted to, if it was; see viewLengths
  bool operator==(const Eye&) const = default;
};

/// Makes an eye that looks straight along its `up` have north, -z, up instead, as on a plan, or +y where that
/// is no better; any other eye stays as it is.
Eye upright(Eye eye);

/// Moves an eye to where all of a finite box is in view in a picture of this width by its height, and has it
/// look at the box's middle, which a lens sees sharply then. Its direction, `up`, field of view and aperture
/// stay.
Eye fitted(Eye eye, const Box& box, double aspect);

/// Axes are the picture's own, of length 1: `right` is the picture's right also where it is mirrored.
struct Axes {
  glm::dvec3 right, up, forward;
};
Axes axesOf(const Eye& eye);

/// A LookLight is a light at one moment.
struct LookLight {
  glm::dvec4 vector;  ///< xyz: towards the light, of length 1, w 0; or its position, w 1
  glm::vec4 color;    ///< times its intensity; w: 1 if it casts shadows
  float size = 0.0f;  ///< its radius; of one far away, the sine of half the angle that it is seen under
  bool operator==(const LookLight&) const = default;
};

/// A Look is a scene's camera, lights and settings at one moment.
struct Look {
  Eye eye;
  std::vector<LookLight> lights;
  glm::vec3 ambient, fogColor;
  float fogDensity, sharpness, occlusionStrength;
};

/// The look with the eye and the lights that have a place moved by -origin.
Look relativeTo(Look look, const glm::dvec3& origin);

/// Returns what the positions of an eye's pictures are to be relative to: the present origin where floats
/// tell them apart so closely that it is not seen, else what the eye looks at.
glm::dvec3 originFor(const Eye& eye, const glm::dvec3& present = glm::dvec3(0.0));

/// A LookFunction is a scene's own look as a function of its inputs, compiled once.
class LookFunction {
 public:
  /// A camera that the scene leaves open is fitted to `inView`, if there is one.
  LookFunction(const Scene& scene, const std::optional<Box>& inView);
  explicit LookFunction(const Scene& scene) : LookFunction(scene, boundsInView(scene)) {}

  /// Computes the look at these values; inputs without one have their defaults. "time" is one of them. A
  /// fitted camera is fitted to pictures of this width by their height.
  Look at(const Values& values, double aspect = kPictureAspect) const;

  /// Returns what the camera is fitted to, if it is.
  const std::optional<Box>& inView() const { return inView_; }

 private:
  Function numbers_;
  std::vector<Light> lights_;
  bool mirrored_;
  std::optional<Box> inView_;
};

/// Writes the camera as a scene's text: a call of `camera`.
std::string textOf(const Eye& eye);

}  // namespace sdf::viewer
