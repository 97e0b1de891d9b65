// sdfchart: how fast and how right every method is, measured and drawn.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>

#include "bench/machine.h"
#include "charts.h"
#include "command_line/memory.h"

#include "options.h"
#include "sdf/base/fnv.h"
#include "sdf/base/version.h"
#include "sdfchart/measure/measurements.h"

namespace sdf::chart {
namespace {

int fail(const std::string& message, int status) {
  std::string line = "sdfchart: " + message;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  std::cerr << line << std::endl;
  return status;
}
int fail(const Error& error) { return fail(error.message, static_cast<int>(error.kind)); }

void stopOnSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { RunProgress::endRun(); };
  action.sa_flags = SA_RESETHAND;  // a second one ends the program
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

Result<std::vector<Subject>> subjectsOf(const Options& options) {
  if (options.scenes.empty()) return standardSubjects(options.quick || options.trial);
  std::vector<Subject> subjects;
  for (const auto& file : options.scenes) {
    Result<Subject> subject = loadSubject(file);
    if (!subject) return subject.error();
    const bool taken = std::ranges::count(options.scenes, file.stem(), &std::filesystem::path::stem) > 1;
    if (taken) subject->name = file.string();  // rows and charts go by names
    subjects.push_back(std::move(*subject));
  }
  return subjects;
}

std::vector<Batch> batchesOf(const Options& options, const std::vector<Subject>& subjects) {
  const Extent extent = options.trial ? Extent::Trial : options.quick ? Extent::Quick : Extent::Full;
  std::vector<Batch> all;
  const auto add = [&](const char* kind, std::vector<Batch> batches) {
    if (options.measures(kind)) all.insert(all.end(), batches.begin(), batches.end());
  };
  const bool own = options.scenes.empty();
  add("meshing", meshingBatches(subjects, extent));
  add("marching", marchingBatches(own ? std::vector<Subject>() : subjects, extent));
  if (!own) return all;  // the others measure scenes of their own
  add("normals", normalBatches(extent));
  add("shadows", shadowBatches(extent));
  add("occlusion", occlusionBatches(extent));
  add("evaluation", evaluationBatches(extent));
  add("growth", growthBatches(extent));
  add("stability", stabilityBatches(extent));
  return all;
}

// Tells a scene file's text from what it was before.
std::string mark(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  auto hash = kFnvBegin<std::uint32_t>;
  for (std::istreambuf_iterator<char> c(in), end; c != end; ++c)
    hash = fnv(hash, std::uint32_t{static_cast<unsigned char>(*c)});
  return command_line::formatted(" (%08x)", hash);
}

// What a run must have in common with the one that it goes on with.
std::string madeBy(const Options& options) {
  std::string text = std::string("sdfchart ") + version() +
                     (options.quick   ? " --quick"
                      : options.trial ? " --trial"
                                      : "");
  for (const auto& scene : options.scenes) text += " " + scene.string() + mark(scene);
  return text + "; seed 1";
}

Status makeFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    return Error{ErrorKind::Files, "cannot write to the folder '" + folder.string() + "'" +
                                       (error ? ": " + error.message() : "") + "; name another one with -o"};
  return okStatus();
}

Status measure(const Options& options, RunProgress& progress) {
  Result<std::vector<Subject>> subjects = subjectsOf(options);
  if (!subjects) return subjects.error();
  Result<Results> results = Results::open(options.output / "results.csv", madeBy(options));
  if (!results) return results.error();
  return runBatches(batchesOf(options, *subjects), *results, bench::machine(), progress);
}

// Is there something to be drawn?
Status checkMeasured(const Options& options) {
  if (!options.drawOnly || std::filesystem::exists(options.output / "results.csv")) return okStatus();
  return Error{ErrorKind::Usage, "--draw: there is no '" + (options.output / "results.csv").string() +
                                     "'; name the folder of a run with -o, or leave --draw out"};
}

int run(const Options& options) {
  if (Status s = checkMeasured(options); !s) return fail(s.error());
  if (Status s = makeFolder(options.output); !s) return fail(s.error());
  RunProgress progress(!options.quiet, ::isatty(STDERR_FILENO) == 1);
  stopOnSignals();
  const Status measured = options.drawOnly ? okStatus() : measure(options, progress);
  progress.clear();
  if (RunProgress::toldToEnd())
    return fail({ErrorKind::Interrupted, "interrupted; call it again in the same way to go on"});
  if (!measured) return fail(measured.error());
  const std::filesystem::path packages =
      options.packages.empty() ? std::filesystem::path(SDFCHART_PACKAGES) : options.packages;
  if (const std::string why = drawCharts({SDFCHART_SCRIPTS, packages}, options.output); !why.empty())
    return fail(why, kNotDrawn);
  if (options.check)
    if (const Checked checked = checkDefaults({SDFCHART_SCRIPTS, packages}, options.output);
        checked.status != 0)
      return fail(checked.wrong, checked.status);
  if (!options.quiet) std::cout << (options.output / "index.html").string() << std::endl;
  return 0;
}

}  // namespace
}  // namespace sdf::chart

int main(int argc, char** argv) {
  sdf::command_line::endWhereMemoryEnds("sdfchart", "take --quick, or a machine with more");
  auto parsed = sdf::chart::parseOptions(argc, argv);
  if (!parsed) return sdf::chart::fail(parsed.error());
  if (const auto* answer = std::get_if<sdf::command_line::Answer>(&*parsed)) {
    std::cout << answer->text;
    return 0;
  }
  return sdf::chart::run(std::get<sdf::chart::Options>(*parsed));
}
