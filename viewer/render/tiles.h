// The picture in square tiles, each with a distance from which its rays may start.
#pragma once
#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/frame.h"

namespace sdf::viewer {

/// The side of the larger tiles, pixels: smaller ones cost more than they spare.
inline constexpr int kTile = 16;

/// Returns how many tiles of this side cover so many pixels.
inline int tiles(int pixels, int side) { return (pixels + side - 1) / side; }

/// Makes a target of this size and these layers, if it is not one already. Errors: as Target::create.
Status ensure(std::optional<Target>& target, int width, int height, const std::vector<PixelFormat>& layers,
              bool depth = false);

/// Cells are some of those of a texture of starts; see Program::overTiles.
struct Cells {
  const Target& starts;
  int first = 0, last = 0;
};

/// Draws the tiles of side kTile whose starts, in one of these cells, say that there is something to see. The
/// program is one that Program::overTiles made; texture unit 7 is taken for the starts.
void drawTiles(const Program& program, const Shot& shot, const Cells& cells);

}  // namespace sdf::viewer
