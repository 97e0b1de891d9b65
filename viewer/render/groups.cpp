#include "viewer/render/groups.h"

#include <cmath>

#include "viewer/gpu/context.h"
#include "viewer/gpu/drawing.h"
#include "viewer/render/tiles.h"

namespace sdf::viewer {

Result<Groups> Groups::make(const std::vector<GroupShaders>& shaders, bool counted) {
  std::vector<Passes> passes;
  std::vector<Group> groups;
  for (const GroupShaders& kind : shaders) {
    auto cones = Program::overScreen(kind.cones);
    if (!cones) return cones.error();
    auto hits = Program::overTiles(kind.hits);
    if (!hits) return hits.error();
    for (const GlslWriter& values : kind.values) groups.push_back({values, passes.size()});
    passes.push_back({std::move(*cones), std::move(*hits)});
  }
  return Groups(std::move(passes), std::move(groups), counted);
}

Groups::Groups(std::vector<Passes> passes, std::vector<Group> groups, bool counted)
    : passes_(std::move(passes)),
      groups_(std::move(groups)),
      counted_(counted),
      columns_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(groups_.size()))))) {}

glm::ivec2 Groups::cornerOf(int group, const Shot& shot) const {
  return glm::ivec2(group % columns_ * tiles(shot.width(), kTile),
                    group / columns_ * tiles(shot.height(), kTile));
}

void Groups::drawStarts(const Shot& shot) const {
  starts_->clear(0, glm::vec4(0.0f));
  for (int i = 0; i < count(); ++i) {
    const Program& cones = passes_[groups_[std::size_t(i)].passes].cones;
    const glm::ivec2 corner = cornerOf(i, shot);
    starts_->bind(corner.x, corner.y, tiles(shot.width(), kTile), tiles(shot.height(), kTile));
    shot.set(cones, values_[std::size_t(i)]);
    cones.set("first", 1);
    cones.set("tile", static_cast<float>(kTile));
    cones.set("corner", glm::vec2(corner));
    cones.draw();
  }
}

void Groups::drawHits(const Shot& shot) const {
  for (int i = 0; i < count(); ++i) {
    const Program& hits = passes_[groups_[std::size_t(i)].passes].hits;
    shot.set(hits, values_[std::size_t(i)]);
    starts_->bindTexture(0);
    hits.set("starts", 0);
    hits.set("tile", static_cast<float>(kTile));
    hits.set("corner", glm::vec2(cornerOf(i, shot)));
    drawTiles(hits, shot, {*starts_, i, i});
  }
}

Status Groups::begin(const Frame& frame, const Shot& shot) {
  const int rows = (count() + columns_ - 1) / columns_;
  const std::vector layers(counted_ ? 2 : 1, PixelFormat::Rgba32f);
  if (auto s = ensure(starts_, columns_ * tiles(shot.width(), kTile), rows * tiles(shot.height(), kTile),
                      {PixelFormat::Rgba32f});
      !s)
    return s;
  if (auto s = ensure(hits_, shot.width(), shot.height(), layers, true); !s) return s;
  values_.clear();
  for (const Group& group : groups_) values_.push_back(uniformsOf(group.values, frame.parameters));
  drawStarts(shot);
  readings_ = 0.0;
  return check("draw the groups of a union");
}

Status Groups::drawSample(const Shot& shot) {
  hits_->clear(0, glm::vec4(0.0f, 0.0f, 0.0f, 1e30f));
  hits_->clearDepth();
  {
    const NearestWins nearest;
    drawHits(shot);
  }
  if (counted_) {
    hits_->clear(1, glm::vec4(0.0f));
    {
      const OneLayer counts(1);
      const SumOfAll sum;
      drawHits(shot);
    }
    const auto readings = hits_->sum(1);
    if (!readings) return readings.error();
    readings_ += readings->x;
  }
  return check("draw the groups of a union");
}

Result<double> Groups::coneReadings() const {
  const auto cones = starts_->sum(0);
  if (!cones) return cones.error();
  return cones->y;
}

}  // namespace sdf::viewer
