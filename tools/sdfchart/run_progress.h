// Where a run is, and how long it will take.
#pragma once
#include <atomic>
#include <chrono>
#include <string>

#include "sdf/base/progress.h"

namespace sdf::chart {

/// Shows "meshing ball (3 of 20), 40 %, about 2 min left" on stderr, redrawn in place on a terminal, else a
/// line for each batch; silent unless `shown`. Measuring functions are handed it as their Progress.
class RunProgress : public Progress {
 public:
  RunProgress(bool shown, bool terminal) : shown_(shown), terminal_(terminal) {}
  /// The weight of all that will be done.
  void begin(std::size_t batches, double weight);
  void beginBatch(const std::string& subject);
  void endBatch(double weight);
  /// What was there already takes no time now, and says nothing of the time that is left.
  void skip(double weight) { whole_ -= weight, ++number_; }
  /// Was the program told to end? For work on other threads; endRun() is safe to call in a signal handler.
  static bool toldToEnd() { return told().load(std::memory_order_relaxed); }
  static void endRun() { told().store(true, std::memory_order_relaxed); }
  /// Empties the line, so that other output can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  static std::atomic<bool>& told() {
    static constinit std::atomic<bool> flag{false};
    return flag;
  }
  const bool shown_, terminal_;
  std::size_t batches_ = 0, number_ = 0;
  double whole_ = 0.0, done_ = 0.0;
  Clock::time_point began_ = Clock::now();
};

}  // namespace sdf::chart
