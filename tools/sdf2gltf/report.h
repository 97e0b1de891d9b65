// What was made and what it took, for people and for programs.
#pragma once
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "options.h"
#include "sdf/expr/expr.h"
#include "sdf/mesh/mesh.h"

namespace sdf::exporter {

/// Names of stages with their seconds, in the order they ran.
using StageSeconds = std::vector<std::pair<std::string, double>>;
/// Adds to the stage of that name, or appends it.
void addSeconds(StageSeconds& stages, const std::string& name, double seconds);

struct ReportLine {
  std::string name;
  std::vector<std::string> united;  ///< the scene's parts that this one unites; empty where it is one of them
  MeshStats stats;
  StageSeconds stages;
  double seconds = 0.0;
  double peakMemory = 0.0;              ///< bytes, of the process up to when this was done
  std::optional<float> ambientError{};  ///< AmbientLight::error, where light was baked
};

/// One moment of an animation.
struct FrameReport {
  double time = 0.0;
  std::vector<std::pair<std::string, std::size_t>>
      meshes;  ///< the parts that are there, with their places in the report
};

/// One written file.
struct FileReport {
  std::filesystem::path file;
  double time = 0.0;
  std::vector<ReportLine> parts;
  std::vector<FrameReport> frames;    ///< of an animation
  std::vector<std::string> notes;     ///< of the scene (Scene::notes)
  std::vector<std::string> warnings;  ///< of the whole file
  ReportLine total;                   ///< with the stages that belong to no part: script, bounds, writing
};

/// A table of the file's parts and their total.
void printTable(std::ostream& out, const FileReport& report);

/// A warning for each note.
void printNotes(std::ostream& out, const std::vector<std::string>& notes);

/// A line for each warning but for notes, and for each part whose mesh or light is known to miss something.
void printWarnings(std::ostream& out, const FileReport& report);

/// Everything as JSON. `parameters` are the values that the scene ran with.
std::string reportJson(const Options& options, const std::vector<ParameterInfo>& parameters,
                       const std::vector<FileReport>& files);

}  // namespace sdf::exporter
