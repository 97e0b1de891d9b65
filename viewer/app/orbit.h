// How a camera moves under the user's hand. Drags are in picture heights, x to the right and y up, so that a
// movement does the same in a window of any size. Mirrored cameras follow the hand as others do.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "viewer/render/look.h"

namespace sdf::viewer {

/// Turns the picture about what the camera looks at, half a turn for a picture height. The horizon stays
/// level: sideways about `up`, and never quite to the zenith.
Eye orbited(Eye eye, glm::dvec2 drag);

/// Turns the camera where it stands, towards what the drag points at.
Eye turned(Eye eye, glm::dvec2 drag);

/// Shifts the camera so that what it looks at follows the drag.
Eye panned(Eye eye, glm::dvec2 drag);

/// Moves the camera a tenth of the way to what it looks at for each step, which it never reaches; back for
/// negative steps.
Eye dollied(Eye eye, double steps);

/// Moves the camera: x to the picture's right, y up, z along the view, in distances to what it looks at.
Eye flown(Eye eye, const glm::dvec3& way);

/// The side from which a view key looks. Of a scene whose up is y, Front is +z and Right +x; of one with z
/// up, Front is -y.
enum class Side { Front, Back, Left, Right, Top, Bottom };

/// Places the camera on that side, as far away as now.
Eye seenFrom(Eye eye, Side side);

}  // namespace sdf::viewer
