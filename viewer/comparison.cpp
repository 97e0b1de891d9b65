#include "viewer/comparison.h"

#include <algorithm>
#include <cmath>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

Result<double> millisecondsOf(Contender& way, const Target& target) {
  const auto start = Clock::now();
  if (const Status s = way.renderer.draw(way.frame, target); !s) return s.error();
  finish();
  return millisecondsSince(start);
}

// Alpha says what rays ran out of steps, and is not shown.
double rmsOf(const Picture& a, const Picture& b) {
  constexpr std::size_t kRgba = 4, kAlpha = 3;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) {
    if (i % kRgba == kAlpha) continue;
    const double apart = (a.bytes[i] - b.bytes[i]) / 255.0;
    squares += apart * apart;
  }
  return std::sqrt(squares / (static_cast<double>(kAlpha) * a.width * a.height));
}

}  // namespace

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Result<Compared> compare(Contender& one, Contender& other, int frames, const Target& target) {
  Contender* const ways[] = {&one, &other};
  std::vector<double> times[2];
  Picture pictures[2];
  for (int i = 0; i <= frames; ++i)
    for (int k = 0; k < 2; ++k) {
      const auto took = millisecondsOf(*ways[k], target);
      if (!took) return took.error();
      if (i > 0) times[k].push_back(*took);
      if (i < frames) continue;
      if (const Status s = keep(target.picture(), pictures[k]); !s) return s.error();
    }
  return Compared{median(times[0]), median(times[1]), rmsOf(pictures[0], pictures[1])};
}

}  // namespace sdf::viewer
