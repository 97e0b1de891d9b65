// What sdfview's command line asks for.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command_line/values.h"
#include "viewer/render/frame.h"
#include "viewer/render/scene_mesh.h"
#include "viewer/shaders/assemble.h"

namespace sdf::viewer {

/// A Comparison is another way to draw the scene, beside which --bench times it.
struct Comparison {
  std::string name;     ///< as the command line has it
  Values parameters{};  ///< set to these in the other
  bool culling = true;
  std::optional<Start> start{};
};

/// Options are what the command line says, with defaults for what it does not.
struct Options {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> folders;  ///< beside the scene's own, from which it may read
  bool cached = true;                          ///< what is sampled of meshes is kept for the next time
  std::optional<std::filesystem::path> picture, glsl;
  std::optional<int> bench;  ///< frames
  std::vector<Comparison> comparisons;
  int width = 1280, height = 720;
  int samples = 1;  ///< a side
  int maxSteps = 1024;
  std::optional<double> seconds;  ///< that a picture is refined for
  double time = 0.0;
  std::optional<int> frames;
  double framesPerSecond = 24.0;
  ShaderOptions shader;
  MeshSettings mesh;
  std::optional<std::filesystem::path> meshFile;  ///< shown in the place of the scene's own mesh
  double split = Frame{}.split;
  std::optional<Eye> eye;
  bool fit = false;  ///< moves the eye, the scene's or this one, to where all is in view
  Values parameters;
};

/// Reads the command line, or answers it where it asks for help or the version. Errors: Usage.
Result<std::variant<Options, command_line::Answer>> parseOptions(int argc, const char* const* argv);

}  // namespace sdf::viewer
