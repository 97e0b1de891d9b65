#include "viewer/shaders/assemble.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "sdf/eval/scalar_reading.h"
#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "sdf/shape/booleans.h"
#include "sdf/shape/operand.h"
#include "viewer/shaders/filter.h"
#include "viewer/shaders/parts.h"

namespace sdf::viewer {
namespace {

// Drivers inline and unroll, and take seconds over long programs: a gradient of more operations than this is
// taken by differences, and a distance of more has no tiles drawn apart, which would take another program.
constexpr std::size_t kLong = 6000;

constexpr const char* kAttributeNames[kAttributeCount] = {
    "RED",          "GREEN",          "BLUE",           "AMBIENT_RED",   "AMBIENT_GREEN", "AMBIENT_BLUE",
    "SPECULAR_RED", "SPECULAR_GREEN", "SPECULAR_BLUE",  "SHININESS",     "REFLECTIVITY",  "FRESNEL_POWER",
    "FRESNEL_BIAS", "EMISSION_RED",   "EMISSION_GREEN", "EMISSION_BLUE", "MATERIAL_ID"};

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", v);
  return std::string("float(") + text + ")";
}

std::string vector(const glm::dvec3& v) {
  return "vec3(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
}

/// A scene's half spaces, which rays meet without marching, and what else there is.
struct Split {
  std::vector<Expr> planes;  ///< of each its distance, and how that changes along the direction in normal()
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
};

/// With the slope that the shape claims everywhere, or else the one that its formula has near its bounds.
/// Beyond these the formula may be steeper; there the way to the bounds is free.
Result<Read> read(Shape shape) {
  double slope = shape.claim.region.contains(Box::everything()) ? shape.claim.lipschitz : kInfinity;
  if (slope == kInfinity) slope = shape.distance.lipschitz();
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
  shape.distance = hoisted(shape.distance);
  return Read{std::move(shape), slope > 0.0 ? 1.0 / slope : 1.0};
}

class Assembler {
 public:
  Assembler(const Scene& scene, const ShaderOptions& options, Read whole, std::optional<Read> rest,
            std::vector<Expr> planes)
      : scene_(scene),
        options_(options),
        whole_(std::move(whole.shape)),
        inverse_(whole.inverse),
        rest_(std::move(rest)),
        planes_(std::move(planes)) {}

  SceneShaders run() {
    SceneShaders result;
    for (const Part& part : scene_.parts) {
      result.values.label(part.shape.distance, "part '" + part.name + "'");
      for (const Expr& e : part.shape.surface) result.values.label(e, "part '" + part.name + "'");
    }
    result.values.add("sdfDistance", {&whole_.distance, 1});
    if (!planes_.empty()) result.values.add("sdfPlanes", planes_);
    if (rest_) result.values.add("sdfRest", {&rest_->shape.distance, 1});
    if (options_.method == Method::AutoRelaxed && !stepsCount())
      result.cones =
          header() + result.values.source() + defines(false) + parts::kCamera + parts::kRest + parts::kCones;
    result.tiled = !result.cones.empty() && planes_.empty() && options_.view == View::Picture &&
                   topologicalOrder({&whole_.distance, 1}).size() < kLong;
    const std::string body =
        options_.view == View::Picture ? picture(result.values) : debugView(result.values);
    result.picture = header() + (filters_ ? kFootprintVariables : "") + result.values.source() +
                     defines(!result.cones.empty()) + body + (scene_.gamma ? "" : parts::kSrgb) +
                     parts::kPicture;
    return result;
  }

 private:
  bool stepsCount() const { return scene_.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps; }
  bool taps() const { return scene_.ambientOcclusion.kind == AmbientOcclusion::Kind::Taps; }
  bool shadows() const { return scene_.shadow.kind != Shadow::Kind::None && !scene_.lights.empty(); }

  std::string header() const {
    return options_.es
               ? "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
               : "#version 330 core\n";
  }

  bool mirrors() const {
    return scene_.reflectionBounces > 0 &&
           !whole_.surface[static_cast<int>(Attribute::Reflectivity)].isConstant(0.0);
  }

  std::string encoding() const {
    if (!scene_.gamma) return "encode(c)";
    return *scene_.gamma == 1.0 ? "(c)" : "pow(max(c, 0.0), vec3(" + number(1.0 / *scene_.gamma) + "))";
  }

