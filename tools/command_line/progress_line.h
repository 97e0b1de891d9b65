// A line that says what is being done and how long it will take.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "sdf/base/progress.h"

namespace sdf::command_line {

/// Says "part 'body' (2 of 5): sampling 43 %, 12 s left" on stderr. On a terminal the line is redrawn in
/// place, elsewhere there is one after the first second and one every ten seconds then. Where a stage's share
/// is not known, it says for how long it has been going on.
class ProgressLine : public Progress {
 public:
  enum class Shown { Nowhere, InPlace, InLines };
  /// How it is shown on this stderr, if at all.
  static Shown shownOn(bool quiet);

  /// Lines begin with the program's name.
  ProgressLine(std::string program, Shown shown) : program_(std::move(program)), shown_(shown) {}
  ~ProgressLine() override;

  /// What the coming stages belong to, e.g. "part 'body' (2 of 5)"; may be empty.
  void setSubject(std::string subject);
  /// From the first stage on a thread of its own draws, too: make what watches signals before.
  void beginStage(std::string_view name) override;
  void update(double fraction) override;
  /// Empties the line and says nothing until the next stage, so that other output can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void watch();
  void draw();

  const std::string program_;
  const Shown shown_;
  std::mutex mutex_;
  std::string subject_, stage_;
  Clock::time_point began_ = Clock::now(), stageBegan_ = began_;
  std::atomic<double> share_{0.0};
  std::atomic<Clock::rep> nextDraw_{0};
  bool ended_ = false;
  std::condition_variable end_;
  std::thread watcher_;
};

}  // namespace sdf::command_line
