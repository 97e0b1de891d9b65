// The colours of a mesh that is being simplified, which are held to those of the surface.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/surface_paint.h"

namespace sdf {

/// The channels of a colour that are held, in some order.
using Tint = std::array<float, 6>;

/// Colours of corners, which lie beside the surface's like positions do, and of samples. A difference counts
/// as a distance: one of kColorTolerance as the tolerance.
class Tints {
 public:
  /// Colours are not held.
  Tints() = default;
  /// Channels that are the same in all of these are not held, nor is ambient light that equals the colour.
  Tints(const std::vector<Paint>& paint, float tolerance);

  bool any() const { return channels_ > 0; }
  std::size_t channels() const { return channels_; }
  Tint of(const Paint& paint) const;
  CornerColor colorOf(const Tint& linear) const;

  /// A sample of this colour, or of one that is not known.
  void addSample(const Paint* paint);
  bool isKnown(std::uint32_t sample) const { return !std::isnan(perceived_[sample][0]); }
  /// As perceived.
  const Tint& sample(std::uint32_t sample) const { return perceived_[sample]; }
  /// The distance that a colour's difference from the sample's counts as; 0 where that is not known.
  float distance(std::uint32_t sample, const Tint& linear) const;
  /// The difference that counts as a distance, and the distance that a difference counts as.
  float difference(float distance) const { return distance / unit_; }
  float distance(float difference) const { return difference * unit_; }

  std::vector<Tint> corners;  ///< linear; by half-edge, of its first vertex in its triangle

 private:
  std::size_t channels_ = 0;
  std::array<int, 6> which_{};  // of a paint's channels, by own
  std::array<int, 6> from_{};   // the own, of each of a paint's channels; -1: it is always the same
  Tint always_{};               // by a paint's channels
  float unit_ = 1.0f;
  std::vector<Tint> perceived_;  // by sample; not a number where it is not known
};

inline float Tints::distance(std::uint32_t sample, const Tint& linear) const {
  const Tint& own = perceived_[sample];
  if (std::isnan(own[0])) return 0.0f;
  float most = 0.0f;
  for (std::size_t k = 0; k < channels_; ++k)
    most = std::max(most, std::abs(perceived(std::max(linear[k], 0.0f)) - own[k]));
  return unit_ * most;
}

/// What corners with these weights show.
inline Tint mixed(const Tint& a, const Tint& b, const Tint& c, const glm::vec3& weights) {
  Tint t;
  for (std::size_t k = 0; k < t.size(); ++k) t[k] = weights.x * a[k] + weights.y * b[k] + weights.z * c[k];
  return t;
}

}  // namespace sdf
