// Where arcs meet. Private to outline/.
#pragma once
#include <vector>

#include "sdf/outline/arc.h"

namespace sdf {

/// The points in which two arcs cross or touch, and the ends of each that lie on the other, with what is
/// nearer than `reach` counting as touching. Arcs that lie on each other have their ends alone.
std::vector<glm::dvec2> meetingsOf(const Arc& a, const Arc& b, double reach);

}  // namespace sdf
