// The legend of the colours of errors, with their histogram.
#pragma once
#include "viewer/gpu/picture.h"
#include "viewer/render/mesh_errors.h"

namespace sdf::viewer {

/// Draws the legend with its letters so many times as large as they are in a window: 4 channels, the alpha
/// straight.
Picture legendOf(const ErrorFigures& figures, int scale);

/// Lays the legend over a picture, RGB or RGBA, at its lower right, as large as suits the picture's height.
/// One that is too small for it stays as it is.
void drawLegend(const ErrorFigures& figures, Picture& picture);

}  // namespace sdf::viewer
