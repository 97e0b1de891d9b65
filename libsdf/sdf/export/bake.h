// Light that a glTF reader cannot compute, put into the file.
#pragma once
#include <optional>
#include <span>

#include "sdf/base/progress.h"
#include "sdf/export/export.h"

namespace sdf {

/// Fills ExportPart::ambient: the scene's ambient light, that of its background included, and the share of it
/// that ambient occlusion by taps leaves at each vertex. Occlusion is read from the field of all parts, as
/// sdfview does (march/ambient_occlusion.h, TapWeights::Relative, the lengths of scene/fit.h). Parts that
/// leave `clip` were cut there as they were meshed, and so is that field. Occlusion by steps depends on the
/// camera, and is left out. Runs on the calling thread's oneTBB arena; the result does not depend on the
/// number of threads. Errors: Scene (occlusion by a distance whose slope is not known), Interrupted. Cost:
/// the taps' readings of the whole scene at each vertex.
Status bakeAmbient(const Scene& scene, const std::optional<Box>& clip, std::span<ExportPart> parts,
                   Progress& progress);

}  // namespace sdf
