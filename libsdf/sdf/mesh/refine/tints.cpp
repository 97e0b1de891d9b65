#include "sdf/mesh/refine/tints.h"

#include <algorithm>
#include <limits>

namespace sdf {
namespace {

constexpr int kHalf = 3;  // channels of the colour, and as many of the ambient light
// Below it channels are the same: a tenth of a byte's step.
constexpr float kSame = 1.0f / 2560;

// Samples are held to this share of what is allowed: between them it is some more.
constexpr float kSamplesHeldTo = 0.9f;

float channelOf(const Paint& paint, int k) { return k < kHalf ? paint.color[k] : paint.ambient[k - kHalf]; }

}  // namespace

Tints::Tints(const std::vector<Paint>& paint, float tolerance)
    : unit_(tolerance / (kSamplesHeldTo * kColorTolerance)) {
  from_.fill(-1);
  if (paint.empty()) return;
  for (int k = 0; k < 2 * kHalf; ++k) {
    always_[k] = channelOf(paint[0], k);
    const auto isAlways = [&](const Paint& p) {
      return std::abs(perceived(channelOf(p, k)) - perceived(always_[k])) < kSame;
    };
    const auto isAsColor = [&](const Paint& p) { return channelOf(p, k) == channelOf(p, k - kHalf); };
    if (std::ranges::all_of(paint, isAlways)) continue;
    if (k >= kHalf && from_[k - kHalf] >= 0 && std::ranges::all_of(paint, isAsColor)) {
      from_[k] = from_[k - kHalf];
    } else {
      from_[k] = static_cast<int>(channels_);
      which_[channels_++] = k;
    }
  }
}

Tint Tints::of(const Paint& paint) const {
  Tint t{};
  for (std::size_t k = 0; k < channels_; ++k) t[k] = channelOf(paint, which_[k]);
  return t;
}

CornerColor Tints::colorOf(const Tint& linear) const {
  CornerColor c;
  for (int k = 0; k < kHalf; ++k) {
    const auto at = [&](int channel) {
      return from_[channel] < 0 ? always_[channel] : std::max(linear[from_[channel]], 0.0f);
    };
    c.color[k] = std::min(at(k), 1.0f), c.ambient[k] = at(k + kHalf);
  }
  return c;
}

void Tints::addSample(const Paint* paint) {
  Tint t{};
  t[0] = std::numeric_limits<float>::quiet_NaN();
  if (paint) {
    t = of(*paint);
    for (float& v : t) v = perceived(v);
  }
  perceived_.push_back(t);
}

}  // namespace sdf
