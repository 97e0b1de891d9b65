// Ending on Ctrl-C and on being told to, soon and without leaving anything behind.
#pragma once
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "sdf/base/file.h"
#include "sdf/base/progress.h"

namespace sdf::exporter {

/// While it lives, SIGINT, SIGTERM and SIGHUP stop `progress` and abandon the files being written. Work that
/// does not end by itself soon after is ended with the process (status 130). Make it before any other thread,
/// which then leaves these signals to it.
class InterruptWatch {
 public:
  explicit InterruptWatch(Progress& progress);
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  void watch();

  Progress& progress_;
  std::mutex mutex_;
  std::condition_variable finished_;
  bool done_ = false;
  std::optional<AbandonedWrites> abandoned_;
  std::thread thread_;
};

}  // namespace sdf::exporter
