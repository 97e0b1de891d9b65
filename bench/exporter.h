// sdf2gltf as its users run it: in a process of its own.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sdf::bench {

/// A folder that goes with this object.
class WorkFolder {
 public:
  WorkFolder();
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  std::string operator/(const std::string& file) const { return (path_ / file).string(); }

 private:
  std::filesystem::path path_;
};

/// Runs the exporter to its end and returns its exit status; kTimedOut where it was ended after `seconds` (0:
/// never), -1 where it could not be run.
int runExporter(const std::vector<std::string>& words, int seconds = 0);
inline constexpr int kTimedOut = 124;

/// What the exporter reports of all that it wrote.
struct Exported {
  double triangles = 0.0;
  double maxDistance = 0.0;  ///< scene units
  double seconds = 0.0;
  double peakMegabytes = 0.0;
};
/// Exports to a file that does not stay, as these words say, within as many seconds (0: however many).
/// Nothing where it fails; `status` receives the exit status.
std::optional<Exported> exported(std::vector<std::string> words, int seconds = 0, int* status = nullptr);

}  // namespace sdf::bench
