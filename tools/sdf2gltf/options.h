// What the command line asks for.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command_line/values.h"
#include "sdf/base/box.h"
#include "sdf/base/result.h"

namespace sdf::exporter {

struct Options {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> folders;  ///< beside the scene's own, from which it may read
  std::filesystem::path output;
  std::optional<double> voxelSize;
  double tolerance = 0.0;            ///< scene units; 0: triangles as large as voxels
  bool toleranceOfDiagonal = false;  ///< it is a share of the diagonal of all that is exported
  bool strict = true;                ///< the tolerance was asked for
  std::optional<int> triangles;      ///< of a file at most
  std::optional<int> levels;         ///< of detail: files, each of them with four times the tolerance
  std::optional<Box> bounds;
  std::map<std::string, double> parameters;
  double time = 0.0;
  std::optional<int> frames;
  double framesPerSecond = 24.0;
  std::optional<std::string> only;
  std::optional<std::filesystem::path> report;
  std::optional<int> threads;
  double maxMemory = 0.0;  ///< bytes
  bool animate = false;
  bool bake = false;
  bool compress = false;
  bool certify = false;
  bool keepGoing = false;  ///< where the tolerance cannot be kept
  bool quiet = false;
};

/// The scene's time in the i-th frame, seconds.
double frameTime(const Options& options, int i);
/// The tolerance of a level of detail, counted from 0; in the units of Options::tolerance, 0 where there is
/// none.
double levelTolerance(const Options& options, int level);
/// Where it is written: scene.glb, scene_lod1.glb and so on.
std::filesystem::path levelName(const std::filesystem::path& output, int level);
/// How many files there are, each with a frame of its own.
int filesOf(const Options& options);
/// The i-th of them.
std::filesystem::path targetOf(const Options& options, int i);
/// All that is to be written, levels of detail, too; the report last.
std::vector<std::filesystem::path> targetsOf(const Options& options);
/// "frame 2 of 24"; "" where there is but one.
std::string frameSubject(const Options& options, int i);

/// Errors: Usage.
Result<std::variant<Options, command_line::Answer>> parseOptions(int argc, const char* const* argv);

}  // namespace sdf::exporter
