#include "viewer/shaders/plan.h"

#include <algorithm>

#include "sdf/expr/hoist.h"
#include "sdf/expr/origin.h"
#include "sdf/model/model.h"
#include "sdf/shape/operators/booleans.h"
#include "viewer/shaders/filter.h"
#include "viewer/shaders/sharing.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace {

/// A scene's half spaces, and its other parts with their operands.
struct Split {
  std::vector<HalfSpace> planes;
  std::vector<DrawnMesh> drawn;
  std::vector<Shape> others;
  std::vector<NumberedOperand> marched, all;
};

// The operand as triangles, if it is a mesh that is drawn.
std::optional<DrawnMesh> drawnMeshOf(const Shape& shape, const NumberedOperand& operand) {
  auto placed = placedMesh(operand.distance);
  if (!placed) return {};
  const bool own = hasOwnMaterial(shape, *placed->field);
  return DrawnMesh{operand, std::move(*placed), own};
}

Split split(const Scene& scene, bool withPlanes, bool withDrawn) {
  Split result;
  for (const auto& [name, shape] : scene.parts) {
    const auto operands = operandsOf(shape, static_cast<double>(result.all.size()));
    result.all.insert(result.all.end(), operands.begin(), operands.end());
    if (auto plane = withPlanes ? halfSpaceOf(shape, operands.front()) : std::nullopt) {
      result.planes.push_back(std::move(*plane));
      continue;
    }
    result.others.push_back(shape);
    const Shape* const shapes = isHardUnion(shape) ? shape.outer->operands.data() : &shape;
    for (std::size_t i = 0; i < operands.size(); ++i)
      if (auto mesh = withDrawn ? drawnMeshOf(shapes[i], operands[i]) : std::nullopt)
        result.drawn.push_back(std::move(*mesh));
      else
        result.marched.push_back(operands[i]);
  }
  return result;
}

bool hasSlope(const Shape& shape) { return marchable(shape).slope < kInfinity; }

/// The innermost node without a known slope, of which all that it is made of has one.
Expr innermostSteep(const Expr& e) {
  for (int i = 0; isOperation(e.op()) && i < arity(e.op()); ++i)
    if (e.arg(i).lipschitz() == kInfinity) return innermostSteep(e.arg(i));
  return e;
}

/// What to do about a shape without a known slope.
std::string cureOf(const Shape& shape) {
  if (shape.takesLipschitz) return "give its field() a lipschitz, or bounds within which the formula has one";
  const std::string origin =
      shape.formulaAt.empty() ? originOf(innermostSteep(shape.distance)) : "the formula";
  return "let " + (origin.empty() ? "it" : origin) +
         " have one for all places and all values of parameters: clamp what grows without end, keep what is "
         "divided by, and what roots are taken of, away from 0, and leave out jumps, as of floor";
}

/// Names the first shape without a known slope: by the line of its formula if it has one, else by its part.
Error withoutSlope(const Scene& scene) {
  const Part& part = *std::ranges::find_if_not(scene.parts, hasSlope, &Part::shape);
  const Shape* shape = &part.shape;
  if (shape->outer) {
    const auto& operands = shape->outer->operands;
    const auto found = std::ranges::find_if_not(operands, hasSlope);
    if (found != operands.end()) shape = &*found;
  }
  const std::string subject = shape->formulaAt.empty() ? "part '" + part.name + "'" : shape->formulaAt;
  return {ErrorKind::Scene,
          subject + ": the slope of this distance is not known, so rays cannot be marched to it; " +
              cureOf(*shape)};
}

Result<Marched> marched(const Shape& shape, const Scene& scene, const ShaderOptions& options) {
  const Marchable m = marchable(shape, options.steps);
  if (m.slope < kInfinity) return Marched{hoisted(m.distance), hoisted(m.step), shape.bounds};
  return withoutSlope(scene);
}

void planSurface(const Shape& whole, std::vector<NumberedOperand> operands, Plan& plan) {
  OperandSurfaces byNumber =
      surfaceOf(whole, Expr::parameter({hidden("operand"), 0.0, 0.0, kInfinity}), plan.options.sharing);
  if (byNumber.attributes != whole.surface) plan.operands = std::move(operands);
  std::vector<Expr> surface;
  for (const Expr& e : byNumber.attributes) surface.push_back(hoisted(e));
  plan.surfaceRows = std::move(byNumber.operands);
  Filtered shown = filtered(surface);
  plan.surface = std::move(shown.outputs);
  plan.filters = shown.changed;
}

void planShadows(const Scene& scene, Plan& plan) {
  const auto isPoint = [](const Light& light) { return light.radius.isConstant(0.0); };
  const auto isSized = [](const Light& l) { return l.radius.isConstant() && !l.radius.isConstant(0.0); };
  plan.sized = !std::ranges::all_of(scene.lights, isPoint);
  plan.shadow = std::ranges::all_of(scene.lights, isSized) ? Shadow::Kind::Hard : scene.shadow.kind;
}

