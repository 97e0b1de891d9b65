#include "export_job.h"

#include <chrono>
#include <iostream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "command_line/frames.h"
#include "memory.h"
#include "report.h"
#include "sdf/base/file.h"
#include "sdf/gltf/bake.h"
#include "sdf/gltf/export.h"
#include "sdf/mesh/mesher.h"
#include "sdf/script/script.h"

namespace sdf::exporter {
namespace {

/// Voxels along the longest side, unless told otherwise: a side of a thousand pixels then has five to a
/// voxel.
constexpr double kDefaultVoxels = 200.0;
constexpr std::string_view kStepsAreNotBaked =
    "ambient_occlusion: what counts steps depends on who looks and is not baked; take kind = 'taps'";

/// Runs `work` and returns what it returned, adding how long it took.
template <class Work>
auto timed(double& seconds, Work work) {
  const auto began = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

/// The scene with only the part that was asked for.
Result<Scene> selected(Scene scene, const Options& options) {
  if (!options.only) return scene;
  std::string names;
  for (const Part& part : scene.parts) {
    if (part.name == *options.only) {
      scene.parts = {Part(part)};
      return scene;
    }
    names += (names.empty() ? "" : ", ") + part.name;
  }
  return Error{ErrorKind::Usage, "--only: " + options.scene.string() + " has no part '" + *options.only +
                                     "'; its parts are " + names};
}

/// One export of the scene at one time.
class FrameExport {
 public:
  FrameExport(const Options& options, ProgressLine& progress, std::string subject)
      : options_(options), progress_(progress), subject_(std::move(subject)) {}

  /// Fills `report` and, if it is none yet, `voxelSize`.
  Status run(const std::filesystem::path& target, double time, std::optional<double>& voxelSize) {
    report.file = target;
    report.time = time;
    if (Status s = load(time); !s) return s;
    if (Status s = chooseVoxelSize(voxelSize); !s) return s;
    if (Status s = meshParts(exportedParts(scene, target), *voxelSize); !s) return s;
    if (Status s = bake(); !s) return s;
    progress_.setSubject(subject_);
    progress_.beginStage("writing");
    if (Status s = stage("writing", [&] { return writeMeshes(target, scene, parts_); }); !s) return s;
    report.total.name = "total";
    report.total.stats = combined(parts_);
    report.total.peakMemory = peakMemory();
    return okStatus();
  }

  FileReport report;
  Scene scene;

 private:
  Status load(double time) {
    progress_.setSubject(subject_);
    progress_.beginStage("script");
    const ScriptOptions script{.values = options_.parameters, .time = time, .fixed = true};
    Result<Scene> loaded = stage("script", [&] { return loadScene(options_.scene, script); });
    if (!loaded) return loaded.error();
    Result<Scene> chosen = selected(std::move(*loaded), options_);
    if (!chosen) return chosen.error();
    scene = std::move(*chosen);
    clip_ = options_.bounds ? options_.bounds : scene.bounds;
    return interrupted();
  }

  // Also refuses parts that are unbounded, by their own names.
  Status chooseVoxelSize(std::optional<double>& voxelSize) {
    progress_.beginStage("bounds");
    Box all;
    for (const Part& part : scene.parts) {
      Box box = stage("bounds", [&] { return findBounds(part.shape); });
      if (clip_) box = intersect(box, *clip_);
      if (Status s = interrupted(); !s) return s;
      if (box.empty()) continue;
      // Rather now than after the other parts: the mesher knows best how to word why it cannot be meshed.
      if (!box.finite()) {
        Result<MeshedShape> refused = meshShape(part.shape, part.name, meshOptions(0.0), progress_);
        if (!refused) return refused.error();
      }
      all = unite(all, box);
    }
    if (!voxelSize) voxelSize = all.finite() ? all.longestSide() / kDefaultVoxels : 0.0;
    return okStatus();
  }

  Status meshParts(const std::vector<Part>& parts, double voxelSize) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Part& part = parts[i];
      const std::string place = " (" + std::to_string(i + 1) + " of " + std::to_string(parts.size()) + ")";
      progress_.setSubject(subject_ + (subject_.empty() ? "" : ", ") + "part '" + part.name + "'" + place);
      ReportLine& line = report.parts.emplace_back();
      line.name = part.name;
      if (parts.size() < scene.parts.size())
        for (const Part& one : scene.parts) line.united.push_back(one.name);
      Result<MeshedShape> meshed = timed(
          line.seconds, [&] { return meshShape(part.shape, part.name, meshOptions(voxelSize), progress_); });
      if (!meshed) return meshed.error();
      line.stages = std::move(meshed->stageSeconds);
      line.stats = meshed->stats;
      line.peakMemory = peakMemory();
      report.total.seconds += line.seconds;
      for (const auto& [name, seconds] : line.stages) addSeconds(report.total.stages, name, seconds);
      parts_.push_back({part.name, std::move(meshed->mesh), meshed->stats});
      releaseFreedMemory();  // a band of voxels is far larger than its mesh, and the next one comes on top
    }
    return interrupted();
  }

