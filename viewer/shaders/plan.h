// What a scene's picture needs, found out before any shader is written.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf/eval/glsl.h"
#include "sdf/model/cells.h"
#include "sdf/model/groups.h"
#include "sdf/model/model.h"
#include "sdf/scene/scene.h"
#include "sdf/shape/solids/triangle_solid.h"
#include "viewer/shaders/choices.h"
#include "viewer/shaders/solved.h"

namespace sdf::viewer {

/// ShaderOptions say which shaders of a scene are wanted.
struct ShaderOptions {
  View view = View::Picture;
  Method method = Method::AutoRelaxed;
  Start start = Start::Cone;
  bool countReadings = false;  ///< a second output: readings by primary rays, shadows, occlusion, reflections
  bool es = false;             ///< GLSL ES 3.00 instead of 3.30 core
  bool sharing = true;         ///< like operands may share their code; else all of it is written out
  bool culling = true;  ///< many operands may be read by lists of those that are near; else all are looked at
  bool drawing = true;  ///< meshes from files may be drawn as triangles; else they are marched
  Steps steps = Steps::ByRegion;  ///< of what is marched: by region takes textures
  bool doubles = true;            ///< what floats cannot hold may be computed in double; not in ES
  glm::dvec3 origin{0.0};  ///< what positions in shaders are relative to: see originFor (render/look.h)
  bool operator==(const ShaderOptions&) const = default;
};

/// A Marched distance is one that rays can be marched through; see Marchable.
struct Marched {
  Expr distance;  ///< how far it is
  Expr step;      ///< how far one may go
  Box bounds = Box::everything();
};

/// A DrawnMesh is an operand that is drawn as the triangles that it was made from.
struct DrawnMesh {
  NumberedOperand operand;
  PlacedMesh placed;
  bool own = true;  ///< it looks as its file says; else as it is painted
};

/// A Plan is all that decides which shaders are written, and which uniforms they take.
struct Plan {
  ShaderOptions options;
  std::shared_ptr<ChangingNumbers> numbers{};  ///< that writers take
  Marched whole;
  std::vector<HalfSpace> planes;
  std::vector<Ball> balls;  ///< if rays meet them by their roots
  /// What is marched: the whole without the half spaces and these balls, if there is more.
  std::optional<Marched> rest;
  std::vector<DrawnMesh> drawn;
  /// The operands of the whole, if a hit's surface follows from the number of its operand.
  std::vector<NumberedOperand> operands;
  /// The operands of the rest but those that are drawn as triangles, if there are such, or some are of a kind
  /// whose formula they share: then the whole's distance is read by loops over the kinds' groups.
  std::optional<Kinds> kinds;
  bool gradients = false;  ///< normals are the gradient of the nearest group: see sharesGradients
  /// What names the groups that can be the nearest at a place, if there are so many that the loops are over
  /// these alone.
  std::optional<CellSorter> cells;
  std::vector<std::string> doubtful;  ///< what is wrong with the picture, a line each, for want of doubles
  std::vector<Expr> exact;            ///< nodes that floats cannot hold, which are computed in double
  std::vector<Expr> surface;          ///< the attributes of a hit, if they are shown
  NumberRows surfaceRows;  ///< the numbers in them, by operand; without parameters if there are none
  bool looks = false;      ///< what is shown may look as the triangles of a drawn mesh do
  bool meshed = false;     ///< primary rays meet triangles that the renderer is given, and nothing else
  bool grouped = false;    ///< hits are in layers: that mesh's, or those of each group of the kinds
  bool plain = false;      ///< rays take plain steps
  bool cones = false;      ///< rays start where the cone pass says
  bool hull = false;       ///< or where they enter the rest's hull
  bool tiled = false;      ///< where the cones saw nothing there is only background
  bool lights = false;     ///< light is shown, and there is some
  bool around = false;     ///< the background lights surfaces
  bool filters = false;    ///< the surface has patterns that are averaged over what a pixel covers
  int bounces = 0;         ///< reflections that are followed
  bool glossy = false;     ///< and spread over the lobe of the highlight
  bool lens = false;       ///< primary rays start all over a lens; there are no cones then
  Shadow::Kind shadow = Shadow::Kind::None;  ///< of lights without a size
  bool sized = false;                        ///< lights that have one cast shadows, too
  AmbientOcclusion::Kind occlusion = AmbientOcclusion::Kind::None;
};

/// The samples a side of a pixel up to which more of them are seen to help: 6 where they smooth edges alone,
/// 16 where lights, mirrors or a lens spread.
int usefulSamples(const Plan& plan);

/// Makes the plan of a sound scene. Errors (Scene): a shape whose distance has no known slope.
Result<Plan> planOf(const Scene& scene, const ShaderOptions& options);

}  // namespace sdf::viewer
