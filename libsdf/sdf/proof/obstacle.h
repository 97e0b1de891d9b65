// What stands in the way of a proof, in words.
#pragma once
#include <string>

#include "sdf/base/box.h"
#include "sdf/eval/function.h"
#include "sdf/expr/expr.h"

namespace sdf {

/// Proofs rest on intervals: over a box the distance must be seen to be a number, and to rise where it may be
/// 0. Where intervals tell neither, there is an operation of which they do not tell it, while they do of all
/// its arguments that matter there: this names where that comes from (originOf): "the twist at
/// scene.lua:4 stood in the way: intervals do not tell if it rises". "" where they tell both, or
/// where the place is not known. Inputs have these values. Cost: linear in the graph, times its depth.
std::string obstacleIn(const Expr& distance, const Box& box, const Values& values);

}  // namespace sdf