  std::string defines(bool cones) const {
    std::string text;
    const auto define = [&](const std::string& name, const std::string& value) {
      text += "#define " + name + " " + value + "\n";
    };
    const auto count = [&](const std::string& name, const std::string& what) {
      define(name, options_.countReadings ? what : "");
    };
    if (options_.method == Method::Plain || stepsCount()) text += "#define METHOD_PLAIN\n";
    define("INVERSE_SLOPE", number(inverse_));
    define("REST", planes_.empty() ? "sdfDistance(p, vec3(0.0)) * INVERSE_SLOPE"
                   : rest_         ? "sdfRest(p, vec3(0.0)) * " + number(rest_->inverse)
                                   : "1e30");
    define("PLANES", std::to_string(planes_.size()));
    if (restBounds().finite()) {
      define("BOX_MIN", vector(restBounds().min));
      define("BOX_MAX", vector(restBounds().max));
    }
    define("FOOTPRINT", filters_ ? "setFootprint(n, d, ray.before + t);" : "");
    define("LIGHTS", std::to_string(scene_.lights.size()));
    define("TAPS", std::to_string(scene_.ambientOcclusion.count));
    define("BOUNCES", std::to_string(mirrors() ? scene_.reflectionBounces : 0));
    define("OCCLUSION", taps() ? "occlusion(p, n)" : "1.0");
    define("STEP_OCCLUSION", stepsCount() ? "max(0.0, 1.0 - tapStrength * float(readings))" : "1.0");
    define("DIRECT", scene_.lights.empty() ? "vec3(0.0)" : "direct(p, n, d, s)");
    define("SHADE_LIGHT", shadows()
                              ? "if (lightColor[i].w > 0.0) light *= shadow(p, l, lightVector[i].w > 0.0 ? "
                                "min(shadowReach, far) : shadowReach);"
                              : "");
    define("SPAN", cones ? "texelFetch(starts, ivec2(gl_FragCoord.xy) / 4, 0).rb" : "vec2(0.0, 1e30)");
    if (cones) text += "uniform sampler2D starts;\n";
    const bool colours = options_.view == View::Picture || options_.view == View::Material;
    define("ENCODE(c)", colours ? encoding() : "(c)");
    count("COUNT_MARCH", "counted[bounce == 0 ? 0 : 3] += float(readings);");
    count("COUNT_PRIMARY", "counted[0] += float(readings);");
    count("COUNT_SHADOW", "counted[1] += 1.0;");
    count("COUNT_OCCLUSION", "counted[2] += 1.0;");
    count("STORE_COUNTS", "counts = counted / all;");
    if (options_.countReadings) text += "layout(location = 1) out vec4 counts;\nvec4 counted = vec4(0.0);\n";
    define("ATTRIBUTES", std::to_string(kAttributeCount));
    for (int i = 0; i < kAttributeCount; ++i)
      text += std::string("const int ") + kAttributeNames[i] + " = " + std::to_string(i) + ";\n";
    return text;
  }

  std::string marching() const {
    return std::string(parts::kCamera) + parts::kField + parts::kRest +
           (planes_.empty() ? parts::kNoPlanes : parts::kPlanes) + parts::kMarch;
  }

  // Adds the surface's attributes.
  std::string surface(GlslWriter& writer) {
    const Filtered f = filtered(whole_.surface, writer);
    writer.add("sdfSurface", f.outputs);
    filters_ = f.changed;
    return filters_ ? parts::kFootprint : "";
  }

  // Adds what the gradient needs to the writer.
  std::string gradient(GlslWriter& writer) const {
    const Vec3E g = gradientOf(whole_.distance);
    const Expr all[] = {g.x, g.y, g.z};
    if (topologicalOrder(all).size() > kLong) return std::string(parts::kGradientByTaps) + parts::kNormal;
    writer.add("sdfGradient", all);
    return std::string(parts::kGradient) + parts::kNormal;
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
    std::string text = marching() + footprint + gradient(writer) + shadowPart() + occlusionPart();
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
        return start + gradient(writer) + parts::kNormalsView;
      case View::Gradient:
        return start + gradient(writer) + parts::kGradientView;
      case View::Occlusion:
        return start + gradient(writer) + occlusionPart() + parts::kOcclusionView;
      case View::Material:
        return start + surface(writer) + gradient(writer) + parts::kMaterialView;
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
  double inverse_;
  std::optional<Read> rest_;  // if there are planes, and more than planes
  std::vector<Expr> planes_;
  bool filters_ = false;  // known once the surface is written
};

// After the line with the version.
std::string defining(const std::string& name, const std::string& shader) {
  const std::size_t line = shader.find('\n') + 1;
  return shader.substr(0, line) + "#define " + name + "\n" + shader.substr(line);
}

}  // namespace

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
  return Assembler(scene, options, std::move(*whole), std::move(rest), std::move(parts.planes)).run();
}

std::string forManySamples(const std::string& picture) { return defining("MANY_SAMPLES", picture); }

std::string forBackground(const std::string& picture) { return defining("BACKGROUND_ONLY", picture); }

}  // namespace sdf::viewer
