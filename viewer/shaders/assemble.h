// From a scene to the source of its shaders: what the scene does not use is not in them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sdf/eval/function.h"
#include "viewer/shaders/plan.h"

namespace sdf::viewer {

/// A Shader is a fragment shader, and what its uniform sdfValues holds.
struct Shader {
  std::string text;
  Function uniforms;
};

/// HitShaders are the fragment shaders of a pass that looks where the rays of each tile start and, if it is
/// one of those by which a wide union is drawn, what they hit.
struct HitShaders {
  std::string cones{};  ///< the starts; empty: all rays start at the eye
  std::string hits{};   ///< fills the layers of hits (parts::kHits); empty: the picture's shader marches
  std::vector<Function> uniforms{};  ///< the pass is drawn once with the values of each
};

/// SceneShaders are the fragment shaders that draw a scene, one pass after the other; see ray_parts.h for
/// their uniforms.
struct SceneShaders {
  Plan plan;
  /// One for each kind of groups and one for the half spaces, or one that has cones only, or none.
  std::vector<HitShaders> hits;
  Shader picture;
  std::optional<Shader> background;  ///< what tiles show where there are no hits, if the plan is tiled
  std::string resolve;               ///< from the sums of several samples to the picture

  /// Adds up the length of all shaders of the scene, the background and the resolving pass apart.
  std::size_t bytes() const;
};

/// Writes the shaders of a scene. Errors (Scene): what `checked` finds, and a shape whose distance has no
/// known slope.
Result<SceneShaders> assemble(const Scene& scene, const ShaderOptions& options);

}  // namespace sdf::viewer