void planKinds(const std::vector<NumberedOperand>& operands, Plan& plan) {
  Kinds kinds;
  const bool mayList = plan.options.culling && operands.size() >= CellSorter::kFewest;
  if (mayList) kinds = kindsOf(operands, Grouping::Singles);
  if (mayList && CellSorter::worthwhile(kinds.many))
    plan.cells.emplace(kinds.many);
  else
    kinds = kindsOf(operands);
  if (!kinds.many.empty() || !plan.drawn.empty()) plan.kinds = std::move(kinds);
}

// Takes the balls out of the shapes, and returns them, if they are few.
std::vector<Ball> takeBalls(std::vector<Shape>& shapes) {
  constexpr std::size_t kFew = 16;  // each of which every ray looks at
  std::vector<Ball> balls;
  std::vector<Shape> others;
  for (const Shape& shape : shapes)
    if (auto ball = ballOf(shape))
      balls.push_back(std::move(*ball));
    else
      others.push_back(shape);
  if (balls.size() > kFew) return {};
  shapes = std::move(others);
  return balls;
}

// Balls are met by their roots where no pass looks for tiles that show the background alone.
Status planRest(std::vector<Shape> others, const Scene& scene, Plan& plan) {
  if (plan.planes.empty()) {
    plan.rest = plan.whole;
    return okStatus();
  }
  if (!plan.kinds) plan.balls = takeBalls(others);
  return others.empty() ? okStatus() : keep(marched(unite(others), scene, plan.options), plan.rest);
}

}  // namespace

int usefulSamples(const Plan& plan) {
  constexpr int kOfEdges = 6, kOfSpread = 16;
  return plan.sized || plan.glossy || plan.lens ? kOfSpread : kOfEdges;
}

Result<Plan> planOf(const Scene& scene, const ShaderOptions& options) {
  const Shape whole = scene.whole();
  Plan plan;
  plan.options = options;
  if (auto s = keep(marched(whole, scene, options), plan.whole); !s) return s.error();
  // Occlusion by steps counts the readings of the whole.
  const bool stepsCount = scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps;
  const View view = options.view;
  const bool isPicture = isLit(view);
  plan.meshed = showsMesh(view);
  const bool mirrors = !whole.surface[static_cast<int>(Attribute::Reflectivity)].isConstant(0.0);
  // Counts of steps, gradients and slices are the whole's.
  const bool showsHits = isPicture || view == View::Normals || view == View::Material ||
                         view == View::Occlusion || view == View::Shadow;
  // A group is read without what marchable() adds where a slope is known near the bounds only.
  const bool mayGroup = options.sharing && slopeOf(whole) < kInfinity;
  // Each pixel's rays through a lens are others.
  plan.lens = view == View::Picture && !scene.camera.aperture.isConstant(0.0);
  const bool draws = options.drawing && mayGroup && showsHits && !stepsCount && !plan.lens && !plan.meshed;
  Split parts = split(scene, !stepsCount, draws);
  plan.planes = std::move(parts.planes);
  plan.drawn = std::move(parts.drawn);
  if (mayGroup) planKinds(parts.marched, plan);
  plan.gradients = plan.kinds && sharesGradients(plan);
  if (auto s = planRest(std::move(parts.others), scene, plan); !s) return s.error();
  plan.cones = plan.rest && options.method == Method::AutoRelaxed && options.start != Start::Plain &&
               !stepsCount && !plan.lens && !plan.meshed;
  plan.tiled = plan.cones && isPicture && plan.planes.empty() && plan.drawn.empty();
  plan.plain = options.method == Method::Plain || stepsCount;
  plan.lights = (isPicture || view == View::Shadow) && !scene.lights.empty();
  if (plan.lights && scene.shadow.kind != Shadow::Kind::None) planShadows(scene, plan);
  plan.around = isPicture && !scene.backgroundLight.isConstant(0.0);
  // To a triangle there are no steps.
  if ((isPicture || view == View::Occlusion) && !(plan.meshed && stepsCount))
    plan.occlusion = scene.ambientOcclusion.kind;
  if (isPicture && mirrors) plan.bounces = scene.reflectionBounces;
  plan.glossy = plan.bounces > 0 && scene.glossyReflections;
  if (isPicture || view == View::Material) planSurface(whole, std::move(parts.all), plan);
  plan.looks = (plan.meshed || !plan.drawn.empty()) && (isPicture || view == View::Material);
  plan.grouped =
      plan.meshed || (plan.kinds && showsHits && ((plan.cones && !plan.cells) || !plan.drawn.empty()));
  plan.hull = options.start == Start::Raster && plan.cones && !plan.grouped && view != View::Slice &&
              plan.rest && plan.rest->bounds.finite();
  return plan;
}

}  // namespace sdf::viewer
