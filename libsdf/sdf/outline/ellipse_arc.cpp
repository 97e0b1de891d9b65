#include "sdf/outline/ellipse_arc.h"

#include <algorithm>
#include <cmath>
#include <glm/mat2x2.hpp>
#include <numbers>

namespace sdf {
namespace {

// Of one curve, in radians: it is off by 2.7e-4 (angle / 90 degrees)^6 of the radius.
constexpr double kMostTurn = std::numbers::pi / 8.0;

glm::dvec2 onUnitCircle(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace

// In the plane in which the ellipse is the unit circle.
std::vector<Curve> curvesOf(const glm::dvec2& from, const EllipseArc& arc) {
  if (from == arc.to) return {};
  glm::dvec2 radii(std::abs(arc.radii.x), std::abs(arc.radii.y));
  if (radii.x == 0.0 || radii.y == 0.0) return {{0, {}, arc.to}};
  const glm::dvec2 axis = onUnitCircle(arc.turn * std::numbers::pi / 180.0);
  const glm::dmat2 turn(axis, glm::dvec2(-axis.y, axis.x));
  const glm::dvec2 chord = (arc.to - from) * turn;  // by the axes
  const double reach = 0.5 * std::hypot(chord.x / radii.x, chord.y / radii.y);
  if (reach > 1.0) radii *= reach;
  const glm::dvec2 half = 0.5 * chord / radii;
  const double square = half.x * half.x + half.y * half.y;
  const double away =
      std::sqrt(std::max(0.0, 1.0 - square) / square) * (arc.isLarge == arc.isPositive ? -1.0 : 1.0);
  const glm::dvec2 centre = away * glm::dvec2(-half.y, half.x);  // from the chord's middle
  const glm::dvec2 start = -half - centre, end = half - centre;
  const double first = std::atan2(start.y, start.x);
  double sweep = std::atan2(end.y, end.x) - first;
  if (arc.isPositive && sweep < 0.0) sweep += 2.0 * std::numbers::pi;
  if (!arc.isPositive && sweep > 0.0) sweep -= 2.0 * std::numbers::pi;

  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / kMostTurn - 1e-9)));
  const double step = sweep / count, handle = 4.0 / 3.0 * std::tan(0.25 * step);
  const glm::dvec2 middle = 0.5 * (from + arc.to);
  const auto placed = [&](const glm::dvec2& p) { return middle + turn * (radii * (p + centre)); };
  std::vector<Curve> curves;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 a = onUnitCircle(first + i * step), b = onUnitCircle(first + (i + 1) * step);
    curves.push_back(
        {2,
         {placed(a + handle * glm::dvec2(-a.y, a.x)), placed(b - handle * glm::dvec2(-b.y, b.x))},
         i + 1 == count ? arc.to : placed(b)});
  }
  return curves;
}

}  // namespace sdf
