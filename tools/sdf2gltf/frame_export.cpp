#include "frame_export.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string_view>
#include <utility>

#include "memory.h"
#include "parts_progress.h"
#include "sdf/base/file.h"
#include "sdf/base/parallel.h"
#include "sdf/export/bake.h"
#include "sdf/export/compress.h"
#include "sdf/mesh/mesher.h"
#include "sdf/script/script.h"
#include "timed.h"

namespace sdf::exporter {
namespace {

/// With --triangles: the first try has this share of the diagonal for its tolerance; each aims at this share
/// of the budget, and what is above the other will do. The tolerance changes by so much at most: a mesh of a
/// few triangles says little of others.
constexpr double kFirstTolerance = 1000.0, kAim = 0.95, kEnough = 0.9, kStep = 16.0;
constexpr int kTries = 6;
/// Of the tolerance: with --compress the rest is left to rounding.
constexpr double kBeforeRounding = 0.95;
constexpr std::string_view kStepsAreNotBaked =
    "ambient_occlusion: what counts steps depends on who looks and is not baked; take kind = 'taps'";

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

/// Parts that are meshed at the same time at most, which holds their bands of voxels together (the
/// sunflower's three parts: 300 MiB for 224). Simplifying is one thread's, for the most part. Uniform meshes
/// take all threads, and voxels of a size that was asked for may take all of the memory.
std::size_t mostBeside() {
  constexpr std::size_t kMost = 4;
  return std::min(kMost, tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace

Status FrameExport::load(double time, std::optional<double>& voxelSize, std::vector<std::string>& told) {
  report.time = time;
  report.total.name = "total";
  if (Status s = loadParts(time); !s) return s;
  tellNotes(told);
  if (Status s = chooseVoxelSize(voxelSize); !s) return s;
  loaded_ = report.total;
  return okStatus();
}

void FrameExport::tellNotes(std::vector<std::string>& told) const {
  std::vector<std::string> notes = scene.notes;
  std::erase_if(notes, [&](const std::string& note) { return std::ranges::find(told, note) != told.end(); });
  told.insert(told.end(), notes.begin(), notes.end());
  if (notes.empty() || options_.quiet) return;
  progress_.clear();
  printNotes(std::cerr, notes);
}

Status FrameExport::loadParts(double time) {
  progress_.setSubject(subject_);
  progress_.beginStage("script");
  const ScriptOptions script{
      .values = options_.parameters, .time = time, .fixed = true, .folders = options_.folders};
  Result<Scene> loaded = stage(report.total, "script", [&] { return loadScene(options_.scene, script); });
  if (!loaded) return loaded.error();
  for (const std::filesystem::path& target : targetsOf(options_))
    if (Status s = checkNotRead(target, loaded->files); !s) return s;
  Result<Scene> chosen = selected(std::move(*loaded), options_);
  if (!chosen) return chosen.error();
  scene = std::move(*chosen);
  clip = options_.bounds ? options_.bounds : scene.bounds;
  return interrupted();
}

// Also refuses parts that are unbounded, by their own names.
Status FrameExport::chooseVoxelSize(std::optional<double>& voxelSize) {
  progress_.beginStage("bounds");
  const auto size = stage(report.total, "bounds", [&] { return exportSize(scene.parts, clip, progress_); });
  if (!size) return size.error();
  diagonal_ = size->diagonal;
  if (!voxelSize) voxelSize = size->voxelSize;
  return okStatus();
}

Status FrameExport::mesh(const std::vector<Part>& bodies, double voxelSize, double tolerance) {
  report.total = loaded_;
  report.notes = scene.notes;
  report.warnings.clear();
  if (Status s =
          options_.triangles
              ? meshWithin(static_cast<std::size_t>(*options_.triangles), bodies, voxelSize)
              : meshAll(bodies, voxelSize, tolerance * (options_.toleranceOfDiagonal ? diagonal_ : 1.0));
      !s)
    return s;
  if (Status s = bake(); !s) return s;
  compressParts();
  return okStatus();
}

// Triangles grow about as the tolerance falls, so that some tries find the one that leaves few of the budget.
Status FrameExport::meshWithin(std::size_t triangles, const std::vector<Part>& bodies, double voxelSize) {
  const auto budget = static_cast<double>(triangles);
  struct Try {
    std::vector<ExportPart> parts;
    std::vector<ReportLine> lines;
  } best;
  double tolerance = diagonal_ / kFirstTolerance, coarsest = HUGE_VAL, finest = 0.0;
  std::size_t most = 0, fewest = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < kTries; ++i) {
    const Status meshed = meshAll(bodies, voxelSize, tolerance);
    if (!meshed && (meshed.error().kind != ErrorKind::Limits || (most == 0 && i + 1 == kTries)))
      return meshed;
    // A tolerance that cannot be kept is too fine whatever the number of triangles.
    const std::size_t count = meshed ? combined(parts).triangles : std::numeric_limits<std::size_t>::max();
    fewest = std::min(fewest, count);
    if (count <= triangles) {
      coarsest = std::min(coarsest, tolerance);
      if (count > most) most = count, best = {std::move(parts), std::move(report.parts)};
    } else {
      finest = std::max(finest, tolerance);
    }
    if (static_cast<double>(most) > kEnough * budget || (!meshed && most > 0)) break;
    tolerance *= std::clamp(static_cast<double>(count) / (kAim * budget), 1.0 / kStep, kStep);
    if (!(tolerance > finest && tolerance < coarsest)) {
      if (finest == 0.0 || !(coarsest < HUGE_VAL)) break;  // of flat faces, the same for any tolerance
      tolerance = std::sqrt(finest * coarsest);
    }
  }
  if (most == 0)
    return Error{ErrorKind::Limits,
                 "--triangles: " + std::to_string(triangles) +
                     " are too few for what is exported; the fewest that were reached are " +
                     std::to_string(fewest)};
  parts = std::move(best.parts);
  report.parts = std::move(best.lines);
  return okStatus();
}

Status FrameExport::meshAll(const std::vector<Part>& bodies, double voxelSize, double tolerance) {
  parts.clear();
  report.parts.clear();
  const std::size_t count = bodies.size();
  const bool isLight = tolerance > 0.0 && !options_.voxelSize;
  const MeshOptions options = meshOptions(voxelSize, tolerance);
  PartsProgress progress(progress_, count, [&](std::size_t i) {
    return subject_ + (subject_.empty() ? "" : ", ") + "part '" + bodies[i].name + "' (" +
           std::to_string(i + 1) + " of " + std::to_string(count) + ")";
  });
  std::vector<Made> made(count);
  const auto mesh = [&](std::size_t i) {
    made[i].shape = timed(
        made[i].seconds, [&] { return meshShape(bodies[i].shape, bodies[i].name, options, progress.of(i)); });
    made[i].peakMemory = peakMemory();
    releaseFreedMemory();  // a band of voxels is far larger than its mesh, and the next one comes on top
    if (!*made[i].shape) progress.stopAfter(i);
    progress.end(i);
  };
  timed(report.total.seconds, [&] { return inParallel(count, mesh, isLight ? mostBeside() : 1), 0; });
  for (std::size_t i = 0; i < count; ++i) {
    if (!*made[i].shape) return made[i].shape->error();
    take(bodies[i], tolerance, std::move(made[i]));
  }
  return interrupted();
}

void FrameExport::take(const Part& body, double tolerance, Made made) {
  ReportLine& line = report.parts.emplace_back();
  line.name = body.name;
  if (!isGltf(options_.output) && scene.parts.size() > 1)
    for (const Part& one : scene.parts) line.united.push_back(one.name);
  MeshedShape& shape = **made.shape;
  if (tolerance > 0.0) shape.stats.tolerance = tolerance;
  line.seconds = made.seconds;
  line.stages = std::move(shape.stageSeconds);
  line.stats = shape.stats;
  line.peakMemory = made.peakMemory;
  for (const auto& [name, seconds] : line.stages) addSeconds(report.total.stages, name, seconds);
  parts.push_back({body.name, std::move(shape.mesh), shape.stats});
}

Status FrameExport::bake() {
  if (!options_.bake || parts.empty()) return okStatus();
  progress_.setSubject(subject_);
  if (scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps)
    report.warnings.emplace_back(kStepsAreNotBaked);
  if (Status s = stage(report.total, "occlusion", [&] { return bakeAmbient(scene, clip, parts, progress_); });
      !s)
    return s;
  for (std::size_t i = 0; i < parts.size(); ++i) report.parts[i].ambientError = parts[i].ambient->error;
  return okStatus();
}

void FrameExport::compressParts() {
  if (!options_.compress) return;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    compress(parts[i]);
    report.parts[i].stats = parts[i].stats;
  }
}

Status FrameExport::write(const std::filesystem::path& target) {
  report.file = target;
  progress_.setSubject(subject_);
  progress_.beginStage("writing");
  if (Status s = stage(report.total, "writing", [&] { return writeMeshes(target, scene, parts); }); !s)
    return s;
  report.total.stats = combined(parts);
  report.total.peakMemory = peakMemory();
  return okStatus();
}

MeshOptions FrameExport::meshOptions(double voxelSize, double tolerance) const {
  return {.voxelSize = voxelSize,
          .tolerance = options_.compress ? kBeforeRounding * tolerance : tolerance,
          .strict = options_.strict && !options_.keepGoing,
          .keepsFiles = !options_.strict && !options_.levels,
          .bounds = clip,
          .certify = options_.certify,
          .maxMemory = options_.maxMemory};
}

Status FrameExport::interrupted() const {
  if (progress_.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
  return okStatus();
}

}  // namespace sdf::exporter
