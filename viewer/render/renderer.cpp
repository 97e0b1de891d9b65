#include "viewer/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr int kCoarse = 16, kFine = 4;  // sides of the cone pass's tiles, pixels

/// The eye as the shaders want it.
struct Frustum {
  glm::dvec3 right, up, forward;  // forward as long as the picture plane is far away, in picture heights
  double ahead = 0.0;             // of the eye, where rays begin
};

Frustum frustumOf(const Eye& eye) {
  const glm::dvec3 forward = glm::normalize(eye.to - eye.from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, eye.up)), up = glm::cross(right, forward);
  return {eye.mirrored ? -right : right, up, forward / (2.0 * std::tan(0.5 * glm::radians(eye.fov))), 0.0};
}

/// How far rays may start before the eye: up to a ball around the scene.
double aheadOf(const Frustum& f, const Eye& eye, const std::optional<Box>& bounds) {
  if (!bounds) return 0.0;
  const glm::dvec3 toCentre = bounds->centre() - eye.from;
  const double radius = 0.5 * glm::length(bounds->size()), focal = glm::length(f.forward);
  const double along = glm::dot(toCentre, f.forward) / focal - radius;
  // Near the scene there is nothing to gain.
  return along > 4.0 * radius ? along / focal : 0.0;
}

int tiles(int pixels, int side) { return (pixels + side - 1) / side; }

Status ensure(std::optional<Target>& target, int width, int height) {
  if (target && target->width() == width && target->height() == height) return okStatus();
  auto made = Target::create(width, height, {PixelFormat::Rgba32f});
  if (!made) return made.error();
  target = std::move(*made);
  return okStatus();
}

}  // namespace

std::size_t pixelsOutOfSteps(const Picture& picture) {
  constexpr std::size_t kAlpha = 3, kRgba = 4;
  std::size_t count = 0;
  for (std::size_t i = kAlpha; i < picture.bytes.size(); i += kRgba) count += picture.bytes[i] == 0;
  return count;
}

Frame frameOf(const Scene& scene, Parameters parameters) {
  Frame frame;
  frame.look = lookOf(scene, parameters);
  frame.parameters = std::move(parameters);
  return frame;
}

Result<Renderer> Renderer::make(const Scene& scene, const ShaderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  auto shaders = assemble(scene, options);
  if (!shaders) return shaders.error();
  auto single = passes(*shaders, shaders->picture);
  if (!single) return single.error();
  std::optional<Program> cones;
  if (!shaders->cones.empty()) {
    auto made = Program::overScreen(shaders->cones);
    if (!made) return made.error();
    cones = std::move(*made);
  }
  Renderer renderer(scene, std::move(*shaders), std::move(*single), std::move(cones));
  renderer.compileSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return renderer;
}

Result<Renderer::Passes> Renderer::passes(const SceneShaders& shaders, const std::string& picture) {
  auto scene = shaders.tiled ? Program::overTiles(picture) : Program::overScreen(picture);
  if (!scene) return scene.error();
  Passes result{std::move(*scene), {}};
  if (shaders.tiled) {
    auto background = Program::overScreen(forBackground(picture));
    if (!background) return background.error();
    result.background = std::move(*background);
  }
  return result;
}

Renderer::Renderer(const Scene& scene, SceneShaders shaders, Passes single, std::optional<Program> cones)
    : shaders_(std::move(shaders)),
      single_(std::move(single)),
      cones_(std::move(cones)),
      shadow_(scene.shadow),
      tapSpacing_(scene.ambientOcclusion.spacing),
      maxDistance_(scene.maxDistance) {
  const Box bounds = scene.whole().bounds;
  if (bounds.finite() && !bounds.empty()) bounds_ = bounds;
}

void Renderer::setFrame(const Program& program, const Frame& frame, const Target& target) const {
  const Eye& eye = frame.look.eye;
  Frustum f = frustumOf(eye);
  f.ahead = aheadOf(f, eye, bounds_);
  const auto real = [&](const char* name, double v) { program.set(name, static_cast<float>(v)); };
  program.set("size", glm::vec2(target.width(), target.height()));
  program.set("from", glm::vec3(eye.from + f.ahead * f.forward));
  program.set("right", glm::vec3(f.right));
  program.set("up", glm::vec3(f.up));
  program.set("forward", glm::vec3(f.forward));
  real("ahead", f.ahead);
  real("maxDistance", maxDistance_);
  const double pixelRadius = std::tan(0.5 * glm::radians(eye.fov)) / target.height();
  real("pixelRadius", pixelRadius);
  real("footprint", frame.filter ? 2.0 * pixelRadius / frame.samples : 0.0);
  real("epsilon", frame.epsilon);
  real("threshold", frame.threshold);
  program.set("maxSteps", frame.maxSteps);
  if (!values_.empty()) program.set("sdfValues", values_);
}

