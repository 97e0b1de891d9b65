// Work that may not take for ever.
#pragma once
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "sdfchart/run_progress.h"

namespace sdf::chart {

/// A Progress that stops its work after so many seconds, and soon after the whole run is told to end.
class Deadline : public Progress {
 public:
  explicit Deadline(double seconds);
  ~Deadline() override;
  /// Throws std::runtime_error, which says so, where the time was up.
  void check() const;

 private:
  const double seconds_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace sdf::chart
