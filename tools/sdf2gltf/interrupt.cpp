#include "interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <string_view>

#include "sdf/base/result.h"

namespace sdf::exporter {
namespace {

/// How long stopped work may take to end: with it the program is gone within a second of the signal.
constexpr std::chrono::milliseconds kGrace(600);

sigset_t watchedSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  struct sigaction hangUp;
  // Under nohup, hanging up is to be ignored.
  if (::sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN) sigaddset(&signals, SIGHUP);
  return signals;
}

}  // namespace

InterruptWatch::InterruptWatch(Progress& progress) : progress_(progress) {
  const sigset_t signals = watchedSignals();
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  thread_ = std::thread([this] { watch(); });
}

InterruptWatch::~InterruptWatch() {
  {
    std::lock_guard lock(mutex_);
    done_ = true;
  }
  finished_.notify_one();
  ::pthread_kill(thread_.native_handle(), SIGTERM);  // wakes it, should it still wait for a signal
  thread_.join();
}

void InterruptWatch::watch() {
  const sigset_t signals = watchedSignals();
  int received = 0;
  ::sigwait(&signals, &received);
  std::unique_lock lock(mutex_);
  if (done_) return;
  progress_.stop();
  abandoned_.emplace();
  if (finished_.wait_for(lock, kGrace, [this] { return done_; })) return;
  constexpr std::string_view kMessage = "\nsdf2gltf: interrupted\n";
  [[maybe_unused]] const ssize_t told = ::write(STDERR_FILENO, kMessage.data(), kMessage.size());
  ::_exit(static_cast<int>(ErrorKind::Interrupted));
}

}  // namespace sdf::exporter
