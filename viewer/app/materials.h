// Materials that can be edited while a scene is shown.
#pragma once
#include <optional>
#include <set>
#include <string>

#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// Returns one number of a part's surface as a parameter, if it is the same all over the part; no scene can
/// have a parameter of its name.
std::optional<ParameterInfo> surfaceParameter(const Part& part, Attribute attribute);

/// Returns the scene with these parts' surface numbers as parameters where they can be.
Scene withSurfaceParameters(Scene scene, const std::set<std::string>& parts);

}  // namespace sdf::viewer
