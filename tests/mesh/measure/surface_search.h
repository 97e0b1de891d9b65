// A search for a surface in double, by nothing but values: what is measured of meshes is held to it.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/mesher.h"

namespace sdf::test {

using Random = std::mt19937_64;

inline double between(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}
inline int below(Random& random, int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); }

// A search in double, by nothing but values.
class Search {
 public:
  explicit Search(const Expr& e) : tape_(Function({e}).at()) {}

  double value(const glm::dvec3& p) const { return evaluate(*tape_, p); }

  // How far along the ray the sign is another one, `reach` where it stays.
  double along(const glm::dvec3& p, const glm::dvec3& way, double reach) const {
    constexpr int kSteps = 32;
    const bool inside = value(p) < 0.0;
    for (int k = 1; k <= kSteps; ++k)
      if ((value(p + reach * k / kSteps * way) < 0.0) != inside) {
        double lo = reach * (k - 1) / kSteps, hi = reach * k / kSteps;
        for (int i = 0; i < 40; ++i) {
          const double mid = 0.5 * (lo + hi);
          ((value(p + mid * way) < 0.0) == inside ? lo : hi) = mid;
        }
        return hi;
      }
    return reach;
  }

  // The distance to where the sign changes; no more than the reach, and too large by some per cent at most
  // where what is nearest is a tip.
  double nearest(const glm::dvec3& p, double reach, Random& random) const {
    constexpr int kDirections = 300, kRounds = 4, kAround = 40;
    double least = reach;
    glm::dvec3 best(1, 0, 0);
    const auto look = [&](const glm::dvec3& way) {
      if (const double d = along(p, way, least); d < least) least = d, best = way;
    };
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kDirections, turn = i * 2.399963229728653;
      const double r = std::sqrt(1.0 - z * z);
      look({r * std::cos(turn), r * std::sin(turn), z});
    }
    double spread = 0.15;
    for (int round = 0; round < kRounds; ++round, spread *= 0.4) {
      const glm::dvec3 middle = best;
      for (int i = 0; i < kAround; ++i) {
        const glm::dvec3 aside{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
        look(glm::normalize(middle + spread * aside));
      }
    }
    return least;
  }

 private:
  TapePtr tape_;
};

inline glm::dvec3 pointIn(const Box& box, Random& random) {
  return {between(random, box.min.x, box.max.x), between(random, box.min.y, box.max.y),
          between(random, box.min.z, box.max.z)};
}

/// Beyond it a mesh that is made of floats in this box is not right.
inline double roundingIn(const Box& box) { return 2e-6 * box.longestSide(); }

/// No point of the surface is farther from the mesh than is said: those met on lines through the box.
inline void holdSurface(const Search& search, const Box& box, const MeshedShape& made, Random& random,
                        unsigned seed) {
  const double reach = box.longestSide();
  std::vector<glm::vec3> surface;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 p = pointIn(box, random);
    glm::dvec3 way(0.0);
    way[below(random, 3)] = 1.0;
    const glm::dvec3 met = p + search.along(p, way, reach) * way;
    if (box.contains(Box{met, met})) surface.emplace_back(met);
  }
  Progress progress;
  const SurfaceDistance missed = distanceToMesh(surface, made.mesh.positions, made.mesh.triangles, progress);
  EXPECT_LE(missed.max, 1.05 * made.stats.maxDistance + roundingIn(box))
      << "the surface at " << missed.farthest.x << ", " << missed.farthest.y << ", " << missed.farthest.z
      << " is missed, seed " << seed;
}

/// What is farther from the mesh than it is from the surface is on the same side of both.
inline void holdSides(const Search& search, const Box& box, const MeshedShape& made, Random& random,
                      unsigned seed) {
  const std::vector<glm::vec3>& at = made.mesh.positions;
  std::vector<glm::vec3> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(pointIn(box, random));
  Progress progress;
  const std::vector<NearestPoint> nearest = nearestTriangles(points, at, made.mesh.triangles, progress);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::sqrt(nearest[i].squared) <= 1.05 * made.stats.maxDistance + roundingIn(box)) continue;
    const glm::dvec3 p(points[i]);
    // The sum of the solid angles of the triangles (Van Oosterom and Strackee 1983).
    double angle = 0.0;
    for (const glm::uvec3& t : made.mesh.triangles) {
      const glm::dvec3 a = glm::dvec3(at[t.x]) - p, b = glm::dvec3(at[t.y]) - p, c = glm::dvec3(at[t.z]) - p;
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                   glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    EXPECT_EQ(search.value(p) < 0.0, angle > 2.0 * 3.141592653589793)
        << "(" << p.x << ", " << p.y << ", " << p.z << ") is on the other side, seed " << seed;
  }
}

}  // namespace sdf::test
