// Checks that hold a shape to its claim: each throws many seeded points at one clause and reports the worst.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "sdf/shape/shape.h"
#include "support/evaluate.h"

namespace sdf {

/// An expression as a function of position.
struct Probe : test::Evaluator {
  using test::Evaluator::Evaluator;
  using test::Evaluator::operator();
  double operator()(double x, double y, double z) const { return (*this)(glm::dvec3(x, y, z)); }
};

class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}
  double uniform(double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random_); }
  glm::dvec3 in(const Box& b) {
    return {uniform(b.min.x, b.max.x), uniform(b.min.y, b.max.y), uniform(b.min.z, b.max.z)};
  }
  glm::dvec3 direction() {
    std::normal_distribution<> normal;
    return glm::normalize(glm::dvec3{normal(random_), normal(random_), normal(random_)});
  }

 private:
  std::mt19937 random_;
};

inline std::string text(const glm::dvec3& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

// Rounding of a few dozen operations on numbers of the size of the test scenes (below 100).
inline constexpr double kRounding = 1e-12;

/// Quotients between near points and across long lines stay within the claimed constant.
inline void expectLipschitz(const Shape& s, const Box& where, unsigned seed, int trials = 20000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  const double claimed = s.claim.lipschitz;
  ASSERT_TRUE(std::isfinite(claimed));
  const Probe f(s.distance);
  Points points(seed);
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    const double step = std::pow(10.0, points.uniform(-5.0, 0.5));
    const glm::dvec3 q = p + step * points.direction();
    ASSERT_LE(std::abs(f(p) - f(q)), claimed * step * (1.0 + 1e-9) + kRounding)
        << "seed " << seed << ", from " << text(p) << " to " << text(q) << ": " << f(p) << ", " << f(q);
  }
}

/// What is solid lies in the bounds, and where f <= c in the bounds grown by growth c.
inline void expectBounded(const Shape& s, const Box& where, unsigned seed, int trials = 20000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  const Probe f(s.distance);
  const double growth = growthOf(s.claim);
  Points points(seed);
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    const double value = f(p), by = value <= 0.0 ? 0.0 : growth * value;
    if (by == kInfinity) continue;
    const Box grown{s.bounds.min - (by + kRounding), s.bounds.max + (by + kRounding)};
    ASSERT_TRUE(grown.contains(Box{p, p}))
        << "seed " << seed << ", at " << text(p) << " where f = " << value << ", growth " << growth;
  }
}

/// |f| does not exceed the distance: no point of the ball of that radius has the other sign.
inline void expectBound(const Shape& s, const Box& where, unsigned seed, int trials = 4000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  ASSERT_LE(s.claim.kind, ClaimKind::Bound);
  const Probe f(s.distance);
  Points points(seed);
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    const double value = f(p);
    ASSERT_FALSE(std::isnan(value)) << text(p);
    for (int k = 0; k < 12; ++k) {
      const double share = k % 2 ? 1.0 : points.uniform(0.0, 1.0);
      const glm::dvec3 q = p + points.direction() * (std::abs(value) * share);
      ASSERT_GE(f(q) * (value < 0.0 ? -1.0 : 1.0), -kRounding)
          << "seed " << seed << ": f = " << value << " at " << text(p) << " but " << f(q) << " at "
          << text(q);
    }
  }
}

/// Where f > 0 (everywhere, if exact), the surface is there at distance |f|: a step of f against the slope
/// lands on it.
inline void expectExact(const Shape& s, const Box& where, unsigned seed, int trials = 4000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  ASSERT_LE(s.claim.kind, ClaimKind::ExactOutside);
  const Probe f(s.distance);
  Points points(seed);
  // Central differences over 2h err by h^2 / 6 of a third derivative, some 1 / f^2; points near the surface
  // or a crease, where the slope is not 1, are left out but must be few.
  constexpr double kH = 1e-5, kNear = 1e-2, kLanding = 1e-6;
  int kept = 0, asked = 0;
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    const double value = f(p);
    if (std::abs(value) < kNear || (value < 0.0 && s.claim.kind != ClaimKind::Exact)) continue;
    ++asked;
    const glm::dvec3 slope = f.gradient(p, kH);
    if (std::abs(glm::length(slope) - 1.0) > kLanding) continue;
    ++kept;
    ASSERT_NEAR(f(p - value * slope), 0.0, kLanding * (1.0 + std::abs(value)))
        << "seed " << seed << ", from " << text(p) << " where f = " << value;
  }
  EXPECT_GE(kept, asked * 9 / 10) << "the slope of an exact distance is 1 nearly everywhere";
}

/// Every clause that the claim makes.
inline void expectClaim(const Shape& s, const Box& where, unsigned seed) {
  ASSERT_TRUE(s.ok()) << *s.error;
  SCOPED_TRACE("kind " + std::to_string(static_cast<int>(s.claim.kind)));
  expectBounded(s, where, seed);
  if (std::isfinite(s.claim.lipschitz)) expectLipschitz(s, where, seed);
  if (s.claim.kind <= ClaimKind::Bound) expectBound(s, where, seed);
  if (s.claim.kind <= ClaimKind::ExactOutside) expectExact(s, where, seed);
}

/// Same zero set and sign: the shape's solid is that of another description.
inline void expectSameSolid(const Shape& s, const Probe& inside, const Box& where, unsigned seed,
                            int trials = 20000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  const Probe f(s.distance);
  Points points(seed);
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    if (std::abs(inside(p)) < 1e-9) continue;  // on the surface either sign is right
    ASSERT_EQ(f(p) < 0.0, inside(p) < 0.0) << "seed " << seed << ", at " << text(p) << ": " << f(p);
  }
}

inline Box cube(double half) { return Box::centred(glm::dvec3(half)); }

inline Expr slider(const std::string& name, double value, double min, double max) {
  return Expr::parameter({name, value, min, max});
}

}  // namespace sdf
