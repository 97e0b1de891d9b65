#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <optional>

#include "export_job.h"
#include "interrupt.h"
#include "options.h"

namespace sdf::exporter {
namespace {

/// Prints one line, whatever the message holds, and returns the exit status for it.
int fail(const Error& error) {
  std::string line = "sdf2gltf: " + error.message;
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::cerr << line << std::endl;
  return static_cast<int>(error.kind);
}

int run(const Options& options) {
  std::optional<tbb::global_control> threads;
  if (options.threads) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(*options.threads));
  }
  ProgressLine progress("sdf2gltf", ProgressLine::shownOn(options.quiet));
  Status status = okStatus();
  {
    const InterruptWatch watch(progress);
    try {
      status = runExport(options, progress, std::cout);
    } catch (const std::bad_alloc&) {
      status =
          Error{ErrorKind::Limits, "the memory is used up; take a larger --voxel-size or smaller --bounds"};
    }
  }
  progress.clear();
  if (progress.stopped()) status = Error{ErrorKind::Interrupted, "interrupted"};
  return status ? 0 : fail(status.error());
}

}  // namespace
}  // namespace sdf::exporter

int main(int argc, char** argv) {
  // Writing beyond the limit on file sizes shall fail as on a full disk, and not end the program half-way.
  std::signal(SIGXFSZ, SIG_IGN);
  auto parsed = sdf::exporter::parseOptions(argc, argv);
  if (!parsed) return sdf::exporter::fail(parsed.error());
  if (const auto* answer = std::get_if<sdf::command_line::Answer>(&*parsed)) {
    std::cout << answer->text;
    return 0;
  }
  return sdf::exporter::run(std::get<sdf::exporter::Options>(*parsed));
}
