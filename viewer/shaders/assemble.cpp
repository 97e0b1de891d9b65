#include "viewer/shaders/assemble.h"

#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/operand.h"
#include "viewer/shaders/filter.h"
#include "viewer/shaders/group_shaders.h"
#include "viewer/shaders/parts.h"
#include "viewer/shaders/source.h"
#include "viewer/shaders/winner.h"

namespace sdf::viewer {
namespace {

constexpr const char* kAttributeNames[kAttributeCount] = {
    "RED",          "GREEN",          "BLUE",           "AMBIENT_RED",   "AMBIENT_GREEN", "AMBIENT_BLUE",
    "SPECULAR_RED", "SPECULAR_GREEN", "SPECULAR_BLUE",  "SHININESS",     "REFLECTIVITY",  "FRESNEL_POWER",
    "FRESNEL_BIAS", "EMISSION_RED",   "EMISSION_GREEN", "EMISSION_BLUE", "MATERIAL_ID"};

/// A scene's half spaces, which rays meet without marching, and what else there is.
struct Split {
  std::vector<Expr> planes;  ///< of each its distance, and how that changes along the direction in normal()
  std::vector<Expr> asWritten;  ///< the planes' distances as the scene has them
  std::vector<Shape> others;
};

Split split(const Scene& scene) {
  Split result;
  for (const Part& part : scene.parts) {
    const Vec3E g = gradientOf(part.shape.distance);
    if (dependsOnSpace(g.x) || dependsOnSpace(g.y) || dependsOnSpace(g.z)) {
      result.others.push_back(part.shape);
    } else {
      const Expr steep = length(g), once = steep.isConstant(1.0) ? Expr(1.0) : 1.0 / steep;
      result.asWritten.push_back(part.shape.distance);
      result.planes.push_back(part.shape.distance * once);
      result.planes.push_back(dot(g, normal()) * once);
    }
  }
  return result;
}

/// What is read along rays: the whole, or a part of it, divided by its slope.
struct Read {
  Shape shape;
  double inverse = 1.0;
  Expr unhoisted;  // its distance as the scene has it
};

/// With the slope that the shape claims everywhere, or else the one that its formula has near its bounds.
/// Beyond these the formula may be steeper; there the way to the bounds is free.
Result<Read> read(Shape shape) {
  double slope = slopeOf(shape);
  if (slope == kInfinity && shape.bounds.finite()) {
    const Box near = shape.bounds.grown(0.5 * shape.bounds.longestSide());
    slope = lipschitzOver(Tape(shape.distance), near);
    if (slope < kInfinity)
      shape.distance =
          select(less(0.0, *outsideBox(near)), *outsideBox(shape.bounds) * slope, shape.distance);
  }
  if (!(slope < kInfinity))
    return Error{
        ErrorKind::Scene,
        "the distance has no known slope, so its rays cannot be marched; give its field() bounds and a "
        "lipschitz constant"};
  const Expr unhoisted = std::exchange(shape.distance, hoisted(shape.distance));
  return Read{std::move(shape), slope > 0.0 ? 1.0 / slope : 1.0, unhoisted};
}

class Assembler {
 public:
  Assembler(const Scene& scene, const ShaderOptions& options, Read whole, std::optional<Read> rest,
            Split parts)
      : scene_(scene),
        options_(options),
        whole_(std::move(whole.shape)),
        unhoisted_(std::move(whole.unhoisted)),
        inverse_(whole.inverse),
        rest_(std::move(rest)),
        planes_(std::move(parts.planes)),
        planesAsWritten_(std::move(parts.asWritten)) {}

  SceneShaders run() {
    SceneShaders result;
    result.counted = options_.countReadings;
    const bool isPicture = options_.view == View::Picture;
    const bool cones = options_.method == Method::AutoRelaxed && !stepsCount();
    if (cones && isPicture && options_.grouped) result.groups = groups();
    fromHits_ = !result.groups.empty();
    result.values = functions();
    if (cones && !fromHits_)
      result.cones = header(options_.es) + result.values.source() + defines(false) + parts::kCamera +
                     parts::kRest + farEnd(restBounds()) + parts::kCones;
    result.tiled = cones && planes_.empty() && isPicture &&
                   (fromHits_ || topologicalOrder({&whole_.distance, 1}).size() < kLongProgram);
    const std::string body = isPicture ? picture(result.values) : debugView(result.values);
    result.picture = header(options_.es) + (filters_ ? kFootprintVariables : "") +
                     (fromHits_ ? "float winner = 0.0;\n" : "") + result.values.source() +
                     defines(!result.cones.empty()) + body + encoding() + parts::kPicture;
    result.resolve = header(options_.es) + encoding() + parts::kResolve;
    return result;
  }

