// Curves to try, and points of them.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "sdf/outline/arc.h"
#include "sdf/outline/outline.h"

namespace sdf::test {

/// By the polynomials of Bernstein, not by halving as the library does.
inline glm::dvec2 pointOf(const glm::dvec2& from, const Curve& c, double t) {
  const double s = 1.0 - t;
  if (c.controls == 0) return s * from + t * c.to;
  if (c.controls == 1) return s * s * from + 2.0 * s * t * c.control[0] + t * t * c.to;
  return s * s * s * from + 3.0 * s * s * t * c.control[0] + 3.0 * s * t * t * c.control[1] +
         t * t * t * c.to;
}

/// `count` points of each curve, one after the other, and of the line that closes them.
inline std::vector<glm::dvec2> pointsOf(const Contour& contour, int count) {
  std::vector<glm::dvec2> points;
  glm::dvec2 at = contour.from;
  for (const Curve& c : contour.curves) {
    for (int i = 0; i < count; ++i) points.push_back(pointOf(at, c, static_cast<double>(i) / count));
    at = c.to;
  }
  for (int i = 0; i <= count; ++i)
    points.push_back(glm::mix(at, contour.from, static_cast<double>(i) / count));
  return points;
}

/// The same of an arc, by its turning.
inline std::vector<glm::dvec2> pointsOf(const Arc& arc, int count) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= count; ++i) {
    const double s = arc.size * i / count, half = 0.5 * arc.curvature * s;
    const double chord = half == 0.0 ? s : s * std::sin(half) / half;
    const glm::dvec2 left(-arc.along.y, arc.along.x);
    points.push_back(arc.from + chord * (std::cos(half) * arc.along + std::sin(half) * left));
  }
  return points;
}

inline glm::dvec2 anyPoint(std::mt19937& random, double size = 1.0) {
  std::uniform_real_distribution<double> any(-size, size);
  const double x = any(random);
  return {x, any(random)};
}

/// A contour of lines and curves of all kinds through random points.
inline Contour randomContour(std::mt19937& random, int curves) {
  Contour contour{anyPoint(random)};
  for (int i = 0; i < curves; ++i) {
    Curve c;
    c.controls = static_cast<int>(random() % 3);
    c.control[0] = anyPoint(random), c.control[1] = anyPoint(random), c.to = anyPoint(random);
    contour.curves.push_back(c);
  }
  return contour;
}

/// Two cubics for each half: off a circle by 3e-4 of its radius.
inline Contour roundContour(const glm::dvec2& centre, double radius, bool counterClockwise = true) {
  constexpr double k = 0.5522847498;
  const double side = counterClockwise ? 1.0 : -1.0;
  const auto at = [&](double x, double y) { return centre + radius * glm::dvec2(x, side * y); };
  return {at(1, 0),
          {{2, {at(1, k), at(k, 1)}, at(0, 1)},
           {2, {at(-k, 1), at(-1, k)}, at(-1, 0)},
           {2, {at(-1, -k), at(-k, -1)}, at(0, -1)},
           {2, {at(k, -1), at(1, -k)}, at(1, 0)}}};
}

inline Contour boxContour(const glm::dvec2& lo, const glm::dvec2& hi) {
  return {lo, {{0, {}, {hi.x, lo.y}}, {0, {}, hi}, {0, {}, {lo.x, hi.y}}, {0, {}, lo}}};
}

/// How often the chain of points goes around p, by the angles between them.
inline int windingOf(const std::vector<glm::dvec2>& points, const glm::dvec2& p) {
  double angle = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec2 a = points[i] - p, b = points[(i + 1) % points.size()] - p;
    angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
  }
  return static_cast<int>(std::lround(angle / (2.0 * 3.14159265358979323846)));
}

}  // namespace sdf::test
