// Draws a scene with OpenGL, in the current context.
#pragma once
#include <optional>

#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/frame.h"
#include "viewer/render/groups.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// Readings of the distance a pixel, means over the picture; with `countReadings` only.
struct Readings {
  double primary = 0.0;  ///< a primary ray, its part of the cone pass included
  double shadow = 0.0, occlusion = 0.0, reflection = 0.0;
};

/// Those of a picture that a Renderer drew whose primary rays ran out of steps.
std::size_t pixelsOutOfSteps(const Picture& picture);

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

  Renderer(const Scene& scene, SceneShaders shaders);
  static Result<Passes> passes(const SceneShaders& shaders, const std::string& picture);
  Status compile(bool manySamples);
  void setLook(const Program& program, const Frame& frame) const;
  Status drawCones(const Shot& shot);
  Status drawScene(const Passes& passes, const Frame& frame, const Shot& shot, const Target& target) const;

  SceneShaders shaders_;
  std::optional<Passes> single_, many_;  // by samples; compiled when first asked for
  std::optional<Program> cones_;         // of the whole, likewise
  std::optional<Groups> groups_;         // instead of them, where one sample is taken
  std::optional<Target> coarse_, fine_;
  bool grouped_ = false;           // the frame drawn last
  std::vector<glm::vec4> values_;  // of the frame that is being drawn, for the shaders' sdfValues
  std::optional<Box> bounds_;      // of the whole scene, if it is finite
  Shadow shadow_;
  double tapSpacing_, maxDistance_;
  double compileSeconds_ = 0.0;
};

}  // namespace sdf::viewer
