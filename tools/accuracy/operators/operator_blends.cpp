#include "operator_blends.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sdf::accuracy {
namespace {

// Quilez, "smooth minimum" (2013), as a mixture: the weight h of b, less what rounds the corner.
double quadratic(double a, double b, double k) {
  const double h = std::clamp(0.5 + 0.5 * (a - b) / k, 0.0, 1.0);
  return a + h * (b - a) - k * h * (1.0 - h);
}

double cubic(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6.0;
}

double exponential(double a, double b, double k) {
  const double least = std::min(a, b);
  return least - k * std::log(std::exp((least - a) / k) + std::exp((least - b) / k));
}

double chamfer(double a, double b, double k) { return std::min({a, b, 0.5 * (a + b - k)}); }

}  // namespace

// Curvatures: quadratic 1 / 2k where it bends; cubic (k - |a - b|) / k^2; exponential w (1 - w) / k for its
// weight w; a chamfer is flat but for its two edges.
const std::array<Smooth, 4> kSmooths{{
    {Blend::Kind::Quadratic, "quadratic", quadratic, 1.0 / 4.0, 0.5},
    {Blend::Kind::Cubic, "cubic", cubic, 1.0 / 6.0, 1.0},
    {Blend::Kind::Exponential, "exponential", exponential, std::numbers::ln2, 0.25},
    {Blend::Kind::Chamfer, "chamfer", chamfer, 0.5, 0.0},
}};

}  // namespace sdf::accuracy
