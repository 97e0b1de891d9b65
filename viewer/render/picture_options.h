// What is asked for of a scene's picture, in a window or a file.
#pragma once
#include <filesystem>
#include <optional>

#include "viewer/render/frame.h"
#include "viewer/render/scene_mesh.h"
#include "viewer/shaders/plan.h"

namespace sdf::viewer {

/// PictureOptions go unchanged from the command line to the window and the shaders.
struct PictureOptions {
  Values parameters{};       ///< those that are set, by name; without "time"
  double time = 0.0;         ///< of the scene, seconds
  std::optional<Eye> eye{};  ///< none: the scene's camera
  ShaderOptions shader{};
  MeshSettings mesh{};
  std::optional<std::filesystem::path> meshFile{};  ///< shown in the place of the scene's own mesh
  double split = Frame{}.split;
  int samples = Frame{}.samples;  ///< a side
  int maxSteps = Frame{}.maxSteps;
  bool operator==(const PictureOptions&) const = default;

  /// Returns the frame of a look, where the scene's inputs have these values.
  Frame frame(Values inputs, Look look) const {
    return {.parameters = std::move(inputs),
            .look = std::move(look),
            .split = split,
            .samples = samples,
            .maxSteps = maxSteps};
  }
};

}  // namespace sdf::viewer
