// What of a scene file is in view of a camera that is fitted to it.
#pragma once
#include "viewer/render/look.h"
#include "viewer/render/scene_file.h"

namespace sdf::viewer {

/// The box that all of a scene is in at these values of its parameters and at this time; the scene's own
/// bounds hold for all values and times. For that the file that it was loaded from is run again, if it has
/// parameters. Errors: those of loadScene; Scene, where the scene is unbounded.
Result<Box> boxInView(const Scene& scene, const SceneFile& file, const Values& parameters, double time);

/// The look of a scene that was loaded from this file with these values. A camera that it leaves open is
/// fitted to the scene as it is at time 0, so that pictures of all times share it, unless the scene is
/// unbounded.
LookFunction lookOf(const Scene& scene, const SceneFile& file, const Values& parameters);

}  // namespace sdf::viewer
