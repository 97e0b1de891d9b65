// The scene at one moment, meshed.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "progress_line.h"
#include "report.h"
#include "sdf/gltf/export.h"
#include "sdf/mesh/mesher.h"

namespace sdf::exporter {

/// Takes a scene from its script to meshes, step by step, and keeps what each step took in its report.
/// `subject` begins what the progress line says. Options and progress outlive it.
class FrameExport {
 public:
  FrameExport(const Options& options, ProgressLine& progress, std::string subject)
      : options_(options), progress_(progress), subject_(std::move(subject)) {}

  /// Runs the script at this time and fills `scene` and `clip`; of the bounds it makes the voxel size, if
  /// that is none yet. Errors: the scene's, also those of parts without bounds.
  Status load(double time, std::optional<double>& voxelSize);
  /// Meshes the bodies into `parts`, bakes their light and compresses them, if that is asked for.
  Status mesh(const std::vector<Part>& bodies, double voxelSize);
  /// Writes `parts` to a file.
  Status write(const std::filesystem::path& target);

  FileReport report;
  Scene scene;
  std::optional<Box> clip;  ///< what bodies are cut to
  std::vector<ExportPart> parts;

 private:
  Status loadParts(double time);
  Status chooseVoxelSize(std::optional<double>& voxelSize);
  Status meshOne(const Part& body, double voxelSize);
  Status bake();
  void compressParts();
  MeshOptions meshOptions(double voxelSize) const;
  Status interrupted() const;

  const Options& options_;
  ProgressLine& progress_;
  std::string subject_;
};

}  // namespace sdf::exporter
