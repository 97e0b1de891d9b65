// On which side of a line a point of the plane lies.
#pragma once
#include <glm/vec2.hpp>

namespace sdf {

/// 1 where c lies on the left of the line from a to b, -1 on the right, 0 on it; exact for finite floats.
int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c);

}  // namespace sdf
