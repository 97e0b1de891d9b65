// Views that follow the size of a scene.
#pragma once
#include <glm/mat3x3.hpp>
#include <optional>

#include "sdf/scene/scene.h"

namespace sdf {

/// The width of a picture by its height where nothing else is asked for: sdfview's pictures have it, and what
/// the camera of an exported file shows.
inline constexpr double kPictureAspect = 16.0 / 9.0;

/// The box that a fitted camera shows: the bounds of all parts or, where these are infinite, what the scene's
/// `bounds` leave of them. None if that is infinite, too, or has no size.
std::optional<Box> boundsInView(const Scene& scene);

/// Half the diagonal of a box, scene units.
double viewRadius(const Box& box);

/// How far from the middle of a finite box a camera that looks at it must stand, in scene units, so that a
/// picture shows all of the box within a margin of a twentieth. The columns of `axes` are the picture's right
/// and up and the way that the camera looks, of length 1; `fov` is its vertical angle in radians, in (0, pi);
/// `aspect` is the picture's width by its height, above 0.
double fittingDistance(const Box& box, const glm::dmat3& axes, double fov, double aspect);

/// The lengths that a scene is seen with, scene units.
struct ViewLengths {
  double unit;  ///< the unit of the others where the scene leaves them open
  double maxDistance, shadowStart, shadowReach, tapSpacing;
};

/// These lengths as a scene states them.
struct StatedLengths {
  /// Takes a scene's; where lengths are asked for, a scene stands for its own.
  StatedLengths(const Scene& scene);  // NOLINT(google-explicit-constructor)

  std::optional<double> maxDistance, shadowStart, shadowReach, tapSpacing;
};

/// A view's lengths. Those that are left open are 80, 0.02, 20 and 0.08 units. A unit is 1 before a camera
/// that the scene places; before a fitted one, which shows a box of this radius, it is half the radius.
ViewLengths viewLengths(const StatedLengths& stated, std::optional<double> fittedRadius);

}  // namespace sdf
