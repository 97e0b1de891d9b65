// From a scene to the source of its shaders: what the scene does not use is not in them.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sdf/eval/function.h"
#include "viewer/shaders/plan.h"
#include "viewer/shaders/volume.h"

namespace sdf::viewer {

/// A Shader is a fragment shader, and what its uniform sdfValues holds.
struct Shader {
  std::string text;
  Function uniforms;
  bool takesRows = false;  ///< it has the uniform sdfRows
  std::vector<ShaderVolume> volumes{};
};

/// The side of the texture sdfRows, in texels: what every driver has room for.
inline constexpr int kRowShift = 10, kRowTexels = 1 << kRowShift;

/// Behind the rows there are so many texels for each cell, with a list's begin and end for each of its kinds
/// in turn; then the lists.
constexpr std::size_t cellTexels(std::size_t kinds) { return (kinds + 1) / 2; }

/// A RowRange is a part of the texture sdfRows.
struct RowRange {
  std::size_t count = 0, first = 0, stride = 0;  ///< rows; the first one, and the length of each, in texels

  /// Lists hold rows themselves where these are short or few, else in a texel each where the row is.
  bool isInLists() const { return stride == 1 || (stride <= 3 && count <= 2048); }
  /// Returns how many texels of a list one of the rows takes.
  std::size_t listed() const { return isInLists() ? stride : 1; }
};

/// HitShaders are the fragment shaders of a pass that looks where the rays of each tile start and, if it is
/// one of those by which a union is drawn, what they hit.
struct HitShaders {
  std::string cones{};  ///< the starts; empty: all rays start at the eye, or at boxes
  std::string hits{};   ///< fills the layers of hits (parts::kHits); empty: the picture's shader marches
  Function uniforms{std::vector<Expr>{}};  ///< what the uniform sdfValues of both holds
  bool takesRows = false;                  ///< they have the uniform sdfRows
  RowRange rows{};  ///< the pass is drawn once with each in the uniform sdfRow; none: once, without that
  std::vector<Box> boxes{};  ///< where rays start, each time that the pass is drawn, instead of cones
  std::vector<ShaderVolume> volumes{};  ///< of both
};

/// SceneShaders are the fragment shaders that draw a scene, one pass after the other; see ray_parts.h for
/// their uniforms.
struct SceneShaders {
  Plan plan;
  /// One for each kind of operands, for the others and for the half spaces, or one that has cones only, or
  /// none.
  std::vector<HitShaders> hits;
  std::optional<Shader> boxCones;  ///< the starts at boxes, if a pass has some
  std::string triangles;           ///< draws the plan's meshes, if there are some
  std::string hull;                ///< draws where rays enter the rest's hull, if the plan says so
  Function rows;                   ///< what the texture sdfRows holds first: four numbers a texel
  std::vector<RowRange> kindRows;  ///< where those of the plan's kinds lie
  Shader picture;
  std::optional<Shader> background;  ///< what tiles show where there are no hits, if the plan is tiled
  std::string resolve;               ///< from the sums of several samples to the picture

  /// Adds up the length of all shaders of the scene, the background and the resolving pass apart.
  std::size_t bytes() const;
};

/// Returns what all of its shaders read.
std::vector<ShaderVolume> volumesOf(const SceneShaders& shaders);

/// Refuses scenes whose numbers shaders cannot hold. Errors: Scene.
Status checkNumbers(const Scene& scene);

/// Writes the shaders of a scene, in a form that serves other moments of it if numbers change. Errors
/// (Scene): what `checked` finds, and a shape whose distance has no known slope.
Result<SceneShaders> assemble(const Scene& scene, const ShaderOptions& options,
                              std::shared_ptr<ChangingNumbers> numbers = {});

/// Returns whether shaders of one scene at two moments are the same code: what they differ in are uniforms,
/// rows, boxes and payloads of one kind.
bool sameCode(const SceneShaders& a, const SceneShaders& b);

}  // namespace sdf::viewer
