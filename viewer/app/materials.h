// Materials that can be edited while a scene is shown.
#pragma once
#include <optional>
#include <set>
#include <string>

#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// A SurfaceControl edits one attribute of a surface, or the three of a colour. All are in the order of
/// attributes.
struct SurfaceControl {
  const char* name;
  Attribute first;
  int count;
  double largest;  ///< value that a slider offers
};
inline constexpr SurfaceControl kSurfaceControls[] = {
    {"colour", Attribute::Red, 3, 1.0},
    {"ambient", Attribute::AmbientRed, 3, 1.0},
    {"highlight", Attribute::SpecularRed, 3, 1.0},
    {"shininess", Attribute::Shininess, 1, 512.0},
    {"reflectivity", Attribute::Reflectivity, 1, 1.0},
    {"Fresnel power", Attribute::FresnelPower, 1, 10.0},
    {"Fresnel bias", Attribute::FresnelBias, 1, 1.0},
    {"emission", Attribute::EmissionRed, 3, 4.0},
};

/// Returns one number of a part's surface as a parameter, if it is the same all over the part; no scene can
/// have a parameter of its name.
std::optional<ParameterInfo> surfaceParameter(const Part& part, Attribute attribute);

/// Returns the scene with these parts' surface numbers as parameters where they can be.
Scene withSurfaceParameters(Scene scene, const std::set<std::string>& parts);

}  // namespace sdf::viewer
