#include "export_job.h"

#include <iostream>
#include <utility>

#include "animation_export.h"
#include "command_line/frames.h"
#include "frame_export.h"
#include "report.h"
#include "sdf/base/file.h"

namespace sdf::exporter {
namespace {

/// How many files there are, each with a frame of its own.
int filesOf(const Options& options) { return options.animate ? 1 : options.frames.value_or(1); }

/// The i-th of them.
std::filesystem::path targetOf(const Options& options, int i) {
  return options.frames && !options.animate ? command_line::frameName(options.output, i + 1) : options.output;
}

/// What can be known of the files to write before the work that fills them.
Status checkTargets(const Options& options) {
  for (int i = 0; i < filesOf(options); ++i)
    for (int level = 0; level < options.levels.value_or(1); ++level)
      if (Status s = checkWritable(levelName(targetOf(options, i), level)); !s) return s;
  return options.report ? checkWritable(*options.report) : okStatus();
}

/// What was written, for the report.
struct Written {
  std::vector<FileReport> files;
  std::vector<ParameterInfo> parameters;
};

void tell(const Options& options, const FileReport& file, ProgressLine& progress, std::ostream& out) {
  progress.clear();
  if (!options.quiet) {
    printTable(out, file);
    printWarnings(std::cerr, file);
  }
  out.flush();
}

Status exportFrames(const Options& options, ProgressLine& progress, std::ostream& out, Written& written) {
  // One for the whole sequence, or its surface would shimmer.
  std::optional<double> voxelSize = options.voxelSize;
  for (int i = 0; i < filesOf(options); ++i) {
    FrameExport frame(options, progress, frameSubject(options, i));
    const std::filesystem::path target = targetOf(options, i);
    if (Status s = frame.load(frameTime(options, i), voxelSize); !s) return s;
    written.parameters = frame.scene.parameters;
    for (int level = 0; level < options.levels.value_or(1); ++level) {
      if (Status s =
              frame.mesh(exportedParts(frame.scene, target), *voxelSize, levelTolerance(options, level));
          !s)
        return s;
      if (Status s = frame.write(levelName(target, level)); !s) return s;
      tell(options, frame.report, progress, out);
      written.files.push_back(frame.report);
    }
  }
  return okStatus();
}

Status exportAnimation(const Options& options, ProgressLine& progress, std::ostream& out, Written& written) {
  AnimationExport animation(options, progress);
  for (int i = 0; i < *options.frames; ++i)
    if (Status s = animation.add(i); !s) return s;
  if (Status s = animation.write(); !s) return s;
  tell(options, animation.report(), progress, out);
  written = {{animation.report()}, animation.parameters()};
  return okStatus();
}

}  // namespace

Status runExport(const Options& options, ProgressLine& progress, std::ostream& out) {
  if (Status s = checkTargets(options); !s) return s;
  Written written;
  const auto run = options.animate ? exportAnimation : exportFrames;
  if (Status s = run(options, progress, out, written); !s) return s;
  if (!options.report) return okStatus();
  return writeFile(*options.report, [&](std::ostream& json) {
    json << reportJson(options, written.parameters, written.files);
    return okStatus();
  });
}

}  // namespace sdf::exporter
