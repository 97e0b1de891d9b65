#include "command_line/progress_line.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <utility>

namespace sdf::command_line {
namespace {

constexpr std::chrono::milliseconds kBetweenDraws(100);
/// Where nothing is redrawn: before the first line, and between two.
constexpr std::chrono::milliseconds kBeforeLine(900), kBetweenLines(10'000);
/// Before that, the time a stage has taken so far says little about the time it will take.
constexpr std::chrono::milliseconds kBeforeEstimate(500);
constexpr const char* kEmptyLine = "\r\x1b[K";  // ECMA-48: erase to the end of the line

std::string duration(double seconds) {
  const auto s = static_cast<long>(std::ceil(seconds));
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
}

}  // namespace

ProgressLine::Shown ProgressLine::shownOn(bool quiet) {
  return quiet ? Shown::Nowhere : ::isatty(STDERR_FILENO) == 1 ? Shown::InPlace : Shown::InLines;
}

ProgressLine::~ProgressLine() {
  {
    std::lock_guard lock(mutex_);
    ended_ = true;
  }
  end_.notify_one();
  if (watcher_.joinable()) watcher_.join();
}

void ProgressLine::setSubject(std::string subject) {
  std::lock_guard lock(mutex_);
  subject_ = std::move(subject);
}

void ProgressLine::beginStage(std::string_view name) {
  if (shown_ == Shown::Nowhere) return;
  std::lock_guard lock(mutex_);
  stage_ = name;
  stageBegan_ = Clock::now();
  share_ = 0.0;
  if (shown_ == Shown::InPlace) draw();
  if (watcher_.joinable()) return;
  try {
    watcher_ = std::thread([this] { watch(); });
  } catch (const std::system_error&) {  // no memory for one: update draws alone
  }
}

void ProgressLine::update(double fraction) {
  share_.store(fraction, std::memory_order_relaxed);
  if (shown_ != Shown::InPlace ||
      Clock::now().time_since_epoch().count() < nextDraw_.load(std::memory_order_relaxed))
    return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) draw();
}

void ProgressLine::clear() {
  if (shown_ == Shown::Nowhere) return;
  std::lock_guard lock(mutex_);
  stage_.clear();
  if (shown_ == Shown::InPlace) std::fputs(kEmptyLine, stderr);
}

// Draws where nobody calls update.
void ProgressLine::watch() {
  const auto first = shown_ == Shown::InPlace ? kBeforeEstimate : kBeforeLine;
  const auto between = shown_ == Shown::InPlace ? kBeforeEstimate : kBetweenLines;
  std::unique_lock lock(mutex_);
  for (auto wait = first; !end_.wait_for(lock, wait, [this] { return ended_; }); wait = between) draw();
}

void ProgressLine::draw() {
  if (stage_.empty()) return;
  const auto now = Clock::now();
  nextDraw_.store((now + kBetweenDraws).time_since_epoch().count(), std::memory_order_relaxed);
  const auto seconds = [&](Clock::time_point since) {
    return std::chrono::duration<double>(now - since).count();
  };
  const double share = std::clamp(share_.load(std::memory_order_relaxed), 0.0, 1.0),
               taken = seconds(stageBegan_);
  std::string line = subject_ + (subject_.empty() ? "" : ": ") + stage_;
  if (share > 0.0) line += " " + std::to_string(static_cast<int>(share * 100.0)) + " %";
  if (now - stageBegan_ > kBeforeEstimate)
    line += ", " +
            (share > 0.0 ? duration(taken * (1.0 - share) / share) + " left" : duration(taken) + " so far");
  if (shown_ == Shown::InPlace)
    line = kEmptyLine + line;
  else
    line = program_ + ": after " + duration(seconds(began_)) + ": " + line + "\n";
  std::fputs(line.c_str(), stderr);
}

}  // namespace sdf::command_line
