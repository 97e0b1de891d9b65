// The colours of distances between a mesh and its scene.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace sdf::viewer {

/// Colours as they are shown, sRGB: of distances evenly from the limit on the inner side to the limit on the
/// outer one ("RdBu" of Brewer, Harrower, ColorBrewer, 2003), and at either end that of what is beyond.
// clang-format off
inline constexpr std::array<glm::vec3, 11> kErrorColors{{
    {0.00f, 0.90f, 0.90f},
    {0.129f, 0.400f, 0.675f}, {0.263f, 0.576f, 0.765f}, {0.573f, 0.773f, 0.871f}, {0.820f, 0.898f, 0.941f},
    {0.969f, 0.969f, 0.969f},
    {0.992f, 0.859f, 0.780f}, {0.957f, 0.647f, 0.510f}, {0.839f, 0.376f, 0.302f}, {0.698f, 0.094f, 0.169f},
    {1.00f, 0.85f, 0.00f},
}};
// clang-format on

/// The colour of a distance, in limits: what parts::kErrorView shows of a surface that faces the eye.
inline glm::vec3 errorColor(double share) {
  constexpr std::size_t kSteps = kErrorColors.size() - 3;
  if (share < -1.0) return kErrorColors.front();
  if (share > 1.0) return kErrorColors.back();
  const double place = 1.0 + 0.5 * (share + 1.0) * kSteps;
  const std::size_t below = std::min(static_cast<std::size_t>(place), kSteps);
  return glm::mix(kErrorColors[below], kErrorColors[below + 1],
                  static_cast<float>(place - static_cast<double>(below)));
}

}  // namespace sdf::viewer
