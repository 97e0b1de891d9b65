// From a scene to the source of its shaders: what the scene does not use is not in them.
#pragma once
#include <string>
#include <vector>

#include "sdf/eval/glsl.h"
#include "sdf/scene/scene.h"

namespace sdf::viewer {

/// What a pixel shows.
enum class View {
  Picture,    ///< the scene under its lights
  Normals,    ///< (n + 1) / 2
  Steps,      ///< readings of the primary ray as heat, from blue for none to red for the step budget; magenta
              ///< where it ran out
  Slice,      ///< the distance on a plane through what the camera looks at, with isolines
  Gradient,   ///< length of the distance's gradient at the hit: green 1, blue below, red above
  Material,   ///< diffuse colour, unlit
  Occlusion,  ///< ambient occlusion alone
  Shadow,     ///< share of the lights that arrives, the mean over those that cast shadows
  Count
};

enum class Method { AutoRelaxed, Plain };

struct ShaderOptions {
  View view = View::Picture;
  Method method = Method::AutoRelaxed;
  bool countReadings = false;  ///< a second output: readings by primary rays, shadows, occlusion, reflections
  bool es = false;             ///< GLSL ES 3.00 instead of 3.30 core
  bool grouped = true;         ///< may draw a wide union's picture in groups; else one shader draws all of it
};

/// The passes that draw groups of a wide union, each by itself.
struct GroupShaders {
  std::string cones;
  std::string hits;                ///< of the primary rays: normals and how far they are, see parts::kHits
  std::vector<GlslWriter> values;  ///< one for each group that these draw
};

/// Fragment shaders, which share the uniforms of `values`; see parts.cpp for the others.
struct SceneShaders {
  std::string picture;
  std::string cones;  ///< empty where the method starts every ray at the eye, and where there are groups
  GlslWriter values;
  std::string resolve;               ///< from the sums of several samples to the picture
  bool counted = false;              ///< countReadings
  bool tiled = false;                ///< where the cones saw nothing, there is only background
  std::vector<GroupShaders> groups;  ///< of a wide union, from whose hits the picture is drawn; else none

  /// Of all that is drawn with.
  std::size_t bytes() const;
};

/// Errors (Scene): what `checked` finds, and a shape whose distance has no known slope.
Result<SceneShaders> assemble(const Scene& scene, const ShaderOptions& options);

/// One that draws the background alone.
std::string forBackground(const std::string& picture);

}  // namespace sdf::viewer
