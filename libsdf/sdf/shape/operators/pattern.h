// Repetition. However many copies there are, a point asks only those that can be nearest to it: of a shape
// whose bounds are w long, each of its points has its nearest copy at round((x - t) / cell) for some t in the
// bounds, which are at most ceil(w / cell) + 1 cells; just one where the shape is its own mirror image and
// fits its cell. Among those the least distance is taken, so neighbours are never missed. Attributes are
// those of the copy that wins. A failed operand is passed on.
#pragma once
#include <glm/vec3.hpp>
#include <optional>

#include "sdf/shape/shape.h"

namespace sdf {

/// Copies at every multiple of `cell` (scene units, >= 0; 0: not repeated along that axis; not all 0),
/// endlessly, or `count` (>= 1 along each axis) of them centred about the shape's own place. Exact distances
/// stay exact (outside, where copies touch or overlap); other bounds are capped between the copies, so that
/// they stay continuous. The shape must be bounded along the repeated axes and at most 3 cells long. On a
/// flat shape z is ignored.
Shape repeatGrid(const Shape& shape, const Vec3E& cell, const std::optional<glm::ivec3>& count = {});

/// `count` >= 1 copies evenly around the y axis, the first in place. Exact distances stay exact (outside,
/// where copies touch or overlap). A shape that reaches across the axis, or spans more than 3 of its sectors,
/// is copied out, which is limited to 64 copies.
Shape polarRepeat(const Shape& shape, int count);

}  // namespace sdf
