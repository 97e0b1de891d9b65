// The scene at one moment, meshed.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "command_line/progress_line.h"
#include "options.h"
#include "report.h"
#include "sdf/export/export.h"
#include "sdf/mesh/mesher.h"

namespace sdf::exporter {

using command_line::ProgressLine;

/// Takes a scene from its script to meshes, step by step, and keeps what each step took in its report.
/// `subject` begins what the progress line says. Options and progress outlive it.
class FrameExport {
 public:
  FrameExport(const Options& options, ProgressLine& progress, std::string subject)
      : options_(options), progress_(progress), subject_(std::move(subject)) {}

  /// Runs the script at this time and fills `scene` and `clip`. Warns of the scene's notes at once, but for
  /// those that are told, to which they come. Of the bounds it makes the voxel size, if that is none yet.
  /// Errors: the scene's, also those of parts without bounds.
  Status load(double time, std::optional<double>& voxelSize, std::vector<std::string>& told);
  /// Meshes the bodies into `parts`, in the place of what is there, with this tolerance (in the
  /// units of Options::tolerance) or with as many triangles as are asked for; bakes their light and
  /// compresses them, if that is asked for.
  Status mesh(const std::vector<Part>& bodies, double voxelSize, double tolerance);
  /// Writes `parts` to a file.
  Status write(const std::filesystem::path& target);

  FileReport report;
  Scene scene;
  std::optional<Box> clip;  ///< what bodies are cut to
  std::vector<ExportPart> parts;

 private:
  /// What became of a part.
  struct Made {
    std::optional<Result<MeshedShape>> shape;
    double seconds = 0.0;
    double peakMemory = 0.0;
  };
  Status loadParts(double time);
  void tellNotes(std::vector<std::string>& told) const;
  Status chooseVoxelSize(std::optional<double>& voxelSize);
  Status meshAll(const std::vector<Part>& bodies, double voxelSize, double tolerance);
  Status meshWithin(std::size_t triangles, const std::vector<Part>& bodies, double voxelSize);
  void take(const Part& body, double tolerance, Made made);
  Status bake();
  void compressParts();
  MeshOptions meshOptions(double voxelSize, double tolerance) const;
  Status interrupted() const;

  const Options& options_;
  ProgressLine& progress_;
  std::string subject_;
  ReportLine loaded_;      // what loading took
  double diagonal_ = 0.0;  // of the bounds of all parts
};

}  // namespace sdf::exporter
