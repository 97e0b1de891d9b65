// Progress of long work: it reports its stage and share, and is asked to stop.
#pragma once
#include <atomic>
#include <string_view>

namespace sdf {

/// Long-running functions take a Progress&, call it often, and return an Interrupted error once `stop` is
/// set. Thread-safe: workers poll `stopped`, one thread at a time reports.
class Progress {
 public:
  /// With a `whole` that this is a part of: it is stopped when the whole is.
  explicit Progress(const Progress* whole = nullptr) : whole_(whole) {}
  virtual ~Progress() = default;
  /// A stage of the work begins ("sampling", "extracting" …).
  virtual void beginStage(std::string_view /*name*/) {}
  /// Share of the current stage that is done, 0 to 1. May be called from any thread.
  virtual void update(double /*fraction*/) {}

  void stop() { stop_.store(true, std::memory_order_relaxed); }
  bool stopped() const { return stop_.load(std::memory_order_relaxed) || (whole_ && whole_->stopped()); }

 private:
  const Progress* whole_;
  std::atomic<bool> stop_{false};
};

}  // namespace sdf