 private:
  // Those that march or meet planes.
  GlslWriter functions() const {
    GlslWriter writer;
    for (const Part& part : scene_.parts) {
      writer.label(part.shape.distance, "part '" + part.name + "'");
      for (const Expr& e : part.shape.surface) writer.label(e, "part '" + part.name + "'");
    }
    if (readsDistance()) writer.add("sdfDistance", {&whole_.distance, 1});
    if (!planes_.empty()) writer.add("sdfPlanes", planes_);
    if (rest_ && readsDistance()) writer.add("sdfRest", {&rest_->shape.distance, 1});
    if (!planes_.empty() && fromHits_) addNearestPlane(writer);
    return writer;
  }

  bool stepsCount() const { return scene_.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps; }
  bool taps() const { return scene_.ambientOcclusion.kind == AmbientOcclusion::Kind::Taps; }
  bool shadows() const { return scene_.shadow.kind != Shadow::Kind::None && !scene_.lights.empty(); }

  bool mirrors() const {
    return scene_.reflectionBounces > 0 &&
           !whole_.surface[static_cast<int>(Attribute::Reflectivity)].isConstant(0.0);
  }

  bool marches() const { return !fromHits_ || mirrors(); }
  bool readsDistance() const { return marches() || shadows() || taps(); }

  std::string encoding() const {
    if (options_.view != View::Picture && options_.view != View::Material) return define("ENCODE(c)", "(c)");
    if (!scene_.gamma) return parts::kSrgb + define("ENCODE(c)", "encode(c)");
    return define("ENCODE(c)", *scene_.gamma == 1.0
                                   ? "(c)"
                                   : "pow(max(c, 0.0), vec3(" + number(1.0 / *scene_.gamma) + "))");
  }

  std::string defines(bool cones) const {
    std::string text;
    const auto set = [&](const std::string& name, const std::string& value) { text += define(name, value); };
    const auto count = [&](const std::string& name, const std::string& what) {
      set(name, options_.countReadings ? what : "");
    };
    if (options_.method == Method::Plain || stepsCount()) text += "#define METHOD_PLAIN\n";
    set("INVERSE_SLOPE", number(inverse_));
    set("REST", planes_.empty() ? "sdfDistance(p, vec3(0.0)) * INVERSE_SLOPE"
                : rest_         ? "sdfRest(p, vec3(0.0)) * " + number(rest_->inverse)
                                : "1e30");
    set("SHARE", "1.0");
    set("PLANES", std::to_string(planes_.size()));
    set("PLANE_NORMAL", planes_.empty() ? "vec3(0.0)" : "normalize(sdfPlaneGradient(p, vec3(0.0)))");
    if (restBounds().finite()) {
      set("BOX_MIN", vector(restBounds().min));
      set("BOX_MAX", vector(restBounds().max));
    }
    set("OPERANDS", number(operandsInAll_));
    set("PLANE_WINNER", planes_.empty() ? "0.0" : "sdfPlaneWinner(p, vec3(0.0))");
    set("SURFACE", !fromHits_  ? "sdfSurface(p, n, s);"
                   : mirrors() ? "if (bounce == 0) sdfTakenSurface(p, n, s); else sdfSurface(p, n, s);"
                               : "sdfTakenSurface(p, n, s);");
    set("FIRST(taken, marched)", !fromHits_  ? "marched"
                                 : mirrors() ? "(bounce == 0 ? taken : marched)"
                                             : "taken");
    set("FOOTPRINT", filters_ ? "setFootprint(n, d, ray.before + t);" : "");
    set("LIGHTS", std::to_string(scene_.lights.size()));
    set("TAPS", std::to_string(scene_.ambientOcclusion.count));
    set("BOUNCES", std::to_string(mirrors() ? scene_.reflectionBounces : 0));
    set("OCCLUSION", taps() ? "occlusion(p, n)" : "1.0");
    set("STEP_OCCLUSION", stepsCount() ? "max(0.0, 1.0 - tapStrength * float(readings))" : "1.0");
    set("DIRECT", scene_.lights.empty() ? "vec3(0.0)" : "direct(p, n, d, s)");
    set("SHADE_LIGHT", shadows()
                           ? "if (lightColor[i].w > 0.0) light *= shadow(p, l, lightVector[i].w > 0.0 ? "
                             "min(shadowReach, far) : shadowReach);"
                           : "");
    set("SPAN", cones ? "texelFetch(starts, ivec2(gl_FragCoord.xy) / 4, 0).rb" : "vec2(0.0, 1e30)");
    if (cones) text += "uniform sampler2D starts;\n";
    count("COUNT_MARCH", "counted[bounce == 0 ? 0 : 3] += float(readings);");
    count("COUNT_PRIMARY", "counted[0] += float(readings);");
    count("COUNT_SHADOW", "counted[1] += 1.0;");
    count("COUNT_OCCLUSION", "counted[2] += 1.0;");
    count("STORE_COUNTS", "counts = weight * counted;");
    if (options_.countReadings) text += "layout(location = 1) out vec4 counts;\nvec4 counted = vec4(0.0);\n";
    set("ATTRIBUTES", std::to_string(kAttributeCount));
    for (int i = 0; i < kAttributeCount; ++i)
      text += std::string("const int ") + kAttributeNames[i] + " = " + std::to_string(i) + ";\n";
    return text;
  }

