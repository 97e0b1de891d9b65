#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "sdf/base/version.h"

namespace sdf::chart {
namespace {

std::string listed(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

void declare(CLI::App& app, Options& options) {
  app.add_option("SCENE", options.scenes, "scene files (Lua) to mesh and march [scenes of known geometry]")
      ->type_name("");
  app.add_option("-o,--output", options.output, "folder for results.csv, index.html and the charts")
      ->required()
      ->type_name("DIR");
  app.add_option("--only", options.only, "measure this alone; may be repeated: " + listed(kinds(), ", "))
      ->type_name("KIND")
      ->allow_extra_args(false);
  app.add_flag("--quick", options.quick, "fewer settings and runs: about two minutes instead of thirty");
  app.add_flag("--trial", options.trial, "one setting of each method, run once: to see whether all is there");
  app.add_flag("--draw", options.drawOnly, "draw what results.csv holds, and measure nothing");
  app.add_flag("--check", options.check, "fail where a default falls behind the Pareto front");
  app.add_option("--packages", options.packages, "folder in which npm has installed the charting library")
      ->type_name("DIR");
  app.add_flag("-q,--quiet", options.quiet, "print errors only");
  app.footer(
      "A run that was interrupted goes on where it was when it is called again.\n"
      "Exit status: 0 done, 2 usage, 3 scene, 4 limits, 5 files, 7 measured but not drawn (node or the "
      "charting library is missing), 8 a default is behind (--check), 130 interrupted.");
}

}  // namespace

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> all{"meshing",   "marching",   "normals", "shadows",
                                            "occlusion", "evaluation", "growth",  "stability"};
  return all;
}

bool Options::measures(const std::string& kind) const {
  return only.empty() || std::find(only.begin(), only.end(), kind) != only.end();
}

Result<std::variant<Options, command_line::Answer>> parseOptions(int argc, const char* const* argv) {
  using Parsed = std::variant<Options, command_line::Answer>;
  CLI::App app("Measures the methods of libsdf, how fast and how right each is, and draws charts of it.",
               "sdfchart");
  app.set_version_flag("--version", std::string("sdfchart ") + version());
  Options options;
  declare(app, options);
  Result<std::optional<command_line::Answer>> answer = command_line::parse(app, argc, argv);
  if (!answer) return answer.error();
  if (*answer) return Parsed(std::move(**answer));
  for (const std::string& kind : options.only)
    if (std::find(kinds().begin(), kinds().end(), kind) == kinds().end())
      return command_line::usage("--only takes " + listed(kinds(), ", ") + "; got '" + kind + "'");
  for (const std::string& kind : options.only)
    if (!options.scenes.empty() && kind != "meshing" && kind != "marching")
      return command_line::usage("scene files are meshed and marched; --only " + kind +
                                 " measures scenes of its own: leave the file or the option out");
  if (options.quick && options.trial) return command_line::usage("take --quick or --trial, not both");
  return Parsed(std::move(options));
}

}  // namespace sdf::chart
