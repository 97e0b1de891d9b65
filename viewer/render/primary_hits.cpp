#include "viewer/render/primary_hits.h"

#include <cmath>
#include <iterator>
#include <utility>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr int kTile = 16;       // side of the larger tiles, pixels: smaller ones cost more than they spare
constexpr int kFine = 4;        // side of the smaller tiles
constexpr int kStartsUnit = 7;  // the texture unit of a tile's starts, beyond those that the programs read

const glm::vec4 kNoStart(1e30f, 0.0f, -1e30f, 1e30f);

/// How many tiles of this side cover so many pixels.
int tiles(int pixels, int side) { return (pixels + side - 1) / side; }

/// A layer that keeps hits, by the name of the output and the sampler in the parts.
struct Layer {
  const char* name;
  PixelFormat format;
  glm::vec4 nothing;  ///< what it holds where there is no hit
};

constexpr Layer kLayers[] = {
    {"hitSurface", PixelFormat::Rgba32f, glm::vec4(0.0f, 0.0f, 0.0f, 1e30f)},
    {"hitIdentity", PixelFormat::Rg32f, glm::vec4(0.0f)},
};
constexpr int kCounts = std::size(kLayers);  // the number of the layer of readings

// How drawn triangles look, in layers after these; the last one is of a mesh that is shown as a whole.
constexpr const char* kLooks[] = {"hitLook", "hitGlow", "hitMark"};
constexpr int kMark = 2, kMaterialsUnit = kCounts + static_cast<int>(std::size(kLooks));

}  // namespace

Result<PrimaryHits> PrimaryHits::make(const SceneShaders& shaders, Volumes& volumes) {
  PrimaryHits made;
  made.counted_ = shaders.plan.options.countReadings;
  if (shaders.boxCones)
    if (auto s = keep(Program::overScreen(shaders.boxCones->text), made.boxCones_); !s) return s.error();
  for (const HitShaders& shader : shaders.hits) {
    Pass pass;
    if (!shader.cones.empty())
      if (auto s = keep(Program::overScreen(shader.cones), pass.cones); !s) return s.error();
    const bool started = pass.cones || !shader.boxes.empty();
    const auto drawn = started ? Program::overTiles : Program::overScreen;
    if (!shader.hits.empty())
      if (auto s = keep(drawn(shader.hits), pass.hits); !s) return s.error();
    for (const auto* program : {&pass.cones, &pass.hits})
      if (*program)
        if (auto s = volumes.giveTo(**program, shader.volumes); !s) return s.error();
    made.passes_.push_back(std::move(pass));
  }
  if (!shaders.triangles.empty())
    if (auto s = keep(DrawnMeshes::make(shaders), made.meshes_); !s) return s.error();
  if (shaders.plan.hull)
    if (auto s = keep(HullStarts::make(shaders), made.hull_); !s) return s.error();
  made.looks_ = shaders.plan.looks;
  made.meshed_ = shaders.plan.meshed;
  made.grouped_ = shaders.plan.grouped;
  made.takeNumbers(shaders);
  return made;
}

void PrimaryHits::takeNumbers(const SceneShaders& shaders) {
  cells_ = 0;
  for (std::size_t i = 0; i < passes_.size(); ++i) {
    const HitShaders& shader = shaders.hits[i];
    Pass& pass = passes_[i];
    pass.values = UniformValues(shader.uniforms);
    pass.takesRows = shader.takesRows;
    pass.rows = shader.rows;
    pass.boxes = shader.boxes;
    const bool started = pass.cones || !pass.boxes.empty();
    pass.firstCell = started ? std::exchange(cells_, cells_ + pass.draws()) : -1;
  }
  columns_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cells_))));
  if (shaders.boxCones) boxValues_ = UniformValues(shaders.boxCones->uniforms);
}

void PrimaryHits::follow(const SceneShaders& shaders) {
  takeNumbers(shaders);
  if (meshes_) meshes_->place(shaders.plan.drawn);
  if (hull_) hull_->enclose(shaders.plan);
}

glm::ivec2 PrimaryHits::cornerOf(int cell, const Shot& shot) const {
  return glm::ivec2(cell % columns_ * tiles(shot.width(), kTile),
                    cell / columns_ * tiles(shot.height(), kTile));
}

int PrimaryHits::fineSide() const { return hull_ ? 1 : kFine; }

int PrimaryHits::firstLook() const { return kCounts + (counted_ ? 1 : 0); }

Status PrimaryHits::makeTargets(const Shot& shot) {
  const auto starts = [&](std::optional<Target>& target, int columns, int rows, int side) {
    return ensure(target, columns * tiles(shot.width(), side), rows * tiles(shot.height(), side),
                  {PixelFormat::Rgba32f});
  };
  if (cells_ > 0)
    if (auto s = starts(coarse_, columns_, (cells_ + columns_ - 1) / columns_, kTile); !s) return s;
  if (isFine())
    if (auto s = starts(fine_, 1, 1, fineSide()); !s) return s;
  if (!grouped_) return okStatus();
  std::vector<PixelFormat> formats;
  for (const Layer& layer : kLayers) formats.push_back(layer.format);
  if (counted_) formats.push_back(PixelFormat::Rgba32f);
  if (meshes_) formats.resize(formats.size() + kMark + (meshed_ ? 1 : 0), PixelFormat::Rgba32f);
  return ensure(hits_, shot.width(), shot.height(), formats, true);
}

