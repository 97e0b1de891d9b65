// Where rays may start, for having been marched together up to there.
#pragma once
#include "sdf/march/field.h"

namespace sdf::chart {

/// A square of rays, which start where the cones of their tiles have come to.
struct StartedRays {
  Rays rays;
  double readings = 0.0;  ///< of the step, a ray: those of the cones, shared by their rays
};

/// Marches a cone around each tile of 4 by 4 rays, which must have one origin, by balls that hold all of it
/// (as sdfview --start cone does). `side`: rays a side. Throws std::runtime_error for fields without a slope.
StartedRays coneStarts(const MarchField& field, const Rays& rays, int side);

}  // namespace sdf::chart
