// One measurement, as it stands in a line of results.csv.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace sdf::chart {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What was measured, and what came of it. A figure that the kind of measurement does not have is kNone, an
/// empty cell.
struct Row {
  std::string kind{};     ///< "meshing", "marching" …
  std::string scene{};    ///< "ball", or a scene file's name
  std::string method{};   ///< "uniform", "Plain" …
  std::string setting{};  ///< "64 voxels", "epsilon 0.001, 512 steps" …
  double size = kNone;    ///< the number in the setting that the chart's lines go along

  double isDefault = 0.0;                       ///< 1: what the programs take where nothing is said
  double seconds = kNone;                       ///< median of the runs, of `items` items together, wall clock
  double quartile1 = kNone, quartile3 = kNone;  ///< of the runs' seconds
  double runs = kNone;
  double items = kNone;        ///< rays, points, normals …; 1 for a mesh
  double evaluations = kNone;  ///< readings of the field by item
  double rms = kNone;          ///< root mean square error, in the kind's unit
  double max = kNone;          ///< largest error
  double normal = kNone;       ///< root mean square error of the shading normals, degrees
  double missed = kNone;       ///< share of the rays that should hit and did not
  double falseHits = kNone;    ///< share of the rays that should not hit and did
  double proven = kNone;       ///< proven bound on the error, where one was asked for
  double truth = kNone;        ///< what the error figures themselves may be off by
  double triangles = kNone;
  double bytes = kNone;   ///< of the mesh as a .glb file
  double memory = kNone;  ///< most bytes beyond what the program held before

  std::string verdict{};      ///< of a known failure: "holds", "degrades" or "fails"
  std::string status = "ok";  ///< or "failed: why"
  std::string machine{};

  /// Of light on the ground: what the method and the truth give (groundPicture), and how many points a side.
  std::string picture{}, truePicture{};
  int pictureSide = 0;

  bool failed() const { return status != "ok"; }
  /// What no two rows share.
  std::string key() const { return kind + '\n' + scene + '\n' + method + '\n' + setting; }
};

/// The columns, in the file's order: texts and numbers by their names there.
struct TextColumn {
  const char* name;
  std::string Row::*cell;
};
struct NumberColumn {
  const char* name;
  double Row::*cell;
};
inline constexpr std::array kKeyColumns{TextColumn{"kind", &Row::kind}, TextColumn{"scene", &Row::scene},
                                        TextColumn{"method", &Row::method},
                                        TextColumn{"setting", &Row::setting}};
inline constexpr std::array kNumberColumns{NumberColumn{"size", &Row::size},
                                           NumberColumn{"default", &Row::isDefault},
                                           NumberColumn{"seconds", &Row::seconds},
                                           NumberColumn{"seconds_q1", &Row::quartile1},
                                           NumberColumn{"seconds_q3", &Row::quartile3},
                                           NumberColumn{"runs", &Row::runs},
                                           NumberColumn{"items", &Row::items},
                                           NumberColumn{"evaluations", &Row::evaluations},
                                           NumberColumn{"error_rms", &Row::rms},
                                           NumberColumn{"error_max", &Row::max},
                                           NumberColumn{"error_normal_deg", &Row::normal},
                                           NumberColumn{"missed", &Row::missed},
                                           NumberColumn{"false_hits", &Row::falseHits},
                                           NumberColumn{"proven", &Row::proven},
                                           NumberColumn{"error_of_truth", &Row::truth},
                                           NumberColumn{"triangles", &Row::triangles},
                                           NumberColumn{"file_bytes", &Row::bytes},
                                           NumberColumn{"memory_bytes", &Row::memory}};
inline constexpr std::array kLastColumns{TextColumn{"verdict", &Row::verdict},
                                         TextColumn{"status", &Row::status},
                                         TextColumn{"machine", &Row::machine}};

/// Errors as they come: their root mean square, and the largest.
class ErrorSum {
 public:
  void add(double error) {
    squares_ += error * error;
    largest_ = std::max(largest_, error);
    ++count_;
  }
  /// Fills both figures in; they stay empty where there was no error.
  void giveTo(Row& row) const {
    if (count_ == 0) return;
    row.rms = std::sqrt(squares_ / static_cast<double>(count_));
    row.max = largest_;
  }

 private:
  double squares_ = 0.0, largest_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace sdf::chart
