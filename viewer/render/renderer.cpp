#include "viewer/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/gpu/context.h"
#include "viewer/render/tiles.h"

namespace sdf::viewer {
namespace {

constexpr int kFine = 4;  // side of the cone pass's smaller tiles, pixels

}  // namespace

std::size_t pixelsOutOfSteps(const Picture& picture) {
  constexpr std::size_t kAlpha = 3, kRgba = 4;
  std::size_t count = 0;
  for (std::size_t i = kAlpha; i < picture.bytes.size(); i += kRgba) count += picture.bytes[i] == 0;
  return count;
}

Result<Renderer> Renderer::make(const Scene& scene, const ShaderOptions& options) {
  auto shaders = assemble(scene, options);
  if (!shaders) return shaders.error();
  Renderer renderer(scene, std::move(*shaders));
  if (auto s = renderer.compile(false); !s) return s.error();
  return renderer;
}

Renderer::Renderer(const Scene& scene, SceneShaders shaders)
    : shaders_(std::move(shaders)),
      shadow_(scene.shadow),
      tapSpacing_(scene.ambientOcclusion.spacing),
      maxDistance_(scene.maxDistance) {
  const Box bounds = scene.whole().bounds;
  if (bounds.finite() && !bounds.empty()) bounds_ = bounds;
}

Status Renderer::compile(bool manySamples) {
  const auto start = std::chrono::steady_clock::now();
  const bool grouped = !manySamples && !shaders_.groups.empty();
  if (grouped) {
    auto groups = Groups::make(shaders_.groups, shaders_.counted);
    if (!groups) return groups.error();
    groups_ = std::move(*groups);
  } else if (!cones_ && !shaders_.cones.empty()) {
    auto cones = Program::overScreen(shaders_.cones);
    if (!cones) return cones.error();
    cones_ = std::move(*cones);
  }
  const std::string& picture = shaders_.picture;
  auto made = passes(shaders_, manySamples ? forManySamples(picture) : grouped ? shaders_.fromHits : picture);
  if (!made) return made.error();
  (manySamples ? many_ : single_) = std::move(*made);
  compileSeconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return okStatus();
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

Status Renderer::drawCones(const Shot& shot) {
  for (const auto& [level, side] : {std::pair(&coarse_, kTile), std::pair(&fine_, kFine)})
    if (auto s =
            ensure(*level, tiles(shot.width(), side), tiles(shot.height(), side), {PixelFormat::Rgba32f});
        !s)
      return s;
  shot.set(*cones_, values_);
  cones_->set("coarser", 0);
  for (const auto& [level, side] : {std::pair(&*coarse_, kTile), std::pair(&*fine_, kFine)}) {
    level->bind();
    coarse_->bindTexture(0);
    cones_->set("first", side == kTile ? 1 : 0);
    cones_->set("tile", static_cast<float>(side));
    cones_->draw();
  }
  return okStatus();
}

Status Renderer::drawScene(const Passes& passes, const Frame& frame, const Shot& shot,
                           const Target& target) const {
  target.bind();
  if (passes.background) {
    shot.set(*passes.background, values_);
    setLook(*passes.background, frame);
    passes.background->draw();
  }
  shot.set(passes.scene, values_);
  setLook(passes.scene, frame);
  if (grouped_) {
    groups_->hits().bindTexture(0);
    passes.scene.set("hits", 0);
  } else if (cones_) {
    fine_->bindTexture(0);
    passes.scene.set("starts", 0);
  }
  if (!passes.background)
    passes.scene.draw();
  else if (grouped_)
    drawTiles(passes.scene, shot, groups_->starts(), 0, groups_->count() - 1);
  else
    drawTiles(passes.scene, shot, *coarse_, 0, 0);
  return check("draw the scene");
}

Status Renderer::draw(const Frame& frame, const Target& target) {
  const bool many = frame.samples > 1;
  if (many && !many_)
    if (auto s = compile(many); !s) return s;
  const Shot shot(frame, target.width(), target.height(), bounds_, maxDistance_);
  grouped_ = groups_ && !many;
  values_ = uniformsOf(grouped_ ? shaders_.valuesFromHits : shaders_.values, frame.parameters);
  if (grouped_ || cones_)
    if (auto s = grouped_ ? groups_->draw(frame, shot) : drawCones(shot); !s) return s;
  return drawScene(many ? *many_ : *single_, frame, shot, target);
}

Result<Readings> Renderer::readings(const Target& target) const {
  auto counts = target.sum(1);
  if (!counts) return counts.error();
  glm::dvec4 sum = *counts;
  if (grouped_) {
    const auto primary = groups_->readings();
    if (!primary) return primary.error();
    sum.x += *primary;
  } else if (cones_) {
    for (const auto* level : {&*coarse_, &*fine_}) {
      const auto starts = level->sum(0);
      if (!starts) return starts.error();
      sum.x += starts->y;
    }
  }
  sum /= static_cast<double>(target.width()) * target.height();
  return Readings{sum.x, sum.y, sum.z, sum.w};
}

}  // namespace sdf::viewer
