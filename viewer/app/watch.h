// Notices that a file has been written.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

namespace sdf::viewer {

/// A Watch looks at one file by its time of writing and its size. Scenes load no other files.
class Watch {
 public:
  explicit Watch(std::filesystem::path file);

  /// Whether the file has been written since this was last asked, or since the beginning. A file that is
  /// missing, as while an editor replaces it, counts once it is back.
  bool written();

 private:
  using Stamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
  std::optional<Stamp> stamp() const;

  std::filesystem::path file_;
  std::optional<Stamp> last_;
};

}  // namespace sdf::viewer
