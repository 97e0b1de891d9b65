// SVG drawings as outlines.
#pragma once
#include <filesystem>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// What a drawing fills and strokes: outlines for each path, rect, circle, ellipse, line, polygon and
/// polyline that has a fill or a stroke, in the drawing's units with y up (W3C, Scalable Vector Graphics 1.1,
/// 2011). Groups, transforms, `use`, and styles of attributes, of `style` and of a style sheet's classes are
/// followed. Where a transform stretches, strokes are as wide as would have their area, and dashes as long.
/// Text and pictures draw nothing, nor do clips and masks take away.
///
/// Errors: Files (no file, no XML, with the line); Scene (numbers or paths that are none, nothing that is
/// filled or stroked, nested too deep); Limits (more than 20 MB, or than kMostCurves curves in all).
Result<std::vector<Outline>> svgOutlines(const std::filesystem::path& file);

}  // namespace sdf
