#include "viewer/shaders/hit_shaders.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "sdf/expr/alike.h"
#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "sdf/model/model.h"
#include "viewer/shaders/ray_parts.h"
#include "viewer/shaders/sharing.h"
#include "viewer/shaders/triangle_parts.h"

namespace sdf::viewer {
namespace {

// Drivers inline and unroll, and take seconds over long programs: a gradient of more operations than this is
// taken by differences.
constexpr std::size_t kLongProgram = 6000;
constexpr double kLongCones = 100.0;       // operations, of a distance that is not worth a shader of cones
constexpr std::size_t kLongPasses = 2000;  // the same of several, each of which takes its time beside

Obstacles obstaclesOf(const OperandKind& kind, const Plan& plan) {
  const Marched part = marchedOf(kind, plan.rest->bounds);
  Obstacles result{.whole = part, .rest = part};
  if (!plan.operands.empty()) result.operand = kind.nearest;
  return result;
}

Obstacles othersOf(const Plan& plan) {
  Marched part = leastOf(plan.kinds->others, plan.options.steps);
  part.bounds = plan.rest->bounds;
  Obstacles result{.whole = part, .rest = part};
  if (!plan.operands.empty()) result.operand = numberOfNearest(plan.kinds->others);
  return result;
}

Obstacles planesOf(const Plan& plan) {
  const std::vector<NumberedOperand> operands = operandsOf(plan.planes);
  Obstacles result{.whole = leastOf(operands, plan.options.steps), .planes = plan.planes};
  if (!plan.operands.empty()) result.operand = numberOfNearest(operands);
  return result;
}

Box boundsOf(const std::vector<NumberedOperand>& operands) {
  Box box;
  for (const NumberedOperand& operand : operands) box = unite(box, operand.bounds);
  return box;
}

// Defines farEnd(ray, spread, widening): t where all rays of a cone leave a ball around the bounds, or the
// end of sight where these are not finite.
std::string farEnd(const Box& bounds, GlslWriter& writer) {
  const std::string head = "float farEnd(Ray ray, float spread, float widening) {\n";
  constexpr double kBeyondFloats = 1e15;  // whose squares would be
  if (!bounds.finite() || bounds.longestSide() > kBeyondFloats) return head + "  return maxDistance;\n}\n";
  const std::string centre = vector(bounds.centre(), writer);
  const std::string radius = number(0.5 * glm::length(bounds.size()), writer);
  return head + "  float along = dot(" + centre + " - ray.origin, ray.direction);\n  float reach = along + " +
         radius + " + spread * ahead;\n" +
         "  return widening < 0.5 ? clamp(reach / (1.0 - widening), 0.0, maxDistance) : maxDistance;\n}\n";
}

// Beside saving the write, llvmpipe compiles a shader that may discard once, and else twice.
std::string leaveNothing(const Plan& plan) {
  return plan.options.countReadings ? "" : "if (t >= maxDistance) discard;";
}

// A term for both at p, the step and the distance: of one function where they differ, so that what they have
// in common is computed once.
std::string bothOf(const Marched& m, const std::string& distance, const std::string& both) {
  return hasOwnStep(m) ? both + "(p, vec3(0.0)).xy" : "vec2(" + distance + "(p, vec3(0.0)))";
}

/// Which shaders of a pass there are, the share of one of the whole that one of its readings counts as, and
/// the rows that it is drawn with.
struct Parts {
  bool cones, hits;
  double share = 1.0;
  RowRange row{};
  std::string rows{};        ///< what takes them
  std::string sharing{};     ///< what defines the distance by loops over rows
  std::vector<Box> boxes{};  ///< where its rays start, if there are no cones of its own
};

std::string operandCount(const Plan& plan) {
  return number(static_cast<double>(std::max<std::size_t>(plan.operands.size(), 1)));
}

HitShaders passOf(const Obstacles& obstacles, const Parts& wanted, const Plan& plan, GlslWriter writer) {
  Macros macros = meetingMacros(obstacles, plan);
  macros["OPERANDS"] = operandCount(plan);
  macros["SHARE"] = number(wanted.share);
  macros["LEAVE_NOTHING"] = leaveNothing(plan);
  const bool started = wanted.cones || !wanted.boxes.empty();
  macros["START_RAY"] = started ? "startRay(ray);" : "";
  const bool counted = plan.options.countReadings;
  macros["STORE_COUNTS"] =
      counted ? "counts = vec4(weight * SHARE * float(hit.readings), 0.0, 0.0, 0.0);" : "";
  macros["TAKE_ROW"] = wanted.row.count > 0 ? "sdfTake();" : "";
  Functions functions = meetingFunctions(obstacles);
  if (!wanted.sharing.empty()) functions.merge(sharedFunctions(plan));
  writer.computeExactly(plan.exact);
  const std::string end = wanted.cones ? farEnd(obstacles.rest->bounds, writer) : "";
  Composer composer(plan.options.es, macros, functions, std::move(writer), wanted.rows);
  const std::string camera = parts::kCamera;
  HitShaders pass;
  if (wanted.cones)
    pass.cones = composer.compose(camera + wanted.sharing + parts::kRest + end + parts::kCones);
  if (wanted.hits)
    pass.hits =
        composer.compose(camera + parts::kHit + meeting(obstacles) + (started ? parts::kRayStarts : "") +
                         (counted ? parts::kHitCounts : "") + parts::kFavoured + parts::kHits);
  pass.uniforms = composer.uniforms();
  pass.volumes = composer.volumes();
  pass.takesRows = !wanted.sharing.empty();
  pass.rows = wanted.row;
  pass.boxes = wanted.boxes;
  return pass;
}

}  // namespace

Obstacles obstaclesOf(const Plan& plan) {
  Obstacles result{plan.whole, plan.rest, plan.planes, plan.balls, {}, plan.kinds.has_value()};
  result.byTaps = result.shared ? !plan.gradients : gradientSize(plan.whole.distance) > kLongProgram;
  if (!plan.operands.empty()) result.operand = result.shared ? Expr(0.0) : numberOfNearest(plan.operands);
  return result;
}

std::string meeting(const Obstacles& obstacles) {
  return std::string(parts::kRest) + (obstacles.planes.empty() ? parts::kNoPlanes : parts::kPlanes) +
         (obstacles.balls.empty() ? "" : parts::kBalls) + (obstacles.rest ? parts::kMarch : parts::kNoMarch) +
         (obstacles.byTaps   ? parts::kGradientByTaps
          : obstacles.shared ? parts::kGradientOfNearest
                             : parts::kGradient) +
         parts::kNormal + parts::kMeet;
}

Macros meetingMacros(const Obstacles& obstacles, const Plan& plan) {
  const bool whole = obstacles.planes.empty(), loose = hasOwnStep(obstacles.whole);
  const auto& rest = obstacles.rest;
  const auto both = [&](const Marched& m, const std::string& distance, const std::string& function,
                        const std::string& enough) {
    return obstacles.shared ? function + "(p, " + enough + ")" : bothOf(m, distance, function);
  };
  return {
      {"REST", !rest   ? "vec2(1e30)"
               : whole ? both(*rest, "sdfDistance", "sdfBoth", "enough")
                       : both(*rest, "sdfRest", "sdfBothOfRest", "enough")},
      {"SOLVED",
       obstacles.balls.empty() ? "planesFrom(ray)" : "ballsFrom(ray.origin, ray.direction, planesFrom(ray))"},
      {"BALLS", std::to_string(4 * obstacles.balls.size())},
      {"FIELD", both(obstacles.whole, "sdfDistance", "sdfBoth", "1e30")},
      {"DISTANCE_UP_TO(p, enough)", obstacles.shared ? "sdfBoth(p, enough).y" : "sdfDistance(p, vec3(0.0))"},
      {"IS_FREE", loose ? "false" : "f >= (1.0 - 1e-5) * h"},
      {"LOOSE", loose ? "true" : "false"},
      {"OVER_SURFACE", loose ? "min(f, h)" : "f"},
      {"PLANES", std::to_string(2 * obstacles.planes.size())},
      {"STEP", plan.plain ? "r" : "min(max(2.0 * r / (1.0 - slope), r), tMax - t)"},
      {"OPERAND", !obstacles.operand                      ? "0.0"
                  : obstacles.shared && !obstacles.byTaps ? "nearestOperand"
                                                          : "sdfOperand(p, vec3(0.0))"}};
}

Functions meetingFunctions(const Obstacles& obstacles) {
  const auto planes = [=] {
    std::vector<Expr> outputs;
    for (const HalfSpace& plane : obstacles.planes)
      outputs.insert(outputs.end(), {plane.height, plane.climb});
    return outputs;
  };
  const auto balls = [=] {
    std::vector<Expr> outputs;
    for (const Ball& ball : obstacles.balls)
      outputs.insert(outputs.end(), {ball.centre.x, ball.centre.y, ball.centre.z, ball.squaredRadius});
    return outputs;
  };
  if (obstacles.shared) return {{"sdfPlanes", planes}};
  return {{"sdfDistance", [=] { return std::vector{obstacles.whole.distance}; }},
          {"sdfRest", [=] { return std::vector{obstacles.rest->distance}; }},
          {"sdfBoth", [=] { return partsOf(obstacles.whole); }},
          {"sdfBothOfRest", [=] { return partsOf(*obstacles.rest); }},
          {"sdfPlanes", planes},
          {"sdfBalls", balls},
          {"sdfGradient", [=] { return partsOf(gradientOf(obstacles.whole.distance)); }},
          {"sdfOperand", [=] { return std::vector{*obstacles.operand}; }}};
}

HitShaders startShaders(const Obstacles& obstacles, const Plan& plan, const RowWriter& rows) {
  Parts starts{.cones = true, .hits = false};
  GlslWriter writer(plan.numbers);
  if (plan.kinds) {
    starts.rows = rows.taking(plan.kinds->many.size(), writer);
    starts.sharing = sharing(plan, rows, writer);
  }
  return passOf(obstacles, starts, plan, std::move(writer));
}

Shader boxCones(const Plan& plan) {
  const Macros macros{{"SHARE", number(0.0)}, {"TAKE_ROW", ""}, {"LEAVE_NOTHING", leaveNothing(plan)}};
  GlslWriter writer(plan.numbers);
  const std::string end = farEnd(plan.rest->bounds, writer);
  Composer composer(plan.options.es, macros, {}, std::move(writer));
  std::string text = composer.compose(std::string(parts::kCamera) + parts::kRestByBox + end + parts::kCones);
  return {std::move(text), composer.uniforms()};
}

std::string triangleShader(const Plan& plan) {
  const int first = plan.options.countReadings ? 3 : 2;
  const Macros macros{{"OPERANDS", operandCount(plan)},
                      {"LOOK", std::to_string(first)},
                      {"GLOW", std::to_string(first + 1)},
                      {"MARK", std::to_string(first + 2)},
                      {"STORE_MARKS", plan.meshed ? "storeMarks(hitGlow);" : ""}};
  Composer composer(plan.options.es, macros, {}, {});
  return composer.compose(std::string(parts::kCamera) + parts::kHit + parts::kFavoured +
                          (plan.meshed ? parts::kMarks : "") + parts::kTriangles);
}

std::string hullShader(const Plan& plan) {
  Composer composer(plan.options.es, {}, {}, {});
  return composer.compose(std::string(parts::kCamera) + parts::kHullStarts);
}

std::vector<HitShaders> groupShaders(const Plan& plan, const RowWriter& rows) {
  const auto operations = [](const Expr& e) { return static_cast<double>(operationsOf({&e, 1})); };
  const auto& [many, others] = *plan.kinds;
  double whole = 0.0;
  for (const OperandKind& kind : many)
    whole += operations(kind.distance) * static_cast<double>(kind.groups.numbers.size());
  const Expr rest = others.empty() ? Expr(0.0) : leastOf(others, plan.options.steps).distance;
  whole += operations(rest);
  std::vector<Obstacles> obstacles;
  for (const OperandKind& kind : many) obstacles.push_back(obstaclesOf(kind, plan));
  if (!others.empty()) obstacles.push_back(othersOf(plan));
  std::size_t gradients = 0;
  for (const Obstacles& o : obstacles) gradients += gradientSize(o.whole.distance);
  for (Obstacles& o : obstacles) o.byTaps = gradients > kLongPasses;
  std::vector<HitShaders> result;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    Parts both{.cones = true, .hits = true, .share = operations(obstacles[i].whole.distance) / whole};
    GlslWriter writer(plan.numbers);
    if (i < many.size()) {
      both.row = rows.rangeOf(i);
      both.rows = rows.takingOne(i, writer);
      both.boxes = many[i].singles;
    } else if (const Box box = boundsOf(others); box.finite() && operations(rest) > kLongCones) {
      both.boxes = {box};
    }
    both.cones = plan.cones && both.boxes.empty();
    result.push_back(passOf(obstacles[i], both, plan, std::move(writer)));
  }
  if (!plan.planes.empty())
    result.push_back(
        passOf(planesOf(plan), {.cones = false, .hits = true, .share = 0.0}, plan, GlslWriter(plan.numbers)));
  return result;
}

}  // namespace sdf::viewer
