// What of a scene file is in view of a camera that is fitted to it.
#pragma once
#include <filesystem>

#include "viewer/render/look.h"

namespace sdf::viewer {

/// The look of a scene that was loaded from this file with these values. A camera that it leaves open is
/// fitted to the scene as it is at time 0, so that pictures of all times share it, unless the scene is
/// unbounded. For that the file is run again, if it has parameters: the scene's own bounds hold for all their
/// values.
LookFunction lookOf(const Scene& scene, const std::filesystem::path& file, const Values& parameters);

}  // namespace sdf::viewer
