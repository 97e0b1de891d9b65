// A line on the terminal that says what is being done and how long it will take.
#pragma once
#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "sdf/base/progress.h"

namespace sdf::exporter {

/// Shows "part 'body' (2 of 5): sampling 43 %, 12 s left" on stderr, redrawn in place; silent unless `shown`.
class ProgressLine : public Progress {
 public:
  explicit ProgressLine(bool shown) : shown_(shown) {}

  /// What the coming stages belong to, e.g. "part 'body' (2 of 5)"; may be empty.
  void setSubject(std::string subject);
  void beginStage(std::string_view name) override;
  void update(double fraction) override;
  /// Empties the line, so that other output can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double fraction);

  const bool shown_;
  std::mutex mutex_;
  std::string subject_, stage_;
  Clock::time_point stageBegan_ = Clock::now();
  std::atomic<Clock::rep> nextDraw_{0};
};

}  // namespace sdf::exporter
