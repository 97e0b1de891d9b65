#include "viewer/render/primary_hits.h"

#include <cmath>

#include "viewer/gpu/context.h"
#include "viewer/gpu/drawing.h"

namespace sdf::viewer {
namespace {

constexpr int kFine = 4;  // side of the smaller tiles, pixels

}  // namespace

Result<PrimaryHits> PrimaryHits::make(const std::vector<HitShaders>& shaders, bool counted) {
  std::vector<Pass> passes;
  std::vector<Draw> draws;
  int cells = 0;
  for (const HitShaders& shader : shaders) {
    Pass pass;
    if (!shader.cones.empty()) {
      auto cones = Program::overScreen(shader.cones);
      if (!cones) return cones.error();
      pass.cones = std::move(*cones);
    }
    if (!shader.hits.empty()) {
      auto hits = pass.cones ? Program::overTiles(shader.hits) : Program::overScreen(shader.hits);
      if (!hits) return hits.error();
      pass.hits = std::move(*hits);
    }
    for (const Function& uniforms : shader.uniforms)
      draws.push_back({passes.size(), UniformValues(uniforms), pass.cones ? cells++ : -1});
    passes.push_back(std::move(pass));
  }
  return PrimaryHits(std::move(passes), std::move(draws), cells, counted);
}

PrimaryHits::PrimaryHits(std::vector<Pass> passes, std::vector<Draw> draws, int cells, bool counted)
    : passes_(std::move(passes)),
      draws_(std::move(draws)),
      cells_(cells),
      columns_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cells))))),
      counted_(counted) {}

glm::ivec2 PrimaryHits::cornerOf(int cell, const Shot& shot) const {
  return glm::ivec2(cell % columns_ * tiles(shot.width(), kTile),
                    cell / columns_ * tiles(shot.height(), kTile));
}

Status PrimaryHits::makeTargets(const Shot& shot) {
  const auto starts = [&](std::optional<Target>& target, int columns, int rows, int side) {
    return ensure(target, columns * tiles(shot.width(), side), rows * tiles(shot.height(), side),
                  {PixelFormat::Rgba32f});
  };
  if (cells_ > 0)
    if (auto s = starts(coarse_, columns_, (cells_ + columns_ - 1) / columns_, kTile); !s) return s;
  if (isFine())
    if (auto s = starts(fine_, 1, 1, kFine); !s) return s;
  return hasHits() ? target_.resize(shot.width(), shot.height(), counted_) : okStatus();
}

void PrimaryHits::drawStarts(const Shot& shot) const {
  if (cells_ > 1) coarse_->clear(0, glm::vec4(0.0f));
  for (const Draw& draw : draws_) {
    if (draw.cell < 0) continue;
    const Program& cones = *passes_[draw.pass].cones;
    const glm::ivec2 corner = cornerOf(draw.cell, shot);
    coarse_->bind(corner.x, corner.y, tiles(shot.width(), kTile), tiles(shot.height(), kTile));
    shot.set(cones, draw.values.vectors());
    cones.set("coarser", 0);
    cones.set("first", 1);
    cones.set("tile", static_cast<float>(kTile));
    cones.set("corner", glm::vec2(corner));
    cones.draw();
  }
}

void PrimaryHits::drawFineStarts(const Shot&) const {
  const Program& cones = *passes_[draws_.front().pass].cones;
  fine_->bind();
  coarse_->bindTexture(0);
  cones.set("first", 0);
  cones.set("tile", static_cast<float>(kFine));
  cones.draw();
}

void PrimaryHits::giveStarts(const Program& program, int cell, const Shot& shot) const {
  (isFine() ? fine_ : coarse_)->bindTexture(0);
  program.set("starts", 0);
  program.set("tile", static_cast<float>(isFine() ? kFine : kTile));
  program.set("corner", glm::vec2(cornerOf(cell, shot)));
}

void PrimaryHits::giveTo(const Program& picture, const Shot& shot) const {
  if (hasHits())
    target_.giveTo(picture);
  else
    giveStarts(picture, 0, shot);
}

void PrimaryHits::drawHits(const Shot& shot) const {
  for (const Draw& draw : draws_) {
    const Program& hits = *passes_[draw.pass].hits;
    shot.set(hits, draw.values.vectors());
    if (draw.cell < 0) {
      hits.draw();
    } else {
      giveStarts(hits, draw.cell, shot);
      drawTiles(hits, shot, {*coarse_, draw.cell, draw.cell});
    }
  }
}

void PrimaryHits::prepare(const Frame& frame) {
  for (Draw& draw : draws_) draw.values.move(frame.parameters);
}

Status PrimaryHits::begin(const Shot& shot) {
  if (auto s = makeTargets(shot); !s) return s;
  drawStarts(shot);
  if (isFine()) drawFineStarts(shot);
  readings_ = 0.0;
  return check("draw where rays start");
}

Status PrimaryHits::drawSample(const Shot& shot) {
  if (!hasHits()) return okStatus();
  target_.clear();
  {
    const NearestWins nearest;
    drawHits(shot);
  }
  if (counted_) {
    target_.clearCounts();
    {
      const OneLayer counts(HitsTarget::kCounts);
      const SumOfAll sum;
      drawHits(shot);
    }
    const auto readings = target_.readings();
    if (!readings) return readings.error();
    readings_ += *readings;
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
