#include "viewer/render/tiles.h"

namespace sdf::viewer {
namespace {

constexpr int kStartsUnit = 7;  // beyond those of what the programs themselves read

}  // namespace

Status ensure(std::optional<Target>& target, int width, int height, const std::vector<PixelFormat>& layers,
              bool depth) {
  if (target && target->width() == width && target->height() == height) return okStatus();
  auto made = Target::create(width, height, layers, depth);
  if (!made) return made.error();
  target = std::move(*made);
  return okStatus();
}

void drawTiles(const Program& program, const Shot& shot, const Cells& cells) {
  cells.starts.bindTexture(kStartsUnit);
  program.set("tiles", kStartsUnit);
  program.set("tileLimit", static_cast<float>(shot.maxDistance()));
  program.set("firstCell", cells.first);
  program.set("lastCell", cells.last);
  program.drawTiles(tiles(shot.width(), kTile), tiles(shot.height(), kTile), kTile);
}

}  // namespace sdf::viewer
