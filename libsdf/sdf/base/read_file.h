// Reading files whole.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "sdf/base/result.h"

namespace sdf {

/// "cannot read 'path': why" (Files).
Error unreadable(const std::filesystem::path& file, const std::string& why);
/// The same with the system's reason, an errno, and what to do.
Error unreadable(const std::filesystem::path& file, int reason);

/// The bytes of a file, which must be an ordinary one, not empty and of no more than `most` bytes. Errors:
/// Files, with the system's reason; Limits, with `advice` on how to make it smaller.
Result<std::string> readFile(const std::filesystem::path& file, std::uintmax_t most,
                             const std::string& advice);

}  // namespace sdf
