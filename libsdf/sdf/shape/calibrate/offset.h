// Distances that are only bounds or fields, made fit for offsets. Private to sdf/shape.
#pragma once
#include "sdf/shape/calibrate/level_set.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// The same solid with a distance that is near the true one as far outside and inside as `at` says, which may
/// be 0, and somewhat farther. The distance is taken apart where it is the least or greatest of functions:
///
/// - A formula is divided by its gradient's length (level_set.h).
/// - Outside of an edge, where the greatest of two distances a and b falls short, the distance is that to the
///   edge; with c the cosine of the angle between the gradients it is the root of
///   (a^2 + b^2 - 2 a b c) / (1 - c^2). Outside of a corner it is that of three (corners.h). The least of
///   distances has the same inside of what is hollow. For planes this is exact, for curved faces right to
///   first order.
///
/// The slope is proven. What cannot be calibrated, or only at the price of a steep bound, stays as it is; so
/// do deformed shapes, whose distance is calibrated already (calibrate.h).
Shape fitForOffsets(const Shape& shape, const Reach& at);

}  // namespace sdf
