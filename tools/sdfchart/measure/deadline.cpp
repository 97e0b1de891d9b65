#include "deadline.h"

#include "command_line/text.h"

namespace sdf::chart {

Deadline::Deadline(double seconds)
    : seconds_(seconds), thread_([this] {
        constexpr std::chrono::milliseconds kBetweenLooks(50);
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds_);
        std::unique_lock lock(mutex_);
        while (!ended_.wait_for(lock, kBetweenLooks, [this] { return done_; }))
          if (std::chrono::steady_clock::now() > end || RunProgress::toldToEnd()) return stop();
      }) {}

Deadline::~Deadline() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Deadline::check() const {
  if (stopped())
    throw std::runtime_error(command_line::formatted("stopped: it took more than %g s", seconds_));
}

}  // namespace sdf::chart
