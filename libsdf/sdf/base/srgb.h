// The sRGB curve (IEC 61966-2-1), both ways.
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

namespace sdf {

/// Linear light as sRGB, 0 to 255; NaN counts as 0.
inline std::uint8_t srgb(float linear) {
  const float v = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  const float shown = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(shown * 255.0f));
}

/// The linear light of sRGB, where 1 is white.
template <std::floating_point T>
T linearOf(T srgb) {
  return srgb <= T(0.04045) ? srgb / T(12.92) : std::pow((srgb + T(0.055)) / T(1.055), T(2.4));
}

/// The linear light of an sRGB byte.
inline float linearOf(std::uint8_t srgb) { return linearOf(static_cast<float>(srgb) / 255.0f); }

}  // namespace sdf
