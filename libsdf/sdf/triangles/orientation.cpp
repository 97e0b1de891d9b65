// Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates.
#include "sdf/triangles/orientation.h"

#include <array>
#include <cmath>

#include "sdf/triangles/twofold.h"

namespace sdf {
namespace {

int sign(double v) { return (v > 0.0) - (v < 0.0); }

/// The sign of a sum without any rounding: each term is added to parts that do not overlap.
int signOfSum(const std::array<double, 6>& terms) {
  std::array<double, 6> parts;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    double rest = terms[i];
    for (std::size_t k = 0; k < i; ++k) {
      const Twofold sum = twofoldSum(rest, parts[k]);
      rest = sum.high;
      parts[k] = sum.low;
    }
    parts[i] = rest;
  }
  for (std::size_t i = parts.size(); i-- > 0;)
    if (parts[i] != 0.0) return sign(parts[i]);
  return 0;
}

}  // namespace

int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  const double ax = a.x, ay = a.y, bx = b.x, by = b.y, cx = c.x, cy = c.y;
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), difference = left - right;
  constexpr double kRounding = 4.0 * 0x1p-53;  // Shewchuk's bound is a little over 3 of these
  if (std::abs(difference) > kRounding * (std::abs(left) + std::abs(right))) return sign(difference);
  // A double holds the product of two floats.
  return signOfSum({ax * by, -ax * cy, bx * cy, -bx * ay, cx * ay, -cx * by});
}

}  // namespace sdf
