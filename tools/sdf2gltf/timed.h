// How long work takes, for the report.
#pragma once
#include <chrono>
#include <string>
#include <type_traits>

#include "report.h"

namespace sdf::exporter {

/// Runs `work` and returns what it returned, adding how long it took.
template <class Work>
auto timed(double& seconds, Work work) {
  const auto began = std::chrono::steady_clock::now();
  auto result = work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

/// The same of work that is a stage of the total.
template <class Work>
std::invoke_result_t<Work> stage(ReportLine& total, const std::string& name, Work work) {
  double seconds = 0.0;
  auto result = timed(seconds, work);
  addSeconds(total.stages, name, seconds);
  total.seconds += seconds;
  return result;
}

}  // namespace sdf::exporter
