// What the command line asks for.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "sdf/base/box.h"
#include "sdf/base/result.h"

namespace sdf {

struct Options {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::optional<double> voxelSize;
  std::optional<Box> bounds;
  std::map<std::string, double> parameters;
  double time = 0.0;
  std::optional<int> frames;
  double framesPerSecond = 24.0;
  std::optional<std::string> only;
  std::optional<std::filesystem::path> report;
  std::optional<int> threads;
  double maxMemory = 0.0;  ///< bytes
  bool quiet = false;
};

/// The command line was a question (--help, --version), and this is the answer.
struct Answer {
  std::string text;
};

/// Errors: Usage.
Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv);

/// Name of frame `number` (from 1) of a sequence written to `output`: a %d or %0Nd in the file name becomes
/// the number; without one, _0001 goes before the extension.
std::filesystem::path frameName(const std::filesystem::path& output, int number);

}  // namespace sdf
