#include "exporter.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

extern char** environ;

namespace sdf::bench {

WorkFolder::WorkFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "sdf_bench_XXXXXX").string();
  if (::mkdtemp(name.data())) path_ = name;
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

int runExporter(const std::vector<std::string>& words, int seconds) {
  std::vector<std::string> command{SDF2GLTF};
  if (seconds > 0) command = {"timeout", std::to_string(seconds), SDF2GLTF};
  command.insert(command.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& w : command) arguments.push_back(w.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  int status = -1;
  if (::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) return -1;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::optional<Exported> exported(std::vector<std::string> words, int seconds, int* status) {
  const WorkFolder folder;
  const std::string report = folder / "report.json";
  words.insert(words.end(), {"-o", folder / "out.glb", "--quiet", "--report", report});
  const int ended = runExporter(words, seconds);
  if (status) *status = ended;
  if (ended != 0) return {};
  std::ifstream in(report);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  const nlohmann::json::json_pointer total("/outputs/0/total");
  if (!json.contains(total)) return {};
  const nlohmann::json& t = json[total];
  return Exported{t.value("triangles", 0.0), t.value("max_distance", 0.0), t.value("seconds", 0.0),
                  1e-6 * t.value("peak_memory_bytes", 0.0)};
}

}  // namespace sdf::bench
