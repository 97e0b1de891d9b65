#include "viewer/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "sdf/scene/relative.h"
#include "viewer/gpu/context.h"
#include "viewer/shaders/error_colors.h"

namespace sdf::viewer {
namespace {

// Spacing of a slice's isolines: a power of ten, some tens of which lie between the eye and what it looks at.
double isolines(const Eye& eye) {
  return std::pow(10.0, std::floor(std::log10(glm::length(eye.to - eye.from) / 10.0)));
}

// The axis that the eye looks along most.
glm::vec3 axisOf(const Eye& eye) {
  const glm::dvec3 way = glm::abs(eye.to - eye.from);
  glm::vec3 axis(0.0f);
  axis[way.x >= way.y && way.x >= way.z ? 0 : way.y >= way.z ? 1 : 2] = 1.0f;
  return axis;
}

// The i-th of so many samples in an order in which the first ones lie all over the pixel: by steps of about
// the golden section.
int scattered(int i, int count) {
  int step = static_cast<int>(0.618 * count);
  while (std::gcd(++step, count) != 1) {
  }
  return static_cast<int>(std::int64_t{i} * step % count);
}

// What alpha says is told apart however it was rounded.
template <class Holds>
std::size_t countAlphas(const Picture& picture, Holds holds) {
  constexpr std::size_t kAlpha = 3, kRgba = 4;
  std::size_t count = 0;
  for (std::size_t i = kAlpha; i < picture.bytes.size(); i += kRgba) count += holds(picture.bytes[i]);
  return count;
}

}  // namespace

std::size_t pixelsOutOfSteps(const Picture& picture) {
  return countAlphas(picture, [](unsigned char alpha) { return alpha < 64; });
}

std::size_t pixelsOutOfShadowSteps(const Picture& picture) {
  return countAlphas(picture, [](unsigned char alpha) { return alpha >= 64 && alpha < 192; });
}

Result<Renderer> Renderer::make(const Scene& scene, const ShaderOptions& options, const Scene* other) {
  const auto start = std::chrono::steady_clock::now();
  if (options.origin != glm::dvec3(0.0)) {  // there numbers that are too large may cancel
    if (const auto sound = checked(scene); !sound) return sound.error();
    if (const Status s = checkNumbers(scene); !s) return s.error();
  }
  ShaderOptions available = options;
  available.doubles = options.doubles && hasDoubles();
  std::shared_ptr<ChangingNumbers> numbers;
  if (other) {
    numbers = std::make_shared<ChangingNumbers>();
    if (assemble(relativeTo(*other, options.origin), available, numbers)) numbers->keep();
  }
  const Scene near = relativeTo(scene, options.origin);
  auto renderer = compiled(near, assemble(near, available, numbers));
  if (!renderer) return renderer;
  if (options.view == View::Split) {
    ShaderOptions picture = options;
    picture.view = View::Picture;
    auto marched = make(scene, picture, other);
    if (!marched) return marched.error();
    renderer->marched_ = std::make_unique<Renderer>(std::move(*marched));
  }
  renderer->compileSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return renderer;
}

Result<Renderer> Renderer::compiled(const Scene& scene, Result<SceneShaders> shaders) {
  if (!shaders) return shaders.error();
  if (shaders->plan.numbers) shaders->plan.numbers->keep();
  Renderer renderer(scene, std::move(*shaders));
  if (auto s = renderer.compile(); !s) return s.error();
  return renderer;
}

Result<bool> Renderer::follow(const Scene& scene) {
  const Scene near = relativeTo(scene, shaders_.plan.options.origin);
  auto shaders = assemble(near, shaders_.plan.options, shaders_.plan.numbers);
  if (!shaders) return shaders.error();
  const bool compiles = !sameCode(*shaders, shaders_);
  if (compiles) {
    auto made = compiled(near, std::move(shaders));
    if (!made) return made.error();
    made->marched_ = std::move(marched_);
    made->compileSeconds_ = compileSeconds_;
    *this = std::move(*made);
  } else {
    if (auto s = volumes_.follow(volumesOf(shaders_), volumesOf(*shaders)); !s) return s.error();
    takeNumbers(near, std::move(*shaders));
  }
  if (!marched_) return compiles;
  const auto marched = marched_->follow(scene);
  return marched ? Result<bool>(compiles || *marched) : marched;
}

void Renderer::takeNumbers(const Scene& scene, SceneShaders shaders) {
  shaders_ = std::move(shaders);
  values_ = UniformValues(shaders_.picture.uniforms);
  rowValues_ = UniformValues(shaders_.rows);
  if (shaders_.background) backgroundValues_ = UniformValues(shaders_.background->uniforms);
  extent_ = Extent(scene);
  if (shaders_.plan.cells) cellValues_.emplace(*shaders_.plan.cells, shaders_.kindRows);
  rowsMoved_ = true;
  if (hits_) hits_->follow(shaders_);
}

Renderer::Renderer(const Scene& scene, SceneShaders shaders)
    : shaders_(std::move(shaders)),
      values_(shaders_.picture.uniforms),
      rowValues_(shaders_.rows),
      extent_(scene),
      shadowSteps_(scene.shadow.steps) {
  if (shaders_.plan.around) around_.emplace(scene);
  if (shaders_.plan.cells) cellValues_.emplace(*shaders_.plan.cells, shaders_.kindRows);
}

Status Renderer::compile() {
  const Plan& plan = shaders_.plan;
  if (!shaders_.hits.empty() || plan.grouped)
    if (auto s = keep(PrimaryHits::make(shaders_, volumes_), hits_); !s) return s;
  const std::string& text = shaders_.picture.text;
  if (auto s = keep(plan.tiled ? Program::overTiles(text) : Program::overScreen(text), picture_); !s)
    return s;
  if (auto s = volumes_.giveTo(*picture_, shaders_.picture.volumes); !s) return s;
  if (!plan.tiled) return okStatus();
  backgroundValues_ = UniformValues(shaders_.background->uniforms);
  return keep(Program::overScreen(shaders_.background->text), background_);
}

// Sets what the parts in use declare, which follows from the plan.
void Renderer::setLook(const Program& program, const Frame& frame, const Shot& shot) const {
  const Look& look = frame.look;
  const Plan& plan = shaders_.plan;
  const ViewLengths& lengths = shot.lengths();
  const View view = plan.options.view;
  if (plan.lights) {
    std::vector<glm::vec4> vectors, colors;
    for (const LookLight& light : look.lights) {
      vectors.emplace_back(light.vector);
      colors.push_back(light.color);
    }
    program.set("lightVector", vectors);
    program.set("lightColor", colors);
  }
  if (isLit(view)) {
    program.set("grain", grain_);
    program.set("ambient", look.ambient);
    program.set("fogColor", look.fogColor);
    program.set("fogDensity", look.fogDensity);
  }
  if (plan.shadow != Shadow::Kind::None) {
    program.set("shadowStart", lengths.shadowStart);
    program.set("shadowReach", lengths.shadowReach);
    program.set("shadowHit", std::min(1e-3 * lengths.unit, 0.5 * lengths.shadowStart));
    program.set("sharpness", look.sharpness);
    program.set("shadowSteps", shadowSteps_);
    if (plan.sized) {
      std::vector<float> sizes;
      for (const LookLight& light : look.lights) sizes.push_back(light.size);
      program.set("lightSize", sizes);
      program.set("lightPlace", shot.lightPlace());
    }
  }
  if (plan.occlusion != AmbientOcclusion::Kind::None) program.set("tapStrength", look.occlusionStrength);
  if (plan.occlusion == AmbientOcclusion::Kind::Taps) program.set("tapSpacing", lengths.tapSpacing);
  if (around_) program.set("backgroundLight", around_->vectors());
  if (plan.filters) program.set("footprint", shot.footprint());
  if (plan.glossy) program.set("lobe", shot.lobe());
  if (plan.lens) {
    program.set("aperture", look.eye.aperture);
    program.set("focus", look.eye.focus.value_or(glm::length(look.eye.to - look.eye.from)));
    program.set("lensPlace", shot.lensPlace());
  }
  if (view == View::Error) {
    std::vector<glm::vec4> colors;
    for (const glm::vec3& color : kErrorColors) colors.emplace_back(color, 1.0f);
    program.set("errorColors", colors);
    program.set("errorLimit", errorLimit_);
  }
  if (view == View::Slice) {
    program.set("slicePoint", glm::vec3(look.eye.to));
    program.set("sliceNormal", axisOf(look.eye));
    program.set("isolines", isolines(look.eye));
  }
}

void Renderer::drawPicture(const Frame& frame, const Shot& shot) const {
  shot.set(*picture_, values_.vectors());
  if (shaders_.picture.takesRows) picture_->set("sdfRows", kRowsUnit);
  setLook(*picture_, frame, shot);
  if (hits_) hits_->giveTo(*picture_, shot);
  if (background_)
    hits_->drawTiles(*picture_, shot);
  else
    picture_->draw();
}

void Renderer::drawBackground(const Shot& shot) const {
  if (!background_) return;
  shot.set(*background_, backgroundValues_->vectors());
  background_->set("grain", grain_);  // tiles are of pictures only
  background_->draw();
}

Status Renderer::clearSums(const Shot& shot) {
  const std::vector layers(shaders_.plan.options.countReadings ? 2 : 1, PixelFormat::Rgba32f);
  if (auto s = ensure(sums_, shot.width(), shot.height(), layers, true); !s) return s;
  for (std::size_t i = 0; i < layers.size(); ++i) sums_->clear(static_cast<int>(i), glm::vec4(0.0f));
  return okStatus();
}

// One after the other, so that one program serves any number of samples, and hit passes do, too. A loop in
// the shader takes up to a fifth less time.
Status Renderer::addSample(const Frame& frame, Shot& shot, int i) {
  shot.chooseSample(i);
  if (hits_)
    if (auto s = hits_->drawSample(shot); !s) return s;
  sums_->clearDepth();
  const DrawingMode sum = sumOfAll();
  const DrawingMode keep = nearestWins();  // the tiles' pixels from the background, which is as far away
  drawPicture(frame, shot);
  drawBackground(shot);
  return okStatus();
}

Status Renderer::resolve(const Shot& shot, const Target& target, double drawn) {
  if (!resolve_)
    if (auto s = keep(Program::overScreen(shaders_.resolve), resolve_); !s) return s;
  target.bind();
  sums_->bindTexture(0);
  resolve_->set("sums", 0);
  resolve_->set("weight", shot.weight());
  resolve_->set("drawn", drawn);
  if (isLit(shaders_.plan.options.view)) resolve_->set("grain", grain_);
  resolve_->draw();
  return okStatus();
}

Status Renderer::showMesh(const ShownMesh& mesh, double limit) {
  errorLimit_ = limit;
  return hits_->showMesh(shaders_.plan.options.view == View::Wire ? unshared(mesh) : mesh);
}

void Renderer::prepare(const Frame& frame) {
  values_.move(frame.parameters);
  rowsMoved_ = rowValues_.move(frame.parameters) || rowsMoved_;
  if (cellValues_) rowsMoved_ = cellValues_->move(frame.parameters) || rowsMoved_;
  if (backgroundValues_) backgroundValues_->move(frame.parameters);
  if (around_) around_->move(frame.parameters);
  if (hits_) hits_->prepare(frame);
  if (marched_) marched_->prepare(frame);
}

Status Renderer::giveRows() {
  if (rowValues_.vectors().empty()) return okStatus();
  if (!rows_) rows_.emplace();
  if (std::exchange(rowsMoved_, false)) {
    std::vector<glm::vec4> all = rowValues_.vectors();
    if (cellValues_) cellValues_->addTo(all);
    if (auto s = rows_->fill(all); !s) return s;
  }
  rows_->bind(kRowsUnit);
  return okStatus();
}

// Where rays start is looked for once, before the first of a picture's pieces.
Status Renderer::begin(const Frame& frame, const Shot& shot, const Target& target, const Rows& rows) {
  prepare(frame);
  samples_ = shot.samples();
  if (auto s = giveRows(); !s) return s;
  volumes_.bind();
  grain_ = target.step();
  return hits_ && rows.first == 0 ? hits_->begin(shot, rowValues_.vectors()) : okStatus();
}

Status Renderer::drawColumns(const Frame& frame, const Target& target, const Rows& rows,
                             const Columns& columns) {
  Shot shot(frame, target.width(), target.height(), extent_);
  if (auto s = begin(frame, shot, target, rows); !s) return s;
  const DrawingMode some = somePixels(rows.first, rows.count, columns.first, columns.count);
  if (samples_ > 1) {
    if (auto s = clearSums(shot); !s) return s;
    for (int i = 0; i < samples_; ++i)
      if (auto s = addSample(frame, shot, i); !s) return s;
    if (auto s = resolve(shot, target, 1.0); !s) return s;
  } else {
    if (hits_)
      if (auto s = hits_->drawSample(shot); !s) return s;
    target.bind();
    drawBackground(shot);
    drawPicture(frame, shot);
  }
  return check("draw the scene");
}

Status Renderer::refineColumns(const Frame& frame, int drawn, const Target& target, const Rows& rows,
                               const Columns& columns) {
  Shot shot(frame, target.width(), target.height(), extent_);
  if (auto s = begin(frame, shot, target, rows); !s) return s;
  const DrawingMode some = somePixels(rows.first, rows.count, columns.first, columns.count);
  if (drawn == 0)
    if (auto s = clearSums(shot); !s) return s;
  if (auto s = addSample(frame, shot, scattered(drawn, samples_)); !s) return s;
  if (auto s = resolve(shot, target, (drawn + 1.0) / samples_); !s) return s;
  return check("refine the scene's picture");
}

}  // namespace sdf::viewer