void PrimaryHits::drawStarts(const Shot& shot) const {
  if (cells_ > 0) coarse_->clear(0, kNoStart);
  for (const Pass& pass : passes_) {
    if (pass.firstCell < 0) continue;
    const bool byBoxes = !pass.boxes.empty();
    const Program& cones = byBoxes ? *boxCones_ : *pass.cones;
    shot.set(cones, (byBoxes ? boxValues_ : pass.values).vectors());
    cones.set("coarser", 0);
    cones.set("first", 1);
    cones.set("tile", static_cast<double>(kTile));
    for (int i = 0; i < pass.draws(); ++i) {
      const glm::ivec2 corner = cornerOf(pass.firstCell + i, shot);
      coarse_->bind(corner.x, corner.y, tiles(shot.width(), kTile), tiles(shot.height(), kTile));
      if (byBoxes) {
        const Box& box = pass.boxes[static_cast<std::size_t>(i)];
        cones.set("boxMiddle", glm::vec3(box.centre()));
        cones.set("boxHalf", glm::vec3(0.5 * box.size()));
      } else {
        chooseRow(pass, cones, i);
      }
      cones.set("corner", glm::vec2(corner));
      cones.draw();
    }
  }
  if (!isFine() || hull_) return;
  const Program& cones = *passes_.front().cones;
  fine_->clear(0, kNoStart);
  coarse_->bindTexture(0);
  cones.set("first", 0);
  cones.set("tile", static_cast<double>(kFine));
  cones.draw();
}

void PrimaryHits::chooseRow(const Pass& pass, const Program& program, int i) const {
  if (pass.takesRows) program.set("sdfRows", kRowsUnit);
  if (pass.rows.count == 0) return;
  const auto& [count, first, stride] = pass.rows;
  program.set("sdfRow", rows_.subspan(first + static_cast<std::size_t>(i) * stride, stride));
}

void PrimaryHits::giveStarts(const Program& program, int cell, const Shot& shot) const {
  (isFine() ? fine_ : coarse_)->bindTexture(0);
  program.set("starts", 0);
  program.set("tile", static_cast<double>(isFine() ? fineSide() : kTile));
  program.set("corner", glm::vec2(cornerOf(cell, shot)));
}

void PrimaryHits::giveTo(const Program& picture, const Shot& shot) const {
  if (!grouped_) return giveStarts(picture, 0, shot);
  for (int i = 0; i < kCounts; ++i) {
    hits_->bindTexture(i, i);
    picture.set(kLayers[i].name, i);
  }
  for (int i = looks_ ? 0 : kMark; i < kMark + (meshed_ ? 1 : 0); ++i) {
    const int unit = kCounts + i;
    hits_->bindTexture(unit, firstLook() + i);
    picture.set(kLooks[i], unit);
  }
  if (looks_ && meshed_) meshes_->giveMaterials(picture, kMaterialsUnit);
}

void PrimaryHits::drawTiles(const Program& program, const Shot& shot, std::optional<int> cell) const {
  coarse_->bindTexture(kStartsUnit);
  program.set("tiles", kStartsUnit);
  program.set("tileLimit", shot.lengths().maxDistance);
  program.set("firstCell", cell.value_or(0));
  program.set("lastCell", cell.value_or(cells_ - 1));
  program.drawTiles(tiles(shot.width(), kTile), tiles(shot.height(), kTile), kTile);
}

void PrimaryHits::drawHits(const Shot& shot) const {
  for (const Pass& pass : passes_) {
    const Program& hits = *pass.hits;
    shot.set(hits, pass.values.vectors());
    for (int i = 0; i < pass.draws(); ++i) {
      chooseRow(pass, hits, i);
      if (pass.firstCell < 0) {
        hits.draw();
      } else {
        giveStarts(hits, pass.firstCell + i, shot);
        drawTiles(hits, shot, pass.firstCell + i);
      }
    }
  }
}

void PrimaryHits::prepare(const Frame& frame) {
  for (Pass& pass : passes_) pass.values.move(frame.parameters);
  boxValues_.move(frame.parameters);
  if (meshes_) meshes_->prepare(frame);
  if (hull_) hull_->prepare(frame);
}

Status PrimaryHits::begin(const Shot& shot, std::span<const glm::vec4> rows) {
  rows_ = rows;
  if (auto s = makeTargets(shot); !s) return s;
  drawStarts(shot);
  readings_ = 0.0;
  return check("draw where rays start");
}

Status PrimaryHits::drawSample(const Shot& shot) {
  if (hull_)
    if (auto s = hull_->draw(shot, *fine_, kNoStart); !s) return s;
  if (!grouped_) return okStatus();
  for (int i = 0; i < kCounts; ++i) hits_->clear(i, kLayers[i].nothing);
  hits_->clearDepth();
  {
    const DrawingMode nearest = nearestWins();
    if (meshes_) meshes_->draw(shot);
    const DrawingMode hits = firstLayers(kCounts);
    drawHits(shot);
  }
  if (counted_) {
    hits_->clear(kCounts, glm::vec4(0.0f));
    {
      const DrawingMode counts = oneLayer(kCounts), sum = sumOfAll();
      drawHits(shot);
    }
    const auto readings = hits_->sum(kCounts);
    if (!readings) return readings.error();
    readings_ += readings->x;
  }
  return check("draw what the rays hit");
}

Result<double> PrimaryHits::coneReadings() const {
  double readings = 0.0;
  for (const auto* level : {&coarse_, &fine_}) {
    if (!*level) continue;
    const auto sum = (*level)->sum(0);
    if (!sum) return sum.error();
    readings += sum->y;
  }
  return readings;
}

}  // namespace sdf::viewer
