// The shaders that find what rays meet. Private to viewer/shaders.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viewer/shaders/assemble.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {

/// Obstacles are what the rays of one pass may meet.
struct Obstacles {
  Marched whole;                  ///< its gradient gives the normals
  std::optional<Marched> rest;    ///< what is marched, if anything
  std::vector<HalfSpace> planes;  ///< what else there is
  std::optional<Expr> operand;    ///< the number of the operand that is nearest; none: 0
};

/// Returns all that there is to be met of a scene.
Obstacles obstaclesOf(const Plan& plan);

/// Returns the parts that define meet(ray).
std::string meeting(const Obstacles& obstacles);

/// Returns the macros that these parts use, and parts::kField and parts::kRest.
Macros meetingMacros(const Obstacles& obstacles, const Plan& plan);

/// Returns the functions of the scene that these parts use.
Functions meetingFunctions(const Obstacles& obstacles);

/// Writes the pass that looks where the rays of the whole start.
HitShaders startShaders(const Plan& plan);

/// Writes the passes that draw the plan's groups, and the half spaces beside them; none if a group has more
/// numbers than every driver has room for.
std::vector<HitShaders> groupShaders(const Plan& plan);

}  // namespace sdf::viewer
