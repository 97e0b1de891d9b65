#include "report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "command_line/text.h"
#include "sdf/base/version.h"

namespace sdf::exporter {
namespace {

// Keeps the order in which things are said, as people read reports too.
using Json = nlohmann::ordered_json;

constexpr double kMiB = 1024.0 * 1024.0;
/// Of linear light: some steps of a byte of sRGB in the dark, one in the middle.
constexpr float kSeenError = 0.01f;

using command_line::formatted, command_line::grouped;

/// A bound is rounded up.
std::string bound(double value) { return formatted("%.2e", 1.005 * value); }

/// With a tolerance and a proven distance where those of the whole file say so.
std::vector<std::string> row(const ReportLine& line, const MeshStats& total) {
  std::vector<std::string> cells{line.name};
  if (total.tolerance > 0.0) cells.push_back(formatted("%.2e", line.stats.tolerance));
  cells.push_back(grouped(line.stats.triangles));
  cells.push_back(formatted("%.2e", line.stats.rmsDistance));
  cells.push_back(formatted("%.2e", line.stats.maxDistance));
  if (total.provenDistance > 0.0) cells.push_back(bound(line.stats.provenDistance));
  cells.push_back(formatted("%.2f s", line.seconds));
  cells.push_back(formatted("%.0f MiB", line.peakMemory / kMiB));
  return cells;
}

std::string place(const glm::vec3& p) {
  return "(" + formatted("%.4g", p.x) + ", " + formatted("%.4g", p.y) + ", " + formatted("%.4g", p.z) + ")";
}

/// Two digits.
std::string roundedDown(double positive) {
  const double digit = std::pow(10.0, std::floor(std::log10(positive)) - 1.0);
  return formatted("%.2g", std::floor(positive / digit) * digit);
}

Json placeJson(const auto& p) { return {p.x, p.y, p.z}; }
Json placeJson(std::uint64_t count, const glm::vec3& first) {
  return count == 0 ? Json(nullptr) : placeJson(first);
}

Json json(const ReportLine& line) {
  Json stages = Json::object();
  for (const auto& [name, seconds] : line.stages) stages[name] = seconds;
  const MeshStats& stats = line.stats;
  return {{"name", line.name},
          {"united", line.united},
          {"seconds", line.seconds},
          {"stage_seconds", stages},
          {"peak_memory_bytes", static_cast<std::uint64_t>(line.peakMemory)},
          {"voxel_size", stats.voxelSize},
          {"tolerance", stats.tolerance > 0.0 ? Json(stats.tolerance) : Json(nullptr)},
          {"voxels", stats.voxels},
          {"vertices", stats.vertices},
          {"triangles", stats.triangles},
          {"rms_distance", stats.rmsDistance},
          {"max_distance", stats.maxDistance},
          {"surface_points", stats.surfacePoints},
          {"proven_distance", stats.provenDistance > 0.0 ? Json(stats.provenDistance) : Json(nullptr)},
          {"farthest", placeJson(stats.farthest)},
          {"watertight", stats.watertight},
          {"manifold", stats.manifold},
          {"self_intersections", stats.crossings},
          {"first_self_intersection", placeJson(stats.crossings, stats.firstCrossing)},
          {"components", stats.components},
          {"euler_characteristic", stats.eulerCharacteristic},
          {"area", stats.area},
          {"volume", stats.watertight ? Json(stats.volume) : Json(nullptr)},
          {"centre_of_mass", stats.watertight ? placeJson(stats.centreOfMass) : Json(nullptr)},
          {"unresolved", stats.unresolved},
          {"first_unresolved", placeJson(stats.unresolved, stats.firstUnresolved)},
          {"resolving_voxel_size", stats.resolvingVoxel > 0.0 ? Json(stats.resolvingVoxel) : Json(nullptr)},
          {"not_numbers", stats.notNumbers},
          {"first_not_number", placeJson(stats.notNumbers, stats.firstNotNumber)},
          {"ambient_error", line.ambientError ? Json(*line.ambientError) : Json(nullptr)}};
}

/// Both with two digits, or with as many as tell them apart.
std::pair<std::string, std::string> shownApart(double a, double b) {
  constexpr int kMost = 9;
  for (int digits = 2;; ++digits) {
    std::pair<std::string, std::string> texts{formatted("%.*g", digits, a), formatted("%.*g", digits, b)};
    if (texts.first != texts.second || digits == kMost) return texts;
  }
}

/// Does what was missed show in the distances? Where solids touch or cross, what is between them is thinner
/// than any voxel, and nothing is lost.
bool isLost(const MeshStats& stats) {
  return stats.maxDistance > (stats.tolerance > 0.0 ? stats.tolerance : 0.5 * stats.voxelSize);
}

std::string finer(const MeshStats& stats) {
  return "--voxel-size " + formatted("%.2g", 0.5 * stats.voxelSize);
}

std::string unresolvedWarning(const MeshStats& stats) {
  const std::string what = "solids or gaps thinner than a voxel were missed, the first near " +
                           place(stats.firstUnresolved) + "; ";
  if (stats.resolvingVoxel == 0.0) return what + finer(stats) + " may see them";
  if (stats.resolvingVoxel >= kFinestAdvised * stats.voxelSize)
    return what + "take --voxel-size " + roundedDown(stats.resolvingVoxel) + " to see them";
  return what + "make them thicker than " + formatted("%.2g", std::numbers::sqrt3 * stats.voxelSize) +
         ", or let what touches there overlap";
}

std::vector<std::string> warningsOf(const ReportLine& line) {
  const MeshStats& stats = line.stats;
  std::vector<std::string> warnings;
  if (stats.unresolved > 0 && isLost(stats)) warnings.push_back(unresolvedWarning(stats));
  if (stats.tolerance > 0.0 && stats.maxDistance > stats.tolerance) {
    const auto [tolerance, off] = shownApart(stats.tolerance, stats.maxDistance);
    warnings.push_back("the tolerance of " + tolerance + " is not kept everywhere: " + off + " off near " +
                       place(stats.farthest) + "; " + finer(stats) + " may keep it there");
  }
  if (stats.crossings > 0)
    warnings.push_back("the mesh intersects itself in " + grouped(stats.crossings) +
                       " pairs of triangles, the first near " + place(stats.firstCrossing) + "; " +
                       finer(stats) + " may part them");
  if (stats.notNumbers > 0)
    warnings.push_back("the distance is not a number at " + grouped(stats.notNumbers) +
                       " samples, the first near " + place(stats.firstNotNumber) +
                       "; they were taken as outside. Check for divisions by zero, roots and logarithms of "
                       "negative numbers");
  if (line.ambientError.value_or(0.0f) > kSeenError)
    warnings.push_back("the baked ambient light is off by up to " + formatted("%.2g", *line.ambientError) +
                       ": a primitive's emission holds the blends of two colours, and this part's ambient "
                       "colours are of more; give the colours materials of their own, or light them by "
                       "ambient(color) in the place of background_light");
  return warnings;
}

}  // namespace

void addSeconds(StageSeconds& stages, const std::string& name, double seconds) {
  const auto found =
      std::find_if(stages.begin(), stages.end(), [&](const auto& stage) { return stage.first == name; });
  if (found == stages.end()) {
    stages.emplace_back(name, seconds);
  } else {
    found->second += seconds;
  }
}

void printNotes(std::ostream& out, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) out << "sdf2gltf: warning: " << note << '\n';
}

