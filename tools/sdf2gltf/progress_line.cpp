#include "progress_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sdf::exporter {
namespace {

constexpr std::chrono::milliseconds kBetweenDraws(100);
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

void ProgressLine::setSubject(std::string subject) {
  std::lock_guard lock(mutex_);
  subject_ = std::move(subject);
}

void ProgressLine::beginStage(std::string_view name) {
  if (!shown_) return;
  std::lock_guard lock(mutex_);
  stage_ = name;
  stageBegan_ = Clock::now();
  draw(0.0);
}

void ProgressLine::update(double fraction) {
  if (!shown_ || Clock::now().time_since_epoch().count() < nextDraw_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) draw(fraction);
}

void ProgressLine::clear() {
  if (!shown_) return;
  std::lock_guard lock(mutex_);
  std::fputs(kEmptyLine, stderr);
}

void ProgressLine::draw(double fraction) {
  const auto now = Clock::now();
  nextDraw_.store((now + kBetweenDraws).time_since_epoch().count(), std::memory_order_relaxed);
  const double share = std::clamp(fraction, 0.0, 1.0);
  std::string line = kEmptyLine + subject_ + (subject_.empty() ? "" : ": ") + stage_;
  if (share > 0.0) line += " " + std::to_string(static_cast<int>(share * 100.0)) + " %";
  if (share > 0.0 && now - stageBegan_ > kBeforeEstimate) {
    const double taken = std::chrono::duration<double>(now - stageBegan_).count();
    line += ", " + duration(taken * (1.0 - share) / share) + " left";
  }
  std::fputs(line.c_str(), stderr);
}

}  // namespace sdf::exporter
