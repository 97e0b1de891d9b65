// What sdfview's command line asks for.
#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command_line/values.h"
#include "viewer/render/picture_options.h"
#include "viewer/render/scene_file.h"

namespace sdf::viewer {

/// A Comparison is another way to draw the scene, beside which --bench times it.
struct Comparison {
  std::string name;     ///< as the command line has it
  Values parameters{};  ///< set to these in the other
  bool culling = true;
  std::optional<Start> start{};
};

/// Options are what the command line says, with defaults for what it does not.
struct Options : PictureOptions {
  SceneFile scene;
  std::optional<std::filesystem::path> picture, glsl;
  std::optional<int> bench;  ///< frames
  std::vector<Comparison> comparisons;
  int width = 1280, height = 720;
  std::optional<double> seconds;  ///< that a picture is refined for
  std::optional<int> frames;
  double framesPerSecond = 24.0;
  bool quiet = false;  ///< no word of how far the work is
  bool fit = false;    ///< moves the eye, the scene's or this one, to where all is in view
};

/// Reads the command line, or answers it where it asks for help or the version. Errors: Usage.
Result<std::variant<Options, command_line::Answer>> parseOptions(int argc, const char* const* argv);

}  // namespace sdf::viewer
