// The slow march that the others are held to.
#pragma once
#include <optional>

#include "sdf/march/field.h"

namespace sdf {

/// The solid begins after `before` and no later than `after`; both are tMin on a ray that starts in the
/// solid.
struct RootBracket {
  double before, after;
};

/// Where the solid first begins on ray number `ray`, in double, by steps of epsilon / max(1, L) (epsilon
/// where L is unknown), each value from its own t: no method can do it more plainly. A solid thinner than a
/// step may be passed; g was then at most half a step beside it. Nothing where no sample lies in the solid.
/// Cost: (tMax - tMin) max(1, L) / epsilon readings in double. Precondition: a ray that checkRays accepts;
/// epsilon > 0.
std::optional<RootBracket> marchDensely(const MarchField& field, const Rays& rays, std::size_t ray,
                                        double epsilon);

}  // namespace sdf