  std::string marching() const {
    return std::string(parts::kCamera) + (readsDistance() ? parts::kField : "") +
           (readsDistance() ? parts::kRest : "") + (planes_.empty() ? parts::kNoPlanes : parts::kPlanes) +
           (marches() ? parts::kMarch : "") +
           (fromHits_ ? std::string(parts::kFavoured) + parts::kTakenHits : "");
  }

  // Adds the surface's attributes.
  std::string surface(GlslWriter& writer) {
    if (marches()) addSurface(writer, "sdfSurface", whole_.surface);
    if (fromHits_) {
      writer.substitute(hidden("winner"), "winner");
      addSurface(writer, "sdfTakenSurface", takenSurface_);
    }
    return filters_ ? parts::kFootprint : "";
  }

  void addSurface(GlslWriter& writer, const std::string& name, std::span<const Expr> attributes) {
    std::vector<Expr> outputs;
    for (const Expr& e : attributes) outputs.push_back(hoisted(e));
    const Filtered f = filtered(outputs, writer);
    writer.add(name, f.outputs);
    filters_ = filters_ || f.changed;
  }

  // Which of the planes is nearest, and its gradient.
  void addNearestPlane(GlslWriter& writer) const {
    std::vector<Expr> heights, numbers;
    for (const Numbered& plane : planeOperands_) {
      heights.push_back(plane.distance);
      numbers.emplace_back(plane.number);
    }
    const Expr winner = numberOfLeast(heights, numbers);
    writer.add("sdfPlaneWinner", {&winner, 1});
    Expr nearest = heights.front();
    for (const Expr& height : heights) nearest = min(nearest, height);
    const Vec3E g = gradientOf(nearest);
    const Expr all[] = {g.x, g.y, g.z};
    writer.add("sdfPlaneGradient", all);
  }

  // Makes ready for pictures from hits, too.
  std::vector<GroupShaders> groups() {
    if (!planes_.empty() && !rest_) return {};
    const std::vector<Expr> all = operandsOf(unhoisted_);
    std::unordered_map<Expr, double> numbers;
    for (const Expr& e : all) numbers.emplace(e, static_cast<double>(numbers.size()));
    std::vector<Numbered> operands;
    for (const Expr& e : operandsOf(rest_ ? rest_->unhoisted : unhoisted_)) {
      if (!numbers.contains(e)) return {};  // the rest is read in another way
      operands.push_back({e, numbers.at(e)});
    }
    for (const Expr& e : planesAsWritten_) planeOperands_.push_back({e, numbers.at(e)});
    takenSurface_ =
        decided(whole_.surface, unhoisted_, Expr::parameter({hidden("winner"), 0.0, 0.0, kInfinity}));
    const bool winners = !std::equal(takenSurface_.begin(), takenSurface_.end(), whole_.surface.begin());
    operandsInAll_ = static_cast<double>(all.size());
    return groupShaders(operands, operandsInAll_, winners, rest_ ? rest_->inverse : inverse_, restBounds(),
                        options_);
  }

