#include "run_progress.h"

#include <cmath>
#include <cstdio>

namespace sdf::chart {
namespace {

constexpr const char* kEmptyLine = "\r\x1b[K";  // ECMA-48: erase to the end of the line

std::string duration(double seconds) {
  const auto s = static_cast<long>(std::ceil(seconds));
  if (s < 90) return std::to_string(s) + " s";
  return std::to_string((s + 30) / 60) + " min";
}

}  // namespace

void RunProgress::begin(std::size_t batches, double weight) {
  batches_ = batches;
  whole_ = weight;
  began_ = Clock::now();
}

void RunProgress::beginBatch(const std::string& subject) {
  ++number_;
  if (!shown_) return;
  std::string line = subject + " (" + std::to_string(number_) + " of " + std::to_string(batches_) + ")";
  if (done_ > 0.0) {
    const double taken = std::chrono::duration<double>(Clock::now() - began_).count();
    line += ", about " + duration(taken * (whole_ - done_) / done_) + " left";
  }
  std::fputs(terminal_ ? (kEmptyLine + line).c_str() : (line + '\n').c_str(), stderr);
}

void RunProgress::endBatch(double weight) { done_ += weight; }

void RunProgress::clear() {
  if (shown_ && terminal_) std::fputs(kEmptyLine, stderr);
}

}  // namespace sdf::chart
