// Medians of every benchmark, and the figures made of them.
#pragma once
#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace sdf::bench {

/// Prints as Google Benchmark does, and keeps each benchmark's median.
class Medians : public benchmark::ConsoleReporter {
 public:
  Medians() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override;
  /// Median wall-clock seconds of one iteration; NaN if the benchmark did not run.
  double seconds(const std::string& name) const { return find(seconds_, name); }
  /// The same of the main thread's processor time, which other programs disturb less.
  double threadSeconds(const std::string& name) const { return find(threadSeconds_, name); }

 private:
  using Times = std::map<std::string, double>;
  static double find(const Times& times, const std::string& name);

  Times seconds_, threadSeconds_;
};

/// Registers a benchmark of wall-clock time, of which only medians and the like are reported.
template <class Run>
benchmark::internal::Benchmark* addBenchmark(const std::string& name, int repetitions, Run run) {
  return benchmark::RegisterBenchmark(name.c_str(), std::move(run))
      ->UseRealTime()
      ->Repetitions(repetitions)
      ->ReportAggregatesOnly();
}

/// A number that was asked for, and what was measured.
struct Figure {
  std::string what;
  bool atLeast = false;  ///< measured must reach `asked`; else it must not exceed it
  double asked = 0.0;
  double measured = 0.0;

  bool ok() const { return atLeast ? measured >= asked : measured <= asked; }
};

/// The processor, the cores in use, the instruction set and the memory.
std::string machine();
/// Prints a table; true if every figure is met.
bool printFigures(const std::vector<Figure>& figures);

}  // namespace sdf::bench