void Renderer::setLook(const Program& program, const Frame& frame) const {
  const Look& look = frame.look;
  const auto real = [&](const char* name, double v) { program.set(name, static_cast<float>(v)); };
  std::vector<glm::vec4> vectors, colors;
  for (const LookLight& light : look.lights) {
    vectors.push_back(light.vector);
    colors.push_back(light.color);
  }
  if (!vectors.empty()) {
    program.set("lightVector", vectors);
    program.set("lightColor", colors);
  }
  program.set("ambient", look.ambient);
  program.set("fogColor", look.fogColor);
  real("fogDensity", look.fogDensity);
  real("shadowStart", shadow_.start);
  real("shadowReach", shadow_.reach);
  real("shadowHit", std::min(1e-3, 0.5 * shadow_.start));
  real("sharpness", look.sharpness);
  program.set("shadowSteps", shadow_.steps);
  real("tapSpacing", tapSpacing_);
  real("tapStrength", look.occlusionStrength);
  real("samples", frame.samples);
  // The slice lies across the axis that the eye looks along most.
  const glm::dvec3 way = glm::abs(look.eye.to - look.eye.from);
  const int axis = way.x >= way.y && way.x >= way.z ? 0 : way.y >= way.z ? 1 : 2;
  glm::vec3 normal(0.0f);
  normal[axis] = 1.0f;
  program.set("slicePoint", glm::vec3(look.eye.to));
  program.set("sliceNormal", normal);
  real("isolines", std::pow(10.0, std::floor(std::log10(glm::length(look.eye.to - look.eye.from) / 10.0))));
}

Status Renderer::drawCones(const Frame& frame, const Target& target) {
  for (const auto& [level, side] : {std::pair(&coarse_, kCoarse), std::pair(&fine_, kFine)})
    if (auto s = ensure(*level, tiles(target.width(), side), tiles(target.height(), side)); !s) return s;
  setFrame(*cones_, frame, target);
  cones_->set("coarser", 0);
  for (const auto& [level, side] : {std::pair(&*coarse_, kCoarse), std::pair(&*fine_, kFine)}) {
    level->bind();
    coarse_->bindTexture(0);
    cones_->set("first", side == kCoarse ? 1 : 0);
    cones_->set("tile", static_cast<float>(side));
    cones_->draw();
  }
  return okStatus();
}

// Of the coarse level: more, smaller tiles cost more than they spare.
void Renderer::drawTiles(const Program& scene, const Target& target) const {
  coarse_->bindTexture(1);
  scene.set("tiles", 1);
  scene.set("tileSide", static_cast<float>(kCoarse));
  scene.set("tileArea", glm::vec2(target.width(), target.height()));
  scene.set("tileLimit", static_cast<float>(maxDistance_));
  scene.drawTiles(coarse_->width() * coarse_->height());
}

Status Renderer::draw(const Frame& frame, const Target& target) {
  values_.clear();
  const std::vector<float> values = shaders_.values.uniformValues(frame.parameters);
  for (std::size_t i = 0; i < values.size(); i += 4)
    values_.emplace_back(values[i], values[i + 1], values[i + 2], values[i + 3]);
  if (cones_)
    if (auto s = drawCones(frame, target); !s) return s;
  if (frame.samples > 1 && !many_) {
    auto made = passes(shaders_, forManySamples(shaders_.picture));
    if (!made) return made.error();
    many_ = std::move(*made);
  }
  const Passes& passes = frame.samples > 1 ? *many_ : single_;
  target.bind();
  if (passes.background) {
    setFrame(*passes.background, frame, target);
    setLook(*passes.background, frame);
    passes.background->draw();
  }
  setFrame(passes.scene, frame, target);
  setLook(passes.scene, frame);
  if (cones_) {
    fine_->bindTexture(0);
    passes.scene.set("starts", 0);
  }
  if (passes.background)
    drawTiles(passes.scene, target);
  else
    passes.scene.draw();
  return check("draw the scene");
}

Result<Readings> Renderer::readings(const Target& target) const {
  const auto sumOf = [](const std::vector<glm::vec4>& pixels) {
    glm::dvec4 sum(0.0);
    for (const glm::vec4& p : pixels) sum += glm::dvec4(p);
    return sum;
  };
  auto counts = target.pixels(1);
  if (!counts) return counts.error();
  const double pixels = static_cast<double>(counts->size());
  glm::dvec4 sum = sumOf(*counts);
  if (cones_)
    for (const auto* level : {&*coarse_, &*fine_}) {
      auto starts = level->pixels();
      if (!starts) return starts.error();
      sum.x += sumOf(*starts).y;
    }
  sum /= pixels;
  return Readings{sum.x, sum.y, sum.z, sum.w};
}

}  // namespace sdf::viewer
