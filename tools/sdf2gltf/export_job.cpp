#include "export_job.h"

#include <iostream>
#include <utility>

#include "animation_export.h"
#include "frame_export.h"
#include "report.h"
#include "sdf/base/file.h"

namespace sdf::exporter {
namespace {

/// What can be known of the files to write before the work that fills them.
Status checkTargets(const Options& options) {
  const std::vector<std::string> scene{options.scene.string()};
  std::vector<std::filesystem::path> targets = targetsOf(options);
  for (const std::filesystem::path& target : targets) {
    if (Status s = checkWritable(target); !s) return s;
    if (Status s = checkNotRead(target, scene); !s) return s;
  }
  if (!options.report) return okStatus();
  targets.pop_back();
  for (const std::filesystem::path& target : targets)
    if (areOneFile(target, *options.report))
      return Error{ErrorKind::Usage, "--report and --output would both write '" + target.string() +
                                         "'; give the report a name of its own"};
  return okStatus();
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
  std::vector<std::string> told;
  for (int i = 0; i < filesOf(options); ++i) {
    FrameExport frame(options, progress, frameSubject(options, i));
    const std::filesystem::path target = targetOf(options, i);
    if (Status s = frame.load(frameTime(options, i), voxelSize, told); !s) return s;
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
