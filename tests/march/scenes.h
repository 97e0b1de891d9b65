// Scenes whose first hits are known, rays through them, and what every method shares.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "sdf/march/march.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {

inline constexpr MarchMethod kMethods[] = {MarchMethod::Plain,       MarchMethod::OverRelaxed,
                                           MarchMethod::Accelerated, MarchMethod::AutoRelaxed,
                                           MarchMethod::Segment,     MarchMethod::Bisection};
inline const char* name(MarchMethod m) {
  const char* names[] = {"plain", "over-relaxed", "accelerated", "auto-relaxed", "segment", "bisection"};
  return names[static_cast<int>(m)];
}
inline bool marchesBalls(MarchMethod m) { return m < MarchMethod::Segment; }

/// A shape with its true distance and the first root on a ray, both computed another way.
struct AnalyticScene {
  const char* name;
  Shape shape;
  std::function<double(const glm::dvec3&)> distance;
  std::function<std::optional<double>(const glm::dvec3& o, const glm::dvec3& d)> firstRoot;
};

// Smaller root of t^2 + 2 b t + c.
inline std::optional<double> smallerRoot(double b, double c) {
  const double inside = b * b - c;
  if (inside < 0.0) return std::nullopt;
  const double root = -b - std::sqrt(inside);
  return root >= 0.0 ? std::optional(root) : std::nullopt;
}

inline std::optional<double> enterBox(const glm::dvec3& half, const glm::dvec3& o, const glm::dvec3& d) {
  double first = 0.0, last = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const double a = (-half[i] - o[i]) / d[i], b = (half[i] - o[i]) / d[i];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last ? std::optional(first) : std::nullopt;
}

// By small steps of the double distance, halved to rounding. Passes what is thinner than a step.
inline std::optional<double> searchRoot(const std::function<double(double)>& f, double tMax) {
  constexpr double kStep = 1.0 / 1024.0;
  for (double t = 0.0; t <= tMax; t += kStep) {
    if (f(t) > 0.0) continue;
    double before = std::max(0.0, t - kStep), after = t;
    while (after - before > 0x1p-45) {
      const double middle = 0.5 * (before + after);
      (f(middle) > 0.0 ? before : after) = middle;
    }
    return after;
  }
  return std::nullopt;
}

inline std::vector<AnalyticScene> analyticScenes(double tMax) {
  const auto ring = [](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.z) - 1.0, p.y) - 0.3; };
  return {{"sphere", sphere(1.0), [](const glm::dvec3& p) { return glm::length(p) - 1.0; },
           [](const glm::dvec3& o, const glm::dvec3& d) {
             return smallerRoot(glm::dot(o, d), glm::dot(o, o) - 1.0);
           }},
          {"plane", plane(Vec3E(0, 1, 0), -3.0), [](const glm::dvec3& p) { return p.y + 3.0; },
           [](const glm::dvec3& o, const glm::dvec3& d) {
             return d.y < 0.0 ? std::optional((-3.0 - o.y) / d.y) : std::nullopt;
           }},
          {"box", box(Vec3E(0.8, 0.5, 0.3)),
           [](const glm::dvec3& p) {
             const glm::dvec3 q = glm::abs(p) - glm::dvec3(0.8, 0.5, 0.3);
             return glm::length(glm::max(q, 0.0)) + std::min(0.0, std::max({q.x, q.y, q.z}));
           },
           [](const glm::dvec3& o, const glm::dvec3& d) {
             return enterBox({0.8, 0.5, 0.3}, o, d);
           }},
          {"torus", torus(1.0, 0.3), ring, [=](const glm::dvec3& o, const glm::dvec3& d) {
             return searchRoot([&](double t) { return ring(o + t * d); }, tMax);
           }}};
}

/// Rays from a sphere of this radius towards points near the centre.
inline Rays raysInward(int count, double radius, double tMax, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> near(-1.2, 1.2);
  Rays rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from =
        radius * glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
    rays.add(from, glm::normalize(glm::dvec3{near(random), near(random), near(random)} - from), 0.0, tMax);
  }
  return rays;
}

inline std::string describe(const Rays& rays, std::size_t i) {
  const glm::dvec3 o = rays.origin[i], d = rays.direction[i];
  char text[200];
  std::snprintf(text, sizeof text, "ray %zu: from (%.17g, %.17g, %.17g) along (%.17g, %.17g, %.17g)", i, o.x,
                o.y, o.z, d.x, d.y, d.z);
  return text;
}

/// Hits of a marcher that must work.
inline Hits trace(const MarchField& field, const Rays& rays, const MarchOptions& options) {
  Result<Marcher> marcher = Marcher::make(field, options);
  if (!marcher) {
    ADD_FAILURE() << marcher.error().message;
    return {};
  }
  Result<Hits> hits = marcher->trace(rays);
  if (!hits) {
    ADD_FAILURE() << hits.error().message;
    return {};
  }
  return *hits;
}
inline Hits trace(const Shape& shape, const Rays& rays, const MarchOptions& options) {
  return trace(marchField(shape).value(), rays, options);
}

/// Float values that the marcher does not read again in double are off by at most 2^-18 of the coordinates.
inline double floatSlack(double largestCoordinate) { return 0x1p-18 * largestCoordinate; }

}  // namespace sdf::test
