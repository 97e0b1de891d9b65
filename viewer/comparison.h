// One picture drawn in two ways, by turns.
#pragma once
#include <chrono>
#include <vector>

#include "viewer/render/renderer.h"

namespace sdf::viewer {

/// A Contender is a renderer and the frame that it draws.
struct Contender {
  Renderer renderer;
  Frame frame;
};

/// Compared is what two ways cost, and how far apart their pictures are.
struct Compared {
  double milliseconds;       ///< a frame of the one, the median
  double otherMilliseconds;  ///< of the other
  double rms;                ///< of the differences of red, green and blue, 0 to 1, as they are shown
};

using Clock = std::chrono::steady_clock;
/// Returns how long ago that was.
double millisecondsSince(Clock::time_point start);

/// The value in the middle, of an even number the upper one; at least one.
double median(std::vector<double> values);

/// Draws one frame of each after the other, this many times after a first one that is not counted: what else
/// the machine does meets both alike. Errors: as Renderer::draw.
Result<Compared> compare(Contender& one, Contender& other, int frames, const Target& target);

}  // namespace sdf::viewer