void printWarnings(std::ostream& out, const FileReport& report) {
  printNotes(out, report.warnings);
  for (const ReportLine& line : report.parts)
    for (const std::string& warning : warningsOf(line))
      out << "sdf2gltf: warning: part '" << line.name << "': " << warning << '\n';
}

void printTable(std::ostream& out, const FileReport& report) {
  const MeshStats& total = report.total.stats;
  std::vector<std::vector<std::string>> rows{
      {"part", "triangles", "rms error", "max error", "time", "peak memory"}};
  if (total.provenDistance > 0.0) rows[0].insert(rows[0].begin() + 4, "proven");
  if (total.tolerance > 0.0) rows[0].insert(rows[0].begin() + 1, "tolerance");
  for (const ReportLine& part : report.parts) rows.push_back(row(part, total));
  rows.push_back(row(report.total, total));

  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& cells : rows) {
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], cells[c].size());
  }
  out << report.file.string() << '\n';
  for (const auto& cells : rows) {
    out << "  " << cells[0] << std::string(widths[0] - cells[0].size(), ' ');
    for (std::size_t c = 1; c < cells.size(); ++c)
      out << "  " << std::string(widths[c] - cells[c].size(), ' ') << cells[c];
    out << '\n';
  }
}

std::string reportJson(const Options& options, const std::vector<ParameterInfo>& parameters,
                       const std::vector<FileReport>& files) {
  Json values = Json::object();
  for (const ParameterInfo& parameter : parameters) values[parameter.name] = parameter.value;
  Json outputs = Json::array();
  for (const FileReport& file : files) {
    Json parts = Json::array();
    for (const ReportLine& part : file.parts) parts.push_back(json(part));
    Json frames = Json::array();
    for (const FrameReport& frame : file.frames) {
      Json meshes = Json::object();
      for (const auto& [part, place] : frame.meshes) meshes[part] = place;
      frames.push_back({{"time", frame.time}, {"meshes", meshes}});
    }
    std::vector<std::string> warnings = file.notes;
    warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
    outputs.push_back({{"file", file.file.string()},
                       {"time", file.time},
                       {"parts", parts},
                       {"total", json(file.total)},
                       {"frames", frames},
                       {"warnings", warnings}});
  }
  const Json report{{"generator", std::string("sdf2gltf ") + version()},
                    {"scene", options.scene.string()},
                    {"parameters", values},
                    {"outputs", outputs}};
  // Names are bytes to us; what is not UTF-8 in them is replaced.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sdf::exporter
