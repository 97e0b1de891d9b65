#include "viewer/shaders/hit_shaders.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "viewer/shaders/ray_parts.h"

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
  part.step = hoisted(group.step);
  Obstacles result{part, part, {}, {}};
  if (!plan.operands.empty()) result.operand = group.nearest;
  return result;
}

Obstacles planesOf(const Plan& plan) {
  std::vector<NumberedOperand> operands;
  for (const HalfSpace& plane : plan.planes) operands.push_back(plane.operand);
  Expr least = operands.front().distance;
  for (const NumberedOperand& operand : operands) least = min(least, operand.distance);
  const Marched nearest{least, least};
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

bool isApart(const Marched& m) { return m.step != m.distance; }

// A term for both at p, the step and the distance: of one function where they differ, so that what they have
// in common is computed once.
std::string bothOf(const Marched& m, const std::string& distance, const std::string& both) {
  return isApart(m) ? both + "(p, vec3(0.0)).xy" : "vec2(" + distance + "(p, vec3(0.0)))";
}

// Three outputs make a vec3.
std::vector<Expr> partsOf(const Marched& m) { return {m.step, m.distance, Expr(0.0)}; }

/// Which shaders of a pass there are, and the share of one of the whole that one of its readings counts as.
struct Parts {
  bool cones, hits;
  double share = 1.0;
};

HitShaders passOf(const Obstacles& obstacles, const Parts& wanted, const Plan& plan) {
  Macros macros = meetingMacros(obstacles, plan);
  macros["OPERANDS"] = number(static_cast<double>(std::max<std::size_t>(plan.operands.size(), 1)));
  macros["SHARE"] = number(wanted.share);
  macros["START_RAY"] = wanted.cones ? "startRay(ray);" : "";
  const bool counted = plan.options.countReadings;
  macros["STORE_COUNTS"] =
      counted ? "counts = vec4(weight * SHARE * float(hit.readings), 0.0, 0.0, 0.0);" : "";
  Composer composer(plan.options.es, macros, meetingFunctions(obstacles), {});
  const std::string camera = parts::kCamera;
  HitShaders pass;
  if (wanted.cones)
    pass.cones = composer.compose(camera + parts::kRest + farEnd(obstacles.whole.bounds) + parts::kCones);
  if (wanted.hits)
    pass.hits =
        composer.compose(camera + parts::kHit + meeting(obstacles) + (wanted.cones ? parts::kStarts : "") +
                         (counted ? parts::kHitCounts : "") + parts::kHits);
  pass.uniforms.push_back(composer.uniforms());
  return pass;
}

}  // namespace

Obstacles obstaclesOf(const Plan& plan) {
  Obstacles result{plan.whole, plan.rest, plan.planes, {}};
  if (!plan.operands.empty()) result.operand = numberOfNearest(plan.operands);
  return result;
}

std::string meeting(const Obstacles& obstacles) {
  const auto gradient = topologicalOrder(partsOf(gradientOf(obstacles.whole.distance)));
  return std::string(parts::kRest) + (obstacles.planes.empty() ? parts::kNoPlanes : parts::kPlanes) +
         parts::kMarch + (gradient.size() > kLongProgram ? parts::kGradientByTaps : parts::kGradient) +
         parts::kNormal + parts::kMeet;
}

Macros meetingMacros(const Obstacles& obstacles, const Plan& plan) {
  const bool whole = obstacles.planes.empty();
  const auto& rest = obstacles.rest;
  return {{"REST", !rest   ? "vec2(1e30)"
                   : whole ? bothOf(*rest, "sdfDistance", "sdfBoth")
                           : bothOf(*rest, "sdfRest", "sdfBothOfRest")},
          {"FIELD", bothOf(obstacles.whole, "sdfDistance", "sdfBoth")},
          {"OVER_SURFACE", isApart(obstacles.whole) ? "min(f, h)" : "f"},
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
  return {{"sdfDistance", [=] { return std::vector{obstacles.whole.distance}; }},
          {"sdfRest", [=] { return std::vector{obstacles.rest->distance}; }},
          {"sdfBoth", [=] { return partsOf(obstacles.whole); }},
          {"sdfBothOfRest", [=] { return partsOf(*obstacles.rest); }},
          {"sdfPlanes", planes},
          {"sdfGradient", [=] { return partsOf(gradientOf(obstacles.whole.distance)); }},
          {"sdfOperand", [=] { return std::vector{*obstacles.operand}; }}};
}

HitShaders startShaders(const Plan& plan) {
  return passOf(obstaclesOf(plan), {.cones = true, .hits = false}, plan);
}

std::vector<HitShaders> groupShaders(const Plan& plan) {
  const auto operations = [](const Expr& e) { return static_cast<double>(topologicalOrder({&e, 1}).size()); };
  double whole = 0.0;
  for (const OperandGroup& group : plan.groups) whole += operations(group.distance);
  std::vector<HitShaders> result;
  for (const OperandGroup& group : plan.groups) {
    const Parts both{.cones = true, .hits = true, .share = operations(group.distance) / whole};
    HitShaders pass = passOf(obstaclesOf(group, plan), both, plan);
    if (pass.uniforms.front().outputs().size() > kMostUniforms) return {};
    if (result.empty() || result.back().hits != pass.hits)
      result.push_back(std::move(pass));
    else
      result.back().uniforms.push_back(std::move(pass.uniforms.front()));
  }
  if (!plan.planes.empty() && !result.empty())
    result.push_back(passOf(planesOf(plan), {.cones = false, .hits = true, .share = 0.0}, plan));
  return result;
}

}  // namespace sdf::viewer
