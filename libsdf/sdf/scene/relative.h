// A scene as it is seen from a place of its own.
#pragma once
#include <glm/vec3.hpp>

#include "sdf/scene/scene.h"

namespace sdf {

/// The scene with all that has a place moved by -origin: shapes (shape/operators/place.h), bounds, the camera
/// and lights. Directions, as the background is a function of, stay.
Scene relativeTo(const Scene& scene, const glm::dvec3& origin);

}  // namespace sdf
