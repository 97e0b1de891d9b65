// Draws a scene with OpenGL, in the current context.
#pragma once
#include <memory>
#include <optional>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/gpu/texels.h"
#include "viewer/render/cell_values.h"
#include "viewer/render/frame.h"
#include "viewer/render/primary_hits.h"
#include "viewer/render/volumes.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// Readings are counts of readings of the distance a pixel, means over the picture; with `countReadings`
/// only.
struct Readings {
  double primary = 0.0;  ///< a primary ray, its part of the cone pass included
  double shadow = 0.0, occlusion = 0.0, reflection = 0.0;
};

/// Counts the pixels, of a picture that a Renderer drew, of which a ray ran out of steps.
std::size_t pixelsOutOfSteps(const Picture& picture);

/// Counts the others of which the ray of a shadow ran out of the scene's shadow steps, and is taken for dark.
std::size_t pixelsOutOfShadowSteps(const Picture& picture);

/// Rows are some of a picture's, counted from the bottom.
struct Rows {
  int first, count;
};

/// A Renderer draws one scene; in View::Split its picture left of Frame::split, and its mesh from there on.
class Renderer {
 public:
  /// Compiles the scene's shaders, for frames whose eyes are not far from the options' origin (originFor).
  /// Frames are the scene's own, wherever that is. If follow() is to be called, it is told of the scene at
  /// another moment, too: where both differ shaders read uniforms. Errors: Scene as assemble; Graphics with
  /// the driver's log.
  static Result<Renderer> make(const Scene& scene, const ShaderOptions& options = {},
                               const Scene* other = nullptr);

  /// Draws from now on this scene, the renderer's own at another moment. It compiles shaders only where their
  /// code differs by more than numbers, and returns whether it did: then no mesh is shown. Errors: as make;
  /// what is drawn stays then.
  Result<bool> follow(const Scene& scene);

  /// Hands over the mesh that a view of one shows (showsMesh); before there is none in its pictures. Colours
  /// of errors are those of distances up to `limit` to either side, scene units, above 0. Errors: Limits.
  Status showMesh(const ShownMesh& mesh, double limit = 1.0);

  /// Computes the uniforms of a frame, which draw() does too, unless they are those of the frame before. It
  /// compiles nothing and calls no OpenGL.
  void prepare(const Frame& frame);

  /// Draws into the target, whose first layer is the picture (dithered where it holds bytes; alpha 0 where a
  /// ray ran out of steps, 1/2 where only one of a shadow did) and, with countReadings, whose second (floats)
  /// holds what readings(target) then sums up. Errors: Limits, Graphics.
  /// Only these rows are drawn, if any are named: pieces of a picture follow one another from row 0 on, and
  /// this renderer draws nothing else between.
  Status draw(const Frame& frame, const Target& target, std::optional<Rows> rows = {});

  /// Draws one more of the frame's samples, of which `drawn` have been drawn, of the same frame and into a
  /// target of the same size; 0 begins anew. The target shows their mean, and after the last one what draw()
  /// does but for the order of the sum. Rows of a sample are as draw has them. Errors: as draw.
  Status refine(const Frame& frame, int drawn, const Target& target, std::optional<Rows> rows = {});

  /// Returns the readings that the last picture, in this target, took. Errors: as Target::pixels.
  Result<Readings> readings(const Target& target) const;

  const SceneShaders& shaders() const { return shaders_; }
  /// Returns what the shaders' positions are relative to.
  const glm::dvec3& origin() const { return shaders_.plan.options.origin; }
  double compileSeconds() const { return compileSeconds_; }

 private:
  /// Columns are some of a picture's, counted from the left.
  struct Columns {
    int first, count;
  };
  Renderer(const Scene& scene, SceneShaders shaders);
  static Result<Renderer> compiled(const Scene& scene, Result<SceneShaders> shaders);
  void takeNumbers(const Scene& scene, SceneShaders shaders);
  template <class Draw>
  Status drawSides(const Frame& frame, const Target& target, const Draw& draw);
  Status drawColumns(const Frame& frame, const Target& target, const Rows& rows, const Columns& columns);
  Status refineColumns(const Frame& frame, int drawn, const Target& target, const Rows& rows,
                       const Columns& columns);
  Result<glm::dvec4> counts(const Target& target) const;
  Result<double> primaryReadings() const;
  Status compile();
  void setLook(const Program& program, const Frame& frame, const Shot& shot) const;
  Status giveRows();  // those of the frame, to all shaders
  void drawPicture(const Frame& frame, const Shot& shot) const;
  void drawBackground(const Shot& shot) const;
  Status begin(const Frame& frame, const Shot& shot, const Target& target, const Rows& rows);
  Status clearSums(const Shot& shot);
  Status addSample(const Frame& frame, Shot& shot, int i);
  Status resolve(const Shot& shot, const Target& target, double drawn);

  std::unique_ptr<Renderer> marched_;  // draws the picture's side of a split view
  SceneShaders shaders_;
  Volumes volumes_;
  std::optional<PrimaryHits> hits_;
  std::optional<Program> picture_, background_;  // the latter of tiles that show nothing else
  std::optional<Program> resolve_;
  std::optional<Target> sums_;  // of several samples
  int samples_ = 1;             // of the frame drawn last
  double grain_ = 0.0;          // step of the values of what it was drawn into
  UniformValues values_;        // of the picture
  std::optional<UniformValues> backgroundValues_;
  std::optional<BackgroundValues> around_;  // what lights surfaces of the background, if that does
  UniformValues rowValues_;
  std::optional<CellValues> cellValues_;  // behind the rows, if the plan has cells
  double errorLimit_ = 1.0;               // of the mesh, if one is shown
  bool rowsMoved_ = false;                // and rows_ have not been filled since
  std::optional<TexelRow> rows_;          // the texture sdfRows, if there are any
  Extent extent_;
  int shadowSteps_;
  double compileSeconds_ = 0.0;
};

}  // namespace sdf::viewer
