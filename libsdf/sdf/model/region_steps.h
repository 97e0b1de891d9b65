// Steps for distances that are steep in some places: bounds of the slope by region.
#pragma once
#include <optional>

#include "sdf/base/box.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// A step, and by how much farther it leads at most of the surface than the distance over the slope.
struct RegionStep {
  Expr step;
  double gain;
};

/// With gains of less than this the step is not worth the reading of a table. Chosen.
inline constexpr double kWorthwhile = 2.0;
/// With a gain of more than this rays that go by one slope run out of steps, as a rule. Chosen.
inline constexpr double kTooSteep = 64.0;

/// How far one may go from a point where a distance is positive: the ball of this radius is free of the
/// surface. Below 0 where the distance is. Cubes of a box know how steep the distance is in them and around
/// them, and, where intervals prove that the distance is positive, how far the next one is in which it may
/// not be (after segment tracing, Galin and others 2020, with balls for segments). Outside of the box it is
/// distance / slope.
/// `slope` bounds the distance's slope everywhere; inputs have the values that are known of them. Nothing
/// where the box or the slope is infinite. What was made last is kept, so that equal distances have equal
/// steps. Cost: some ten milliseconds, some hundred with a gain of more than kTooSteep.
std::optional<RegionStep> stepByRegion(const Expr& distance, const Box& box, double slope);

}  // namespace sdf
