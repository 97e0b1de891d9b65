// Steps for distances that are steep in some places: bounds of the slope by region.
#pragma once
#include <optional>

#include "sdf/base/box.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// How far one may go from a point where a distance is positive: the ball of this radius is free of the
/// surface. Below 0 where the distance is. Cubes of a box know how steep the distance is in them and around
/// them, and, where intervals prove that the distance is positive, how far the next one is in which it may
/// not be (after segment tracing, Galin and others 2020, with balls for segments). Outside of the box it is
/// distance / slope.
/// `slope` bounds the distance's slope everywhere. Nothing where the distance depends on inputs, or where no
/// cubes help: the slope in most of those at the surface is more than half of it. What was made last is kept,
/// so that equal distances have equal steps. Cost: some ten milliseconds.
std::optional<Expr> stepByRegion(const Expr& distance, const Box& box, double slope);

}  // namespace sdf
