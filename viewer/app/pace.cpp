#include "viewer/app/pace.h"

#include <algorithm>
#include <cmath>

namespace sdf::viewer {

// Slower frames count at once, so that one slow frame is followed by a fast one; faster ones by half, so that
// the resolution does not jump about.
void Pace::drew(double seconds, double rays) {
  const double whole = seconds / rays;
  wholeFrame_ = whole > wholeFrame_ ? whole : 0.5 * (wholeFrame_ + whole);
}

double Pace::scale() const {
  if (wholeFrame_ <= kBudget) return 1.0;
  const double halvings = std::ceil(std::log2(wholeFrame_ / kBudget));  // of the pixels
  return std::max(std::exp2(-0.5 * halvings), kCoarsest);
}

}  // namespace sdf::viewer
