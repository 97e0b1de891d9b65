// From results.csv to charts, by the scripts in charts/, which node runs.
#pragma once
#include <filesystem>
#include <string>

#include "sdf/base/result.h"

namespace sdf::chart {

/// Where the scripts and npm's packages are.
struct Drawing {
  std::filesystem::path scripts;   ///< the folder of draw.mjs
  std::filesystem::path packages;  ///< the folder of node_modules
};

/// Measured, but node or its packages are missing, or the drawing failed.
inline constexpr int kNotDrawn = 7;

/// A default is behind the Pareto front.
inline constexpr int kBehind = 8;

/// Holds the defaults in folder/results.csv to the Pareto front (charts/check.mjs, which prints those behind
/// it). Empty, or what is wrong, and the exit status for it.
struct Checked {
  std::string wrong;
  int status = 0;
};
Checked checkDefaults(const Drawing& drawing, const std::filesystem::path& folder);

/// Draws the charts of folder/results.csv beside it. The text is empty, or says why nothing was drawn and
/// what to do.
std::string drawCharts(const Drawing& drawing, const std::filesystem::path& folder);

}  // namespace sdf::chart
