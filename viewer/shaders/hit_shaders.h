// The shaders that find what rays meet. Private to viewer/shaders.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viewer/shaders/assemble.h"
#include "viewer/shaders/rows.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {

/// Obstacles are what the rays of one pass may meet.
struct Obstacles {
  Marched whole;                    ///< its gradient gives the normals
  std::optional<Marched> rest{};    ///< what is marched, if anything
  std::vector<HalfSpace> planes{};  ///< what else there is
  std::vector<Ball> balls{};
  std::optional<Expr> operand{};  ///< the number of the operand that is nearest; none: 0
  bool shared = false;            ///< sharing() defines the distances and the number instead
  bool byTaps = false;            ///< the gradient is taken by differences
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
HitShaders startShaders(const Obstacles& obstacles, const Plan& plan, const RowWriter& rows);

/// Writes the shader that looks where the rays that meet a box start.
Shader boxCones(const Plan& plan);

/// Writes the passes that draw the groups of the plan's kinds, whose rows are the first, the other operands
/// and the half spaces.
std::vector<HitShaders> groupShaders(const Plan& plan, const RowWriter& rows);

/// Writes the fragment shader of the pass that draws the plan's meshes.
std::string triangleShader(const Plan& plan);

/// Writes the fragment shader of the pass that draws the hull of the plan's rest.
std::string hullShader(const Plan& plan);

}  // namespace sdf::viewer
