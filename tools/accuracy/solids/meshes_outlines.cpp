#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "meshes.h"

namespace sdf::accuracy {
namespace {

constexpr int kOutlineQuarter = 512;  // steps to a right angle: a chord of 1.2e-6 radii

glm::dvec2 fromUp(double distance, double angle) {
  return {distance * std::sin(angle), distance * std::cos(angle)};
}

// The outline of a band that covers its centre, or the outer and inner one of a band whose ends meet, seen
// from the centre: up to `angle` the band's edges, beyond it where the ray crosses the circle about the last
// point of the arc. Half of it, from +y to -y; the other half mirrors it, since what one end covers of the
// other's side that has covered already.
void addHalf(Outline& outline, double angle, double radius, double half, double side) {
  for (int k = 0; k <= 2 * kOutlineQuarter; ++k)
    outline.points.push_back(fromUp(radius + side * half, angle * k / (2 * kOutlineQuarter)));
  outline.chord = (radius + half) * (1.0 - std::cos(0.25 * angle / kOutlineQuarter));
  const glm::dvec2 end = fromUp(radius, angle);
  for (int k = 1; k <= 2 * kOutlineQuarter; ++k) {
    const double by = (kPi - angle) * k / (2 * kOutlineQuarter), off = radius * std::sin(by);
    const double reach = radius * std::cos(by) + side * std::sqrt(half * half - off * off);
    glm::dvec2 p = fromUp(reach, angle + by);
    if (k == 2 * kOutlineQuarter) p.x = 0.0;
    // Both points on the circle: their chord's middle is where it leaves the circle farthest.
    outline.chord = std::max(outline.chord, half - glm::length(0.5 * (p + outline.points.back()) - end));
    outline.points.push_back(p);
  }
}

Outline seenFromCentre(double angle, double radius, double half, double side) {
  Outline outline;
  addHalf(outline, angle, radius, half, side);
  for (std::size_t i = outline.points.size() - 2; i > 0; --i)
    outline.points.emplace_back(-outline.points[i].x, outline.points[i].y);
  outline.special = {{0, 0},
                     {0, radius},
                     fromUp(radius, angle),
                     fromUp(radius, -angle),
                     outline.points[4 * kOutlineQuarter]};
  return outline;
}

}  // namespace

Outline circleOutline(double radius) {
  Outline outline;
  return outline.arc({0, 0}, radius, 0.0, 2.0 * kPi, 4 * kOutlineQuarter);
}

// The image of a circle's chords: distances grow by the larger radius at most.
Outline stretched(Outline outline, double radiusX, double radiusY) {
  const double most = std::max(radiusX, radiusY);
  for (glm::dvec2& p : outline.points) p *= glm::dvec2(radiusX, radiusY);
  outline.chord *= most;
  const double focus = std::sqrt(std::abs(radiusX * radiusX - radiusY * radiusY));
  const glm::dvec2 way = radiusX > radiusY ? glm::dvec2(1, 0) : glm::dvec2(0, 1);
  // The medial axis ends at focus^2 / most.
  outline.special = {{0, 0}, {radiusX, 0}, {0, radiusY}, way * focus, way * (focus * focus / most)};
  return outline;
}

Outline ellipseOutline(double radiusX, double radiusY) {
  return stretched(circleOutline(1.0), radiusX, radiusY);
}

Outline halfEllipseOutline(double radiusX, double radiusY) {
  Outline half;
  return stretched(half.arc({0, 0}, 1.0, -0.5 * kPi, 0.5 * kPi, 2 * kOutlineQuarter), radiusX, radiusY);
}

Outline rectangleOutline(double halfWidth, double halfHeight, double radius) {
  const double x = halfWidth - radius, y = halfHeight - radius;
  Outline outline;
  if (radius == 0.0) return outline.to({-x, -y}).to({x, -y}).to({x, y}).to({-x, y});
  outline.arc({x, -y}, radius, -0.5 * kPi, 0.0, kOutlineQuarter)
      .arc({x, y}, radius, 0.0, 0.5 * kPi, kOutlineQuarter);
  return outline.arc({-x, y}, radius, 0.5 * kPi, kPi, kOutlineQuarter)
      .arc({-x, -y}, radius, kPi, 1.5 * kPi, kOutlineQuarter);
}

Outline segmentOutline(const glm::dvec2& from, const glm::dvec2& to, double radius) {
  const double way = std::atan2(to.y - from.y, to.x - from.x);
  Outline outline;
  outline.arc(to, radius, way - 0.5 * kPi, way + 0.5 * kPi, 2 * kOutlineQuarter);
  return outline.arc(from, radius, way + 0.5 * kPi, way + 1.5 * kPi, 2 * kOutlineQuarter);
}

Outline starOutline(int points, double outer, double inner) {
  Outline outline;
  for (int k = 0; k < points; ++k) {
    outline.to(fromUp(outer, 2.0 * kPi * k / points));
    if (inner > 0.0) outline.to(fromUp(inner, 2.0 * kPi * (k + 0.5) / points));
  }
  outline.special.push_back({0, 0});
  return outline;
}

Outline polygonOutline(std::span<const glm::dvec2> points) {
  Outline outline;
  for (const glm::dvec2& p : points) outline.to(p);
  return outline;
}

Tessellation bentBand(double angle, double radius, double half) {
  const bool covers = half >= radius;
  const bool meets = !covers && angle > 0.5 * kPi && radius * std::sin(angle) < half;
  if (covers) return extruded(seenFromCentre(angle, radius, half, 1.0));
  if (meets)
    return extrudedBand(seenFromCentre(angle, radius, half, 1.0), seenFromCentre(angle, radius, half, -1.0));
  const double from = 0.5 * kPi - angle, to = 0.5 * kPi + angle;
  const auto end = [&](double at) { return radius * glm::dvec2(std::cos(at), std::sin(at)); };
  const int along = std::max(2, static_cast<int>(std::ceil(4 * kOutlineQuarter * angle / kPi)));
  Outline outline;
  outline.arc({0, 0}, radius + half, from, to, along).arc(end(to), half, to, to + kPi, 2 * kOutlineQuarter);
  outline.arc({0, 0}, radius - half, to, from, along)
      .arc(end(from), half, from + kPi, from + 2.0 * kPi, 2 * kOutlineQuarter);
  return extruded(outline);
}

}  // namespace sdf::accuracy
