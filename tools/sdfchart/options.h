// What the command line asks for.
#pragma once
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "command_line/values.h"

namespace sdf::chart {

struct Options {
  std::vector<std::filesystem::path> scenes;  ///< none: the standard ones
  std::filesystem::path output;
  std::vector<std::string> only;  ///< kinds of measurements; none: all
  bool quick = false, trial = false, quiet = false, drawOnly = false, check = false;
  std::filesystem::path packages;  ///< the folder with npm's node_modules; empty: where the build has it

  bool measures(const std::string& kind) const;
};

/// The kinds of measurements, in the order in which they are taken and shown.
const std::vector<std::string>& kinds();

/// Errors: Usage.
Result<std::variant<Options, command_line::Answer>> parseOptions(int argc, const char* const* argv);

}  // namespace sdf::chart