  Status bake() {
    if (!options_.bake) return okStatus();
    progress_.setSubject(subject_);
    if (scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps)
      report.warnings.emplace_back(kStepsAreNotBaked);
    if (Status s = stage("occlusion", [&] { return bakeAmbient(scene, clip_, parts_, progress_); }); !s)
      return s;
    for (std::size_t i = 0; i < parts_.size(); ++i) report.parts[i].ambientError = parts_[i].ambient->error;
    return okStatus();
  }

  /// Runs `work`, which is a stage of the total.
  template <class Work>
  std::invoke_result_t<Work> stage(const std::string& name, Work work) {
    double seconds = 0.0;
    auto result = timed(seconds, work);
    addSeconds(report.total.stages, name, seconds);
    report.total.seconds += seconds;
    return result;
  }

  MeshOptions meshOptions(double voxelSize) const {
    return {.voxelSize = voxelSize, .bounds = clip_, .maxMemory = options_.maxMemory};
  }

  Status interrupted() const {
    if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
    return okStatus();
  }

  const Options& options_;
  ProgressLine& progress_;
  std::string subject_;
  std::optional<Box> clip_;
  std::vector<ExportPart> parts_;
};

/// The file that the i-th frame goes to, or all.
std::filesystem::path targetOf(const Options& options, int i) {
  return options.frames ? command_line::frameName(options.output, i + 1) : options.output;
}

/// What can be known of the files to write before the work that fills them.
Status checkTargets(const Options& options) {
  for (int i = 0; i < options.frames.value_or(1); ++i)
    if (Status s = checkWritable(targetOf(options, i)); !s) return s;
  return options.report ? checkWritable(*options.report) : okStatus();
}

}  // namespace

Status runExport(const Options& options, ProgressLine& progress, std::ostream& out) {
  if (Status s = checkTargets(options); !s) return s;
  const int frames = options.frames.value_or(1);
  // One for the whole sequence, or its surface would shimmer.
  std::optional<double> voxelSize = options.voxelSize;
  std::vector<FileReport> files;
  std::vector<ParameterInfo> parameters;
  for (int i = 0; i < frames; ++i) {
    const std::string subject =
        options.frames ? "frame " + std::to_string(i + 1) + " of " + std::to_string(frames) : "";
    FrameExport frame(options, progress, subject);
    if (Status s = frame.run(targetOf(options, i), options.time + i / options.framesPerSecond, voxelSize); !s)
      return s;
    progress.clear();
    if (!options.quiet) {
      printTable(out, frame.report);
      printWarnings(std::cerr, frame.report);
    }
    out.flush();
    parameters = frame.scene.parameters;
    files.push_back(std::move(frame.report));
  }
  if (!options.report) return okStatus();
  return writeFile(*options.report, [&](std::ostream& json) {
    json << reportJson(options, parameters, files);
    return okStatus();
  });
}

}  // namespace sdf::exporter
