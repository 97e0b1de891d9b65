#include "viewer/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/gpu/context.h"
#include "viewer/gpu/drawing.h"
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
  const auto start = std::chrono::steady_clock::now();
  auto shaders = assemble(scene, options);
  if (!shaders) return shaders.error();
  Renderer renderer(scene, std::move(*shaders));
  if (auto s = renderer.compile(); !s) return s.error();
  renderer.compileSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return renderer;
}

Renderer::Renderer(const Scene& scene, SceneShaders shaders)
    : shaders_(std::move(shaders)),
      extent_(scene),
      shadow_(scene.shadow),
      tapSpacing_(scene.ambientOcclusion.spacing) {}

Status Renderer::compile() {
  if (!shaders_.groups.empty()) {
    auto groups = Groups::make(shaders_.groups, shaders_.counted);
    if (!groups) return groups.error();
    groups_ = std::move(*groups);
  }
  if (!shaders_.cones.empty()) {
    auto cones = Program::overScreen(shaders_.cones);
    if (!cones) return cones.error();
    cones_ = std::move(*cones);
  }
  auto scene = shaders_.tiled ? Program::overTiles(shaders_.picture) : Program::overScreen(shaders_.picture);
  if (!scene) return scene.error();
  scene_ = std::move(*scene);
  if (!shaders_.tiled) return okStatus();
  auto background = Program::overScreen(forBackground(shaders_.picture));
  if (!background) return background.error();
  background_ = std::move(*background);
  return okStatus();
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

void Renderer::drawScene(const Frame& frame, const Shot& shot) const {
  shot.set(*scene_, values_);
  setLook(*scene_, frame);
  if (groups_) {
    groups_->hits().bindTexture(0);
    scene_->set("hits", 0);
  } else if (cones_) {
    fine_->bindTexture(0);
    scene_->set("starts", 0);
  }
  if (!background_)
    scene_->draw();
  else
    drawTiles(*scene_, shot, groups_ ? Cells{groups_->starts(), 0, groups_->count() - 1} : Cells{*coarse_});
}

void Renderer::drawBackground(const Frame& frame, const Shot& shot) const {
  if (!background_) return;
  shot.set(*background_, values_);
  setLook(*background_, frame);
  background_->draw();
}

// One after the other, so that one program serves any number of samples, and groups do, too. A loop in the
// shader takes up to a fifth less time.
Status Renderer::drawSamples(const Frame& frame, Shot& shot, const Target& target) {
  if (!resolve_) {
    auto resolve = Program::overScreen(shaders_.resolve);
    if (!resolve) return resolve.error();
    resolve_ = std::move(*resolve);
  }
  const std::vector layers(shaders_.counted ? 2 : 1, PixelFormat::Rgba32f);
  if (auto s = ensure(sums_, shot.width(), shot.height(), layers, true); !s) return s;
  for (std::size_t i = 0; i < layers.size(); ++i) sums_->clear(static_cast<int>(i), glm::vec4(0.0f));
  for (int i = 0; i < shot.samples(); ++i) {
    shot.chooseSample(i);
    if (groups_)
      if (auto s = groups_->drawSample(shot); !s) return s;
    sums_->clearDepth();
    const SumOfAll sum;
    const NearestWins keep;  // the tiles' pixels from the background, which is as far away
    drawScene(frame, shot);
    drawBackground(frame, shot);
  }
  target.bind();
  sums_->bindTexture(0);
  resolve_->set("sums", 0);
  resolve_->set("weight", static_cast<float>(shot.weight()));
  resolve_->draw();
  return okStatus();
}

Status Renderer::drawSample(const Frame& frame, const Shot& shot, const Target& target) {
  if (groups_)
    if (auto s = groups_->drawSample(shot); !s) return s;
  target.bind();
  drawBackground(frame, shot);
  drawScene(frame, shot);
  return okStatus();
}

Status Renderer::draw(const Frame& frame, const Target& target) {
  values_ = uniformsOf(shaders_.values, frame.parameters);
  Shot shot(frame, target.width(), target.height(), extent_);
  samples_ = shot.samples();
  if (groups_ || cones_)
    if (auto s = groups_ ? groups_->begin(frame, shot) : drawCones(shot); !s) return s;
  if (auto s = samples_ > 1 ? drawSamples(frame, shot, target) : drawSample(frame, shot, target); !s)
    return s;
  return check("draw the scene");
}

Result<double> Renderer::coneReadings() const {
  if (groups_) return groups_->coneReadings();
  if (!cones_) return 0.0;
  const auto coarse = coarse_->sum(0), fine = fine_->sum(0);
  for (const auto* sum : {&coarse, &fine})
    if (!*sum) return sum->error();
  return coarse->y + fine->y;
}

Result<Readings> Renderer::readings(const Target& target) const {
  const auto counts = (samples_ > 1 ? *sums_ : target).sum(1);
  const auto cones = coneReadings();
  if (!counts) return counts.error();
  if (!cones) return cones.error();
  const double primary = counts->x + (groups_ ? groups_->readings() : 0.0) + *cones / samples_;
  const double pixels = static_cast<double>(target.width()) * target.height();
  return Readings{primary / pixels, counts->y / pixels, counts->z / pixels, counts->w / pixels};
}

}  // namespace sdf::viewer
