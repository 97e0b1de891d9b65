// Draws a scene with OpenGL, in the current context.
#pragma once
#include <optional>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/look.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// What may change from one frame to the next without compiling, but for the first that takes more than one
/// sample.
struct Frame {
  Parameters parameters;
  Look look;
  int samples = 1;          ///< a side: a pixel takes its square
  bool filter = true;       ///< patterns are averaged over what a sample covers; see shaders/filter.h
  int maxSteps = 512;       ///< readings that a ray may take
  double epsilon = 1e-5;    ///< least distance that counts as a hit, scene units
  double threshold = 0.25;  ///< share of the pixel's cone that counts as a hit
};

/// Readings of the distance a pixel, means over the picture; with `countReadings` only.
struct Readings {
  double primary = 0.0;  ///< a primary ray, its part of the cone pass included
  double shadow = 0.0, occlusion = 0.0, reflection = 0.0;
};

/// Those of a picture that a Renderer drew whose primary rays ran out of steps.
std::size_t pixelsOutOfSteps(const Picture& picture);

/// The frame of the scene's own look.
Frame frameOf(const Scene& scene, Parameters parameters = {});

class Renderer {
 public:
  /// Compiles the scene's shaders. Errors: Scene as assemble; Graphics with the driver's log.
  static Result<Renderer> make(const Scene& scene, const ShaderOptions& options = {});

  /// Draws into the target, whose first layer is the picture (alpha 0 where a primary ray ran out of steps)
  /// and, with countReadings, whose second (floats) holds what readings(target) then sums up. Errors: Limits,
  /// Graphics.
  Status draw(const Frame& frame, const Target& target);

  /// Errors: as Target::pixels.
  Result<Readings> readings(const Target& target) const;

  const SceneShaders& shaders() const { return shaders_; }
  double compileSeconds() const { return compileSeconds_; }

 private:
  /// What draws the picture: all of it, or the tiles that show more than the background.
  struct Passes {
    Program scene;
    std::optional<Program> background;
  };

  Renderer(const Scene& scene, SceneShaders shaders, Passes single, std::optional<Program> cones);
  static Result<Passes> passes(const SceneShaders& shaders, const std::string& picture);
  void setFrame(const Program& program, const Frame& frame, const Target& target) const;
  void setLook(const Program& program, const Frame& frame) const;
  void drawTiles(const Program& scene, const Target& target) const;
  Status drawCones(const Frame& frame, const Target& target);

  SceneShaders shaders_;
  Passes single_;
  std::optional<Passes> many_;  // compiled when more than one sample is first asked for
  std::optional<Program> cones_;
  std::optional<Target> coarse_, fine_;
  std::vector<glm::vec4> values_;  // of the frame that is being drawn, for the shaders' sdfValues
  std::optional<Box> bounds_;      // of the whole scene, if it is finite
  Shadow shadow_;
  double tapSpacing_, maxDistance_;
  double compileSeconds_ = 0.0;
};

}  // namespace sdf::viewer
