#include "viewer/shaders/plan.h"

#include <algorithm>
#include <unordered_map>

#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "sdf/model/model.h"
#include "sdf/shape/booleans.h"
#include "viewer/shaders/filter.h"
#include "viewer/shaders/source.h"
#include "viewer/shaders/winner.h"

namespace sdf::viewer {
namespace {

/// A scene's half spaces, and its other parts.
struct Split {
  std::vector<HalfSpace> planes;
  std::vector<Shape> others;
};

Split split(const Scene& scene) {
  Split result;
  for (const Part& part : scene.parts) {
    const Expr& distance = part.shape.distance;
    const Vec3E g = gradientOf(distance);
    if (dependsOnSpace(g.x) || dependsOnSpace(g.y) || dependsOnSpace(g.z)) {
      result.others.push_back(part.shape);
    } else {
      const Expr steep = length(g), once = steep.isConstant(1.0) ? Expr(1.0) : 1.0 / steep;
      result.planes.push_back({{distance, 0.0}, distance * once, dot(g, normal()) * once});
    }
  }
  return result;
}

Result<Marched> marched(const Shape& shape) {
  const auto [distance, slope] = marchable(shape);
  if (!(slope < kInfinity))
    return Error{
        ErrorKind::Scene,
        "the distance has no known slope, so its rays cannot be marched; give its field() bounds and a "
        "lipschitz constant"};
  return Marched{hoisted(distance), distance, 1.0 / slope, shape.bounds};
}

/// The operands of a union, numbered, and those among them that are not half spaces.
struct Operands {
  std::vector<Numbered> all, rest;
};

// Numbers the planes, too. Nothing where the rest's operands are not the whole's: it is read in another way.
std::optional<Operands> operandsIn(const Marched& whole, const std::optional<Marched>& rest,
                                   std::vector<HalfSpace>& planes) {
  Operands operands;
  std::unordered_map<Expr, double> numbers;
  for (const Expr& e : operandsOf(whole.written)) {
    operands.all.push_back({e, static_cast<double>(numbers.size())});
    numbers.emplace(e, operands.all.back().number);
  }
  const auto number = [&](Numbered& operand) {
    const auto found = numbers.find(operand.distance);
    if (found != numbers.end()) operand.number = found->second;
    return found != numbers.end();
  };
  if (rest)
    for (const Expr& e : operandsOf(rest->written))
      if (!number(operands.rest.emplace_back(Numbered{e, 0.0}))) return {};
  for (HalfSpace& plane : planes)
    if (!number(plane.operand)) return {};
  return operands;
}

bool showsLight(View view) { return view == View::Picture || view == View::Shadow; }
bool showsSurface(View view) { return view == View::Picture || view == View::Material; }
bool showsOcclusion(View view) { return view == View::Picture || view == View::Occlusion; }

bool mirrors(const Scene& scene, const Shape& whole) {
  return scene.reflectionBounces > 0 &&
         !whole.surface[static_cast<int>(Attribute::Reflectivity)].isConstant(0.0);
}

// The surface of what is hit, by the number of its operand where that is known.
void planSurface(const Shape& whole, const std::optional<Operands>& operands, Plan& plan) {
  plan.surface.assign(whole.surface.begin(), whole.surface.end());
  if (operands)
    plan.surface =
        decided(whole.surface, plan.whole.written, Expr::parameter({hidden("operand"), 0.0, 0.0, kInfinity}));
  if (!std::equal(plan.surface.begin(), plan.surface.end(), whole.surface.begin()))
    plan.operands = operands->all;
  for (Expr& e : plan.surface) e = hoisted(e);
  Filtered surface = filtered(plan.surface);
  plan.surface = std::move(surface.outputs);
  plan.filters = surface.changed;
}

}  // namespace

Result<Plan> planOf(const Scene& scene, const ShaderOptions& options) {
  const Shape whole = scene.whole();
  auto wholeMarched = marched(whole);
  if (!wholeMarched) return wholeMarched.error();
  Plan plan{.options = options, .whole = std::move(*wholeMarched)};
  // Occlusion by steps counts the readings of the whole.
  const bool stepsCount = scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps;
  const bool isPicture = options.view == View::Picture;
  Split parts = stepsCount ? Split() : split(scene);
  plan.planes = std::move(parts.planes);
  if (plan.planes.empty()) {
    plan.rest = plan.whole;
  } else if (!parts.others.empty()) {
    auto rest = marched(unite(parts.others));
    if (!rest) return rest.error();
    plan.rest = std::move(*rest);
  }
  plan.cones = options.method == Method::AutoRelaxed && !stepsCount;
  plan.tiled = plan.cones && isPicture && plan.planes.empty();
  plan.plain = options.method == Method::Plain || stepsCount;
  plan.lights = showsLight(options.view) && !scene.lights.empty();
  if (plan.lights) plan.shadow = scene.shadow.kind;
  if (showsOcclusion(options.view)) plan.occlusion = scene.ambientOcclusion.kind;
  if (isPicture && mirrors(scene, whole)) plan.bounces = scene.reflectionBounces;
  const auto operands = operandsIn(plan.whole, plan.rest, plan.planes);
  if (showsSurface(options.view)) planSurface(whole, operands, plan);
  if (options.grouped && plan.cones && isPicture && plan.rest && operands)
    plan.groups = groupsOf(operands->rest);
  if (plan.groups.size() == 1) plan.groups.clear();
  return plan;
}

}  // namespace sdf::viewer
