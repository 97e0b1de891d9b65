#include "viewer/shaders/assemble.h"

#include <algorithm>
#include <map>

#include "sdf/model/float_range.h"
#include "viewer/shaders/error_colors.h"
#include "viewer/shaders/filter.h"
#include "viewer/shaders/hit_shaders.h"
#include "viewer/shaders/light_parts.h"
#include "viewer/shaders/ray_parts.h"
#include "viewer/shaders/sharing.h"
#include "viewer/shaders/source.h"
#include "viewer/shaders/triangle_parts.h"
#include "viewer/shaders/unsteady.h"
#include "viewer/shaders/view_parts.h"

namespace sdf::viewer {
namespace {

// The last attribute, the material's number, is shown by no shader.
// clang-format off
constexpr const char* kAttributeNames[kAttributeCount - 1] = {
    "RED", "GREEN", "BLUE", "AMBIENT_RED", "AMBIENT_GREEN", "AMBIENT_BLUE", "SPECULAR_RED", "SPECULAR_GREEN",
    "SPECULAR_BLUE", "SHININESS", "REFLECTIVITY", "FRESNEL_POWER", "FRESNEL_BIAS", "EMISSION_RED",
    "EMISSION_GREEN", "EMISSION_BLUE"};
// clang-format on

using ShadowKind = Shadow::Kind;
using OcclusionKind = AmbientOcclusion::Kind;

GlslWriter labelled(const Scene& scene, const Plan& plan) {
  GlslWriter writer(plan.numbers);
  writer.computeExactly(plan.exact);
  for (const Part& part : scene.parts) {
    std::vector<Expr> own{part.shape.distance};
    own.insert(own.end(), part.shape.surface.begin(), part.shape.surface.end());
    for (const Expr& e : withoutClaims(own)) writer.label(e, "part '" + part.name + "'");
  }
  return writer;
}

void takeUnsteady(const Unsteady& unsteady, Plan& plan) {
  const bool doubles = plan.options.doubles && !plan.options.es;
  if (doubles) plan.exact.insert(plan.exact.end(), unsteady.nodes.begin(), unsteady.nodes.end());
  if (doubles && std::ranges::all_of(unsteady.nodes, canBeExact)) return;
  plan.doubtful.push_back(
      "part '" + unsteady.part->name +
      "': its formula needs more digits than the graphics card's floats have, as a hash by "
      "fract(sin(…) * 43758.5) does; the picture differs from the mesh, which is made in "
      "double. Take a hash of smaller numbers");
}

// What is shown of a linear colour c, by debug views as it is.
std::string encoding(const Scene& scene, const Plan& plan) {
  if (!isLit(plan.options.view) && plan.options.view != View::Material) return "(c)";
  const bool isPicture = isLit(plan.options.view);
  const std::string toned = isPicture && scene.tone == Tone::Filmic ? "filmic(c)" : "c";
  const std::string curve = !scene.gamma ? "encode(" + toned + ")"
                            : *scene.gamma == 1.0
                                ? "(" + toned + ")"
                                : "pow(max(" + toned + ", 0.0), vec3(" + number(1.0 / *scene.gamma) + "))";
  return isPicture ? "dithered(" + curve + ")" : curve;
}

std::string encoder(const Scene& scene, const Plan& plan) {
  const bool isPicture = isLit(plan.options.view);
  const bool isSrgb = !scene.gamma && (isPicture || plan.options.view == View::Material);
  return std::string(isSrgb ? parts::kSrgb : "") +
         (isPicture && scene.tone == Tone::Filmic ? parts::kFilmic : "") + (isPicture ? parts::kDither : "");
}

// Those that later parts choose by, pixel by pixel.
std::string choosing(const Plan& plan) {
  const bool chooses = plan.sized || plan.glossy || plan.lens;
  return std::string(chooses || isLit(plan.options.view) ? parts::kBayer : "") +
         (chooses ? parts::kChosen : "");
}

// The primary rays are marched by the picture's shader, from where the cones say.
bool startsHere(const Plan& plan) { return plan.cones && !plan.grouped && plan.options.view != View::Slice; }

// Shadows of these kinds are looked for between the half spaces, the balls and the rest.
bool marchesRest(const Plan& plan) {
  return plan.shadow == ShadowKind::Hard || plan.shadow == ShadowKind::Soft;
}

bool readsRest(const Plan& plan) { return marchesRest(plan) || plan.sized; }

const Box& boundsOfRest(const Plan& plan) { return plan.rest ? plan.rest->bounds : plan.whole.bounds; }

// It is there already; and llvmpipe compiles a shader that may discard once, and else twice. Rays that are
// followed further would take a third longer.
bool leavesBackground(const Plan& plan) {
  return plan.tiled && plan.bounces == 0 && !plan.options.countReadings;
}

Macros pictureMacros(const Scene& scene, const Plan& plan, const std::string& takeSurface = "") {
  const bool taps = plan.occlusion == OcclusionKind::Taps, steps = plan.occlusion == OcclusionKind::Steps;
  const auto count = [&](const char* what) { return plan.options.countReadings ? what : ""; };
  Macros macros;
  macros["COUNT_MARCH"] = count("counted[bounce == 0 ? 0 : 3] += float(hit.readings);");
  macros["COUNT_SHADOW"] = count("counted[1] += 1.0;");
  macros["COUNT_OCCLUSION"] = count("counted[2] += 1.0;");
  macros["STORE_COUNTS"] = count("counts = weight * counted;");
  macros["ENCODE(c)"] = encoding(scene, plan);
  macros["START_RAY"] = startsHere(plan) ? "startRay(ray);" : plan.lens ? "throughLens(ray);" : "";
  macros["FIND_HIT"] = !plan.grouped       ? "hit = meet(ray);"
                       : plan.bounces == 0 ? "hit = primaryHit();"
                                           : "if (bounce == 0) hit = primaryHit(); else hit = meet(ray);";
  macros["TAKE_OPERAND"] = plan.operands.empty() ? "" : "operand = hit.operand;" + takeSurface;
  const std::string take = plan.meshed ? "takeMeshLook(hit, s);" : "takeLook(hit, s);";
  macros["TAKE_LOOK"] = !plan.looks ? "" : (plan.bounces > 0 ? "if (bounce == 0) " : "") + take;
  macros["LIFT"] = plan.meshed ? "if (bounce == 0) p -= min(field(p).y, 0.0) * n;" : "";
  macros["EDGED(c)"] = plan.options.view == View::Wire ? "(bounce == 0 ? edged(c) : c)" : "(c)";
  macros["FOOTPRINT"] = plan.filters ? "setFootprint(n, d, ray.before + t);" : "";
  macros["LEAVE_BACKGROUND"] = leavesBackground(plan) ? "discard;" : "";
  macros["LIGHTS"] = std::to_string(scene.lights.size());
  macros["TAPS"] = std::to_string(scene.ambientOcclusion.count);
  macros["BOUNCES"] = std::to_string(plan.bounces);
  macros["MIRRORED"] = plan.glossy ? "glossy(d, n, s[SHININESS])" : "reflect(d, n)";
  macros["AMBIENT"] = plan.around ? "(ambient + lightAround(n))" : "ambient";
  macros["OCCLUSION"] = taps ? "occlusion(p, n)" : "1.0";
  macros["STEP_OCCLUSION"] = steps ? "max(0.0, 1.0 - tapStrength * float(hit.readings))" : "1.0";
  macros["DIRECT"] = plan.lights ? "direct(p, n, d, s)" : "vec3(0.0)";
  macros["SHADE_LIGHT"] =
      plan.shadow == ShadowKind::None ? "" : "if (lightColor[i].w > 0.0) light *= arriving(i, p, l, far);";
  macros["READ_BY_SHADOWS(p, enough)"] = readsRest(plan) ? "rest(p, enough)" : "field(p)";
  macros["READS_MORE"] = readsRest(plan) && !marchesRest(plan) ? "true" : "false";
  macros["SHADOW_SPENT"] = plan.shadow == ShadowKind::None ? "false" : "shadowSpent";
  macros["ERROR_COLORS"] = std::to_string(kErrorColors.size());
  macros["ATTRIBUTES"] = std::to_string(kAttributeCount);
  for (int i = 0; i + 1 < kAttributeCount; ++i) macros[kAttributeNames[i]] = std::to_string(i);
  return macros;
}

std::string shadowParts(const Plan& plan) {
  if (plan.shadow == ShadowKind::None) return "";
  const char* const kinds[] = {"", parts::kHardShadow, parts::kSoftShadow, parts::kImprovedShadow,
                               parts::kSignedShadow};
  const bool looks = plan.sized || plan.shadow == ShadowKind::Hard;
  const std::string shadow = parts::kShadowSettings + std::string(looks ? parts::kVisible : "") +
                             kinds[static_cast<int>(plan.shadow)] +
                             (plan.sized ? parts::kArrivingSized : parts::kArriving);
  if (!readsRest(plan)) return shadow;
  return (boundsOfRest(plan).finite() ? parts::kShadowSpan : parts::kNoShadowSpan) +
         std::string(plan.planes.empty() ? parts::kNoPlanesLight : parts::kPlanesLight) +
         (plan.balls.empty() ? parts::kNoBallsLight : parts::kBallsLight) + shadow;
}

// Those of parts::kShadowSpan, which reads it.
Macros spanMacros(const Plan& plan, GlslWriter& writer) {
  const Box& bounds = boundsOfRest(plan);
  if (plan.shadow == ShadowKind::None || !readsRest(plan) || !bounds.finite()) return {};
  return {{"BOX_MIN", vector(bounds.min, writer)}, {"BOX_MAX", vector(bounds.max, writer)}};
}

// Those that define colorOf(ray, spent), beside what it calls.
std::string colorParts(const Plan& plan) {
  if (isLit(plan.options.view))
    return (plan.lights ? parts::kLights : "") + std::string(plan.glossy ? parts::kGlossy : "") +
           (plan.lens ? parts::kLens : "") + (plan.around ? parts::kLightAround : "") + parts::kRadiance;
  const char* const shadows = plan.shadow == ShadowKind::None ? parts::kHitsView : parts::kShadowView;
  const char* const views[] = {"",
                               parts::kNormalsView,
                               parts::kStepsView,
                               parts::kSliceView,
                               parts::kGradientView,
                               parts::kMaterialView,
                               parts::kOcclusionView,
                               shadows};
  const View shown = plan.options.view;
  const std::string view = shown == View::Error ? parts::kErrorView : views[static_cast<int>(shown)];
  return parts::kNothing + view + (plan.options.view == View::Slice ? "" : parts::kHitColor);
}

std::string pictureBody(const Scene& scene, const Plan& plan, const Obstacles& obstacles,
                        const RowWriter& rows, GlslWriter& writer) {
  const bool meets = (!plan.grouped && plan.options.view != View::Slice) || plan.bounces > 0;
  const bool readsField = plan.occlusion == OcclusionKind::Taps || plan.shadow == ShadowKind::Improved ||
                          plan.shadow == ShadowKind::Signed || (plan.meshed && isLit(plan.options.view));
  std::string text = std::string(parts::kCamera) + parts::kHit;
  if (plan.options.countReadings) text += parts::kPictureCounts;
  if (startsHere(plan)) text += parts::kRayStarts;
  if (plan.grouped) text += parts::kHitFromLayers;
  if (plan.looks) text += parts::kTakeLook;
  if (plan.looks && plan.meshed) text += parts::kTakeMeshLook;
  if (plan.options.view == View::Wire) text += parts::kEdged;
  if (plan.kinds && (meets || readsRest(plan) || readsField || plan.options.view == View::Slice))
    text += sharing(plan, rows, writer);
  if (meets)
    text += meeting(obstacles);
  else if (readsRest(plan))
    text += parts::kRest;
  if (readsField) text += parts::kField;
  if (plan.filters) text += parts::kFootprint;
  if (plan.lights) text += parts::kLightSettings;
  const char* const occlusions[] = {"", parts::kOcclusionTaps, parts::kOcclusionSteps};
  text += occlusions[static_cast<int>(plan.occlusion)];
  return text + choosing(plan) + shadowParts(plan) + colorParts(plan) + encoder(scene, plan) +
         parts::kPicture;
}

// Those of the kinds, and then those of the surfaces.
RowWriter rowsOf(const Plan& plan) {
  RowWriter rows(plan.options.es);
  if (plan.kinds)
    for (const OperandKind& kind : plan.kinds->many) rows.add(kind.groups);
  if (!plan.surfaceRows.parameters.empty()) rows.add(plan.surfaceRows);
  return rows;
}

Shader picture(const Scene& scene, const Plan& plan, const Obstacles& obstacles, const RowWriter& rows,
               GlslWriter writer) {
  std::size_t taken = plan.kinds ? plan.kinds->many.size() : 0;
  std::string takeSurface;
  if (!plan.surfaceRows.parameters.empty()) {
    const RowRange& range = rows.rangeOf(taken);
    takeSurface = " sdfTake" + std::to_string(taken++) + "(" + std::to_string(range.first) + " + " +
                  std::to_string(range.stride) + " * int(operand));";
  }
  Macros macros = pictureMacros(scene, plan, takeSurface);
  macros.merge(meetingMacros(obstacles, plan));
  Functions functions = meetingFunctions(obstacles);
  if (plan.kinds) functions.merge(sharedFunctions(plan));
  functions["sdfSurface"] = [&] { return plan.surface; };
  functions["sdfBackground"] = [&] { return partsOf(scene.background); };
  std::string globals;
  if (!plan.operands.empty()) {
    globals += "float operand = 0.0;\n";
    writer.substitute(hidden("operand"), "operand");
  }
  if (plan.filters) {
    globals += kFootprintVariables;
    for (const std::string term : kFootprintTerms) writer.substitute(hidden(term), term);
  }
  if (taken > 0) globals += rows.taking(taken, writer);
  macros.merge(spanMacros(plan, writer));
  const std::string body = pictureBody(scene, plan, obstacles, rows, writer);
  Composer composer(plan.options.es, macros, functions, std::move(writer), globals);
  std::string text = composer.compose(body);
  return {std::move(text), composer.uniforms(), taken > 0, composer.volumes()};
}

Shader background(const Scene& scene, const Plan& plan) {
  const Functions functions{{"sdfBackground", [&] { return partsOf(scene.background); }}};
  Macros macros = pictureMacros(scene, plan);
  macros["START_RAY"] = "";
  macros["SHADOW_SPENT"] = "false";
  Composer composer(plan.options.es, macros, functions, GlslWriter(plan.numbers));
  std::string text = composer.compose(
      std::string(parts::kCamera) + (plan.options.countReadings ? parts::kPictureCounts : "") +
      parts::kBackground + parts::kBayer + encoder(scene, plan) + parts::kPicture);
  return {std::move(text), composer.uniforms()};
}

}  // namespace

std::size_t SceneShaders::bytes() const {
  std::size_t sum = picture.text.size() + (boxCones ? boxCones->text.size() : 0);
  for (const HitShaders& pass : hits) sum += pass.cones.size() + pass.hits.size();
  return sum;
}

Status checkNumbers(const Scene& scene) {
  for (const Part& part : scene.parts)
    if (const auto why = beyondFloats(part.shape))
      return Error{ErrorKind::Scene, "part '" + part.name + "': " + *why};
  return okStatus();
}

std::vector<ShaderVolume> volumesOf(const SceneShaders& shaders) {
  std::vector<ShaderVolume> volumes = shaders.picture.volumes;
  for (const HitShaders& pass : shaders.hits)
    volumes.insert(volumes.end(), pass.volumes.begin(), pass.volumes.end());
  return volumes;
}

namespace {

// Payloads of one kind may take each other's places, each the same one's everywhere.
bool canFollow(const std::vector<ShaderVolume>& before, const std::vector<ShaderVolume>& after) {
  std::map<const Payload*, const Payload*> next, previous;
  return std::ranges::equal(before, after, [&](const ShaderVolume& a, const ShaderVolume& b) {
    const Payload *const p = a.payload.get(), *const q = b.payload.get();
    return a.sampler == b.sampler && a.number == b.number &&
           (p == q || (!p->kind().empty() && p->kind() == q->kind())) &&
           next.try_emplace(p, q).first->second == q && previous.try_emplace(q, p).first->second == p;
  });
}

}  // namespace

bool sameCode(const SceneShaders& a, const SceneShaders& b) {
  const auto text = [](const std::optional<Shader>& shader) { return shader ? shader->text : ""; };
  const auto isSamePass = [](const HitShaders& p, const HitShaders& q) {
    return p.cones == q.cones && p.hits == q.hits && p.boxes.empty() == q.boxes.empty();
  };
  const auto isSameMesh = [](const DrawnMesh& m, const DrawnMesh& n) {
    return m.placed.field == n.placed.field && m.own == n.own;
  };
  return a.picture.text == b.picture.text && canFollow(volumesOf(a), volumesOf(b)) &&
         text(a.background) == text(b.background) && text(a.boxCones) == text(b.boxCones) &&
         a.triangles == b.triangles && a.hull == b.hull && a.resolve == b.resolve &&
         std::ranges::equal(a.hits, b.hits, isSamePass) &&
         std::ranges::equal(a.plan.drawn, b.plan.drawn, isSameMesh);
}

namespace {

Result<SceneShaders> written(const Scene& scene, const ShaderOptions& options,
                             std::shared_ptr<ChangingNumbers> numbers) {
  if (const auto sound = checked(scene); !sound) return sound.error();
  if (const Status s = checkNumbers(scene); !s) return s.error();
  const std::vector<Unsteady> unsteady = unsteadyOf(scene);
  if (!unsteady.empty() && options.sharing) {  // their nodes are to be found as they are
    ShaderOptions apart = options;
    apart.sharing = false;
    return written(scene, apart, numbers);
  }
  auto plan = planOf(scene, options);
  if (!plan) return plan.error();
  plan->numbers = numbers;
  for (const Unsteady& part : unsteady) takeUnsteady(part, *plan);
  const RowWriter rows = rowsOf(*plan);
  if (!rows.fits()) {
    ShaderOptions apart = options;
    apart.sharing = false;
    return written(scene, apart, std::move(numbers));
  }
  std::vector<HitShaders> hits;
  std::optional<Shader> boxes;
  std::string triangles, hull;
  if (plan->grouped && !plan->meshed) hits = groupShaders(*plan, rows);
  if (std::ranges::any_of(hits, [](const HitShaders& pass) { return !pass.boxes.empty(); }))
    boxes = boxCones(*plan);
  if (plan->meshed || !plan->drawn.empty()) triangles = triangleShader(*plan);
  if (plan->hull) hull = hullShader(*plan);
  const Obstacles obstacles = obstaclesOf(*plan);
  if (startsHere(*plan)) hits = {startShaders(obstacles, *plan, rows)};
  Shader shown = picture(scene, *plan, obstacles, rows, labelled(scene, *plan));
  std::optional<Shader> tiles;
  if (plan->tiled) tiles = background(scene, *plan);
  Composer resolve(options.es, {{"ENCODE(c)", encoding(scene, *plan)}}, {}, {});
  const char* const dithers = isLit(options.view) ? parts::kBayer : "";
  std::string resolved = resolve.compose(dithers + encoder(scene, *plan) + parts::kResolve);
  std::vector<RowRange> kindRows;
  for (std::size_t i = 0; plan->kinds && i < plan->kinds->many.size(); ++i)
    kindRows.push_back(rows.rangeOf(i));
  return SceneShaders{std::move(*plan), std::move(hits),    std::move(boxes),    std::move(triangles),
                      std::move(hull),  rows.numbers(),     std::move(kindRows), std::move(shown),
                      std::move(tiles), std::move(resolved)};
}

}  // namespace

Result<SceneShaders> assemble(const Scene& scene, const ShaderOptions& options,
                              std::shared_ptr<ChangingNumbers> numbers) {
  if (numbers) {
    numbers->begin();
    if (auto compared = written(scene, options, numbers); !compared) return compared;
    numbers->settle();
  }
  return written(scene, options, std::move(numbers));
}

}  // namespace sdf::viewer
