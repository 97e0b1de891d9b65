#include "viewer/shaders/hit_shaders.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "viewer/shaders/parts.h"

namespace sdf::viewer {
namespace {

// Drivers inline and unroll, and take seconds over long programs: a gradient of more operations than this is
// taken by differences.
constexpr std::size_t kLongProgram = 6000;

// What every driver has room for, but for some of the camera's.
constexpr std::size_t kMostUniforms = 960;

Obstacles obstaclesOf(const OperandGroup& group, const Plan& plan) {
  Marched part = *plan.rest;
  part.distance = hoisted(group.distance);
  Obstacles result{part, part, {}, {}};
  if (!plan.operands.empty()) result.operand = group.nearest;
  return result;
}

Obstacles planesOf(const Plan& plan) {
  std::vector<NumberedOperand> operands;
  for (const HalfSpace& plane : plan.planes) operands.push_back(plane.operand);
  Marched nearest{.distance = operands.front().distance};
  for (const NumberedOperand& operand : operands) nearest.distance = min(nearest.distance, operand.distance);
  Obstacles result{nearest, {}, plan.planes, {}};
  if (!plan.operands.empty()) result.operand = numberOfNearest(operands);
  return result;
}

// Defines farEnd(ray, spread, widening): t where all rays of a cone leave a ball around the bounds, or the
// end of sight where these are not finite.
std::string farEnd(const Box& bounds) {
  const std::string head = "float farEnd(Ray ray, float spread, float widening) {\n";
  constexpr double kBeyondFloats = 1e15;  // whose squares would be
  if (!bounds.finite() || bounds.longestSide() > kBeyondFloats) return head + "  return maxDistance;\n}\n";
  return head + "  float along = dot(" + vector(bounds.centre()) +
         " - ray.origin, ray.direction);\n  float reach = along + " +
         number(0.5 * glm::length(bounds.size())) + " + spread * ahead;\n" +
         "  return widening < 0.5 ? clamp(reach / (1.0 - widening), 0.0, maxDistance) : maxDistance;\n}\n";
}

Composer composerOf(const Obstacles& obstacles, double share, bool cones, const Plan& plan) {
  Macros macros = meetingMacros(obstacles, plan);
  macros["OPERANDS"] = number(static_cast<double>(std::max<std::size_t>(plan.operands.size(), 1)));
  macros["SHARE"] = number(share);
  macros["START_RAY"] = cones ? "startRay(ray);" : "";
  macros["STORE_COUNTS"] =
      plan.options.countReadings ? "counts = vec4(weight * SHARE * float(hit.readings), 0.0, 0.0, 0.0);" : "";
  return {plan.options.es, macros, meetingFunctions(obstacles), {}};
}

std::string conesOf(const Obstacles& obstacles, Composer& composer) {
  return composer.compose(std::string(parts::kCamera) + parts::kRest + farEnd(obstacles.whole.bounds) +
                          parts::kCones);
}

std::string hitsOf(const Obstacles& obstacles, bool cones, const Plan& plan, Composer& composer) {
  return composer.compose(std::string(parts::kCamera) + parts::kHit + meeting(obstacles) +
                          (cones ? parts::kStarts : "") +
                          (plan.options.countReadings ? parts::kHitCounts : "") + parts::kHits);
}

// A reading counts as the share of one of the whole that the group's operations are.
HitShaders passOf(const OperandGroup& group, double share, const Plan& plan) {
  const Obstacles obstacles = obstaclesOf(group, plan);
  Composer composer = composerOf(obstacles, share, true, plan);
  HitShaders pass{.cones = conesOf(obstacles, composer)};
  pass.hits = hitsOf(obstacles, true, plan, composer);
  pass.uniforms.push_back(composer.uniforms());
  return pass;
}

HitShaders passOfPlanes(const Plan& plan) {
  const Obstacles planes = planesOf(plan);
  Composer composer = composerOf(planes, 0.0, false, plan);
  HitShaders pass{.hits = hitsOf(planes, false, plan, composer)};
  pass.uniforms.push_back(composer.uniforms());
  return pass;
}

}  // namespace

Obstacles obstaclesOf(const Plan& plan) {
  Obstacles result{plan.whole, plan.rest, plan.planes, {}};
  if (!plan.operands.empty()) result.operand = numberOfNearest(plan.operands);
  return result;
}

std::string gradients(const Expr& distance) {
  const Vec3E g = gradientOf(distance);
  const Expr all[] = {g.x, g.y, g.z};
  return topologicalOrder(all).size() > kLongProgram ? parts::kGradientByTaps : parts::kGradient;
}

std::string meeting(const Obstacles& obstacles) {
  return std::string(parts::kRest) + (obstacles.planes.empty() ? parts::kNoPlanes : parts::kPlanes) +
         parts::kMarch + gradients(obstacles.whole.distance) + parts::kNormal + parts::kMeet;
}

Macros meetingMacros(const Obstacles& obstacles, const Plan& plan) {
  const bool whole = obstacles.planes.empty();
  const auto& rest = obstacles.rest;
  return {
      {"REST",
       !rest ? "1e30" : (whole ? "sdfDistance" : "sdfRest") + ("(p, vec3(0.0)) * " + number(rest->inverse))},
      {"INVERSE_SLOPE", number(obstacles.whole.inverse)},
      {"PLANES", std::to_string(2 * obstacles.planes.size())},
      {"STEP", plan.plain ? "r" : "min(max(2.0 * r / (1.0 - slope), r), tMax - t)"},
      {"OPERAND", obstacles.operand ? "sdfOperand(p, vec3(0.0))" : "0.0"}};
}

Functions meetingFunctions(const Obstacles& obstacles) {
  const auto planes = [=] {
    std::vector<Expr> outputs;
    for (const HalfSpace& plane : obstacles.planes)
      outputs.insert(outputs.end(), {plane.height, plane.climb});
    return outputs;
  };
  const auto gradient = [=] {
    const Vec3E g = gradientOf(obstacles.whole.distance);
    return std::vector{g.x, g.y, g.z};
  };
  return {{"sdfDistance", [=] { return std::vector{obstacles.whole.distance}; }},
          {"sdfRest", [=] { return std::vector{obstacles.rest->distance}; }},
          {"sdfPlanes", planes},
          {"sdfGradient", gradient},
          {"sdfOperand", [=] { return std::vector{*obstacles.operand}; }}};
}

HitShaders startShaders(const Plan& plan) {
  const Obstacles obstacles = obstaclesOf(plan);
  Composer composer = composerOf(obstacles, 1.0, true, plan);
  HitShaders pass{.cones = conesOf(obstacles, composer)};
  pass.uniforms.push_back(composer.uniforms());
  return pass;
}

std::vector<HitShaders> groupShaders(const Plan& plan) {
  const auto operations = [](const Expr& e) { return static_cast<double>(topologicalOrder({&e, 1}).size()); };
  double whole = 0.0;
  for (const OperandGroup& group : plan.groups) whole += operations(group.distance);
  std::vector<HitShaders> result;
  for (const OperandGroup& group : plan.groups) {
    HitShaders pass = passOf(group, operations(group.distance) / whole, plan);
    if (pass.uniforms.front().outputs().size() > kMostUniforms) return {};
    if (result.empty() || result.back().hits != pass.hits)
      result.push_back(std::move(pass));
    else
      result.back().uniforms.push_back(std::move(pass.uniforms.front()));
  }
  if (!plan.planes.empty() && !result.empty()) result.push_back(passOfPlanes(plan));
  return result;
}

}  // namespace sdf::viewer
