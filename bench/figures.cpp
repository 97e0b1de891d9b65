#include "figures.h"

#include <cstdio>
#include <limits>

#include "machine.h"

namespace sdf::bench {

void Medians::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.aggregate_name != "median" || run.aggregate_unit != benchmark::StatisticUnit::kTime) continue;
    const double unit = benchmark::GetTimeUnitMultiplier(run.time_unit);
    seconds_[run.run_name.function_name] = run.GetAdjustedRealTime() / unit;
    threadSeconds_[run.run_name.function_name] = run.GetAdjustedCPUTime() / unit;
  }
  ConsoleReporter::ReportRuns(runs);
}

double Medians::find(const Times& times, const std::string& name) {
  const auto it = times.find(name);
  return it == times.end() ? std::numeric_limits<double>::quiet_NaN() : it->second;
}

bool printFigures(const std::vector<Figure>& figures) {
  bool all = true;
  std::printf("\n%s\n%-64s %10s %10s\n", machine().c_str(), "figure", "asked", "measured");
  for (const Figure& f : figures) {
    std::printf("%-64s %s %7.4g %10.4g  %s\n", f.what.c_str(), f.atLeast ? ">=" : "<=", f.asked, f.measured,
                f.ok() ? "ok" : "MISS");
    all = all && f.ok();
  }
  return all;
}

}  // namespace sdf::bench
