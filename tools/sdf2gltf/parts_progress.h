// What is said of parts that are meshed beside one another.
#pragma once
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "command_line/progress_line.h"

namespace sdf::exporter {

/// Each part has a progress of its own; the line shows that of the first part that is not done. All are
/// stopped when the line is. Thread-safe.
class PartsProgress {
 public:
  /// `subject(part)` is what the line calls a part. The line outlives this.
  PartsProgress(command_line::ProgressLine& line, std::size_t parts,
                std::function<std::string(std::size_t)> subject);

  Progress& of(std::size_t part) { return parts_[part]; }
  /// The part is meshed, or not to be.
  void end(std::size_t part);
  /// Stops all parts that come after this one.
  void stopAfter(std::size_t part);

 private:
  struct Part : Progress {
    Part(PartsProgress& all, std::size_t number);
    void beginStage(std::string_view name) override;
    void update(double fraction) override;

    PartsProgress& all;
    const std::size_t number;
    std::string stage;  // empty: none has begun
    double share = 0.0;
    bool ended = false;
  };
  void show();

  command_line::ProgressLine& line_;
  const std::function<std::string(std::size_t)> subject_;
  std::mutex mutex_;
  std::size_t shown_ = 0;
  std::deque<Part> parts_;
};

}  // namespace sdf::exporter
