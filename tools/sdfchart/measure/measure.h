// How measurements are taken: in batches whose members take turns, so that what disturbs the machine disturbs
// all of them alike.
#pragma once
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "accuracy/take.h"
#include "command_line/text.h"
#include "sdfchart/results.h"
#include "sdfchart/run_progress.h"

namespace sdf::chart {

using command_line::formatted;

/// One cell of the matrix.
struct Measurement {
  Row row;  ///< key, size and default are given; the rest is measured
  /// Runs it once, and returns the seconds that what is timed took. On the first run `judged` is the row
  /// whose error figures are to be filled in, else null. Throws std::exception where it fails.
  std::function<double(Row* judged)> run;
};

/// Measurements that take turns.
struct Batch {
  std::string subject{};  ///< for the progress line: "meshing ball"
  double weight = 1.0;    ///< about how many seconds it takes
  int runs = 5;           ///< of each, no more than this many
  double budget = 5.0;    ///< seconds of all runs; a measurement that has taken its share is not run again
  bool together = false;  ///< one run serves all: they are run again until their sum is the budget
  std::function<std::vector<Measurement>()> make{};
};

/// Runs what `results` does not have yet, and appends a row for each; one that fails has a status that says
/// why. Rows are written in the batch's order, each as soon as those before it have ended. Errors: Files,
/// Interrupted.
Status runBatches(const std::vector<Batch>& batches, Results& results, const std::string& machine,
                  RunProgress& progress);

/// The p-th part of the sorted values, between two of them linearly. Precondition: there are some.
double quantile(std::vector<double> values, double p);

/// Seconds that work() takes.
template <class Work>
double secondsOf(const Work& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

/// Seconds of one of as many work() as take some milliseconds: for what is too short to be timed alone.
template <class Work>
double secondsOfShort(const Work& work) {
  constexpr double kLongEnough = 4e-3;
  double seconds = secondsOf(work);
  for (int count = 1; seconds < kLongEnough;) {
    count = seconds * 8.0 < kLongEnough ? count * 4 : count * 2;
    seconds = secondsOf([&] {
      for (int i = 0; i < count; ++i) work();
    });
    if (seconds >= kLongEnough) return seconds / count;
  }
  return seconds;
}

}  // namespace sdf::chart
