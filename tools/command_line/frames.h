// Names of the files of a sequence.
#pragma once
#include <filesystem>

#include "sdf/base/result.h"

namespace sdf::command_line {

/// Nothing wrong if the name has one place for a frame's number, %d or %0Nd, or none. Errors: Usage.
Status checkFrameName(const std::filesystem::path& output);

/// Name of frame `number` (from 1) of a sequence written to `output`: a %d or %0Nd in the file name becomes
/// the number; without one, _0001 goes before the extension.
std::filesystem::path frameName(const std::filesystem::path& output, int number);

}  // namespace sdf::command_line
