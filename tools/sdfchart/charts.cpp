#include "charts.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

namespace sdf::chart {
namespace {

// Of the shell's kind: a program that cannot be run.
constexpr int kNoProgram = 127;

// Runs a program that is looked for in PATH; its exit status, or -1.
int run(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child < 0) return -1;
  if (child == 0) {
    ::execvp(arguments[0], arguments.data());
    ::_exit(kNoProgram);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string kept(const std::filesystem::path& folder) {
  return "; what was measured is in '" + (folder / "results.csv").string() + "'";
}

}  // namespace

Checked checkDefaults(const Drawing& drawing, const std::filesystem::path& folder) {
  const int status =
      run({"node", (drawing.scripts / "check.mjs").string(), (folder / "results.csv").string()});
  if (status == 0) return {};
  if (status == 1)
    return {
        "a default is behind the Pareto front, as said above; choose another, or say in "
        "tools/sdfchart/charts/sections.mjs how far it may be",
        kBehind};
  if (status == 2) return {"no default was measured that could be checked" + kept(folder), kNotDrawn};
  return {"the defaults could not be checked: is Debian's nodejs installed?" + kept(folder), kNotDrawn};
}

std::string drawCharts(const Drawing& drawing, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(drawing.packages / "node_modules/echarts"))
    return "the charting library is not in '" + drawing.packages.string() +
           "'; get it with ./bootstrap charts, or with npm ci --prefix DIR in a copy DIR of '" +
           drawing.scripts.string() + "' and --packages DIR" + kept(folder);
  const int status = run({"node", (drawing.scripts / "draw.mjs").string(), drawing.packages.string(),
                          (folder / "results.csv").string(), folder.string()});
  if (status == kNoProgram)
    return "the program 'node' is missing, which draws the charts; install Debian's nodejs, and call this "
           "again with --draw" +
           kept(folder);
  if (status != 0) return "the charts could not be drawn; see node's message above" + kept(folder);
  return "";
}

}  // namespace sdf::chart
