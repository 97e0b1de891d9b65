// Curved parts of a warped distance. Private to sdf/shape.
#pragma once
#include <optional>

#include "sdf/shape/calibrate/calibrate.h"

namespace sdf {

struct CurvedPart {
  Expr value;  ///< the calibrated distance
  Expr slope;  ///< a bound of how steep it is there, in the result's space
};

/// f + offset where f is the length of coordinates at right angles or the distance to a box in them (see
/// innerRadius), as after the warp: divided by its own slope |J^T grad f| as far as `share` of half the
/// offset outside and of a quarter of it inside, farther on by the usual slope. Nothing where f is no such
/// form, or the offset not always negative, so that f + offset = 0 is no smooth surface.
std::optional<CurvedPart> curvedPart(const Expr& f, const Expr& offset, const Warp& warp, double share);

}  // namespace sdf
