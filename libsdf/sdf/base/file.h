// Writing files whole: a file appears under its name only when every byte of it is on its way to the disk.
#pragma once
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "sdf/base/result.h"

namespace sdf {

/// The name's extension with its dot, in lower case: ".glb" of "A.GLB".
std::string lowerExtension(const std::filesystem::path& name);
/// Is the name's extension one of these (".glb"), in upper or lower case? The error lists them (Usage).
Status checkExtension(const std::filesystem::path& name, std::span<const std::string_view> known);

/// Could a file be made at `target` now? Checks that its folder exists and is writable, and that no folder,
/// device or pipe and no write-protected file has that name. Meant to be asked before long work; a full disk
/// shows only on writing. Errors: Files.
Status checkWritable(const std::filesystem::path& target);

/// Are these one file, by whatever names and links? Neither need be there.
bool areOneFile(const std::filesystem::path& a, const std::filesystem::path& b);
/// Refuses a target that is one of the files that a program reads: writing it would destroy what was read.
/// Errors: Files.
Status checkNotRead(const std::filesystem::path& target, std::span<const std::string> read);

/// Calls `write` with a binary stream into a new file beside `target`, and renames that to `target` once
/// `write` has succeeded and everything is written. On any failure the new file is removed and an older
/// `target` is left as it was. A target that is a symbolic link is followed; the permissions of an older one
/// are kept. What writers that were killed left in that folder is removed. Errors: those of `write`; Files,
/// with the system's reason and what to do; Interrupted where AbandonedWrites ended it.
Status writeFile(const std::filesystem::path& target, const std::function<Status(std::ostream&)>& write);

/// For programs that are told to end. Making one removes every unfinished file at once, and the writeFile
/// behind it fails with Interrupted; so does each that begins while one lives. Later ones know nothing of it.
/// May be made on any thread, not in a signal handler.
class AbandonedWrites {
 public:
  AbandonedWrites();
  ~AbandonedWrites();
  AbandonedWrites(const AbandonedWrites&) = delete;
  AbandonedWrites& operator=(const AbandonedWrites&) = delete;
};

}  // namespace sdf