  const Box& restBounds() const { return rest_ ? rest_->shape.bounds : whole_.bounds; }

  std::string shadowPart() const {
    const char* kinds[] = {"", parts::kHardShadow, parts::kSoftShadow, parts::kImprovedShadow,
                           parts::kSignedShadow};
    if (!shadows()) return "";
    return std::string(restBounds().finite() ? parts::kShadowSpan : parts::kNoShadowSpan) +
           (planes_.empty() ? parts::kNoPlanesLight : parts::kPlanesLight) + parts::kShadowSettings +
           kinds[static_cast<int>(scene_.shadow.kind)];
  }

  std::string occlusionPart() const {
    if (taps()) return parts::kOcclusionTaps;
    return stepsCount() ? "uniform float tapStrength;\n" : "";
  }

  std::string picture(GlslWriter& writer) {
    const std::string footprint = surface(writer);
    const Vec3E& b = scene_.background;
    const Expr background[] = {b.x, b.y, b.z};
    writer.add("sdfBackground", background);
    std::string text = marching() + footprint + (marches() ? normals(writer, whole_.distance) : "") +
                       shadowPart() + occlusionPart();
    if (!scene_.lights.empty()) text += std::string(parts::kLightSettings) + parts::kLights;
    return text + parts::kRadiance + parts::kColor;
  }

  std::string debugView(GlslWriter& writer) {
    const std::string start = marching() + parts::kHit;
    switch (options_.view) {
      case View::Steps:
        return start + parts::kStepsView;
      case View::Slice:
        return start + parts::kSliceView;
      case View::Normals:
        return start + normals(writer, whole_.distance) + parts::kNormalsView;
      case View::Gradient:
        return start + normals(writer, whole_.distance) + parts::kGradientView;
      case View::Occlusion:
        return start + normals(writer, whole_.distance) + occlusionPart() + parts::kOcclusionView;
      case View::Material:
        return start + surface(writer) + normals(writer, whole_.distance) + parts::kMaterialView;
      default:
        break;
    }
    return shadows() ? start + shadowPart() + parts::kLightSettings + parts::kShadowView
                     : start +
                           "vec3 colorOf(Ray ray, float t, out bool budget) {\n  int readings;\n"
                           "  return hit(ray, t, budget, readings) ? vec3(1.0) : NOTHING;\n}\n";
  }

  const Scene& scene_;
  const ShaderOptions& options_;
  Shape whole_;
  Expr unhoisted_;
  double inverse_;
  std::optional<Read> rest_;  // if there are planes, and more than planes
  std::vector<Expr> planes_;
  std::vector<Expr> planesAsWritten_;
  double operandsInAll_ = 0.0;
  std::vector<Numbered> planeOperands_;  // of the union's operands
  std::vector<Expr> takenSurface_;       // from the winner's number
  bool fromHits_ = false;                // what is written takes the groups' hits
  bool filters_ = false;                 // it does, which is known once the surface is written
};

// After the line with the version.
std::string defining(const std::string& name, const std::string& shader) {
  const std::size_t line = shader.find('\n') + 1;
  return shader.substr(0, line) + "#define " + name + "\n" + shader.substr(line);
}

}  // namespace

std::size_t SceneShaders::bytes() const {
  std::size_t sum = picture.size() + cones.size();
  for (const GroupShaders& group : groups) sum += group.cones.size() + group.hits.size();
  return sum;
}

Result<SceneShaders> assemble(const Scene& scene, const ShaderOptions& options) {
  if (const auto sound = checked(scene); !sound) return sound.error();
  auto whole = read(scene.whole());
  if (!whole) return whole.error();
  // Occlusion by steps counts the readings of the whole.
  Split parts = scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps ? Split() : split(scene);
  std::optional<Read> rest;
  if (!parts.planes.empty() && !parts.others.empty()) {
    auto others = read(unite(parts.others));
    if (!others) return others.error();
    rest = std::move(*others);
  }
  return Assembler(scene, options, std::move(*whole), std::move(rest), std::move(parts)).run();
}

std::string forBackground(const std::string& picture) { return defining("BACKGROUND_ONLY", picture); }

}  // namespace sdf::viewer
