// A shape under test: its readings, and the points at which its clauses are tried.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sdf/eval/scalar_reading.h"
#include "shape/cases.h"

namespace sdf::test {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Box of all points within `by` of p along each axis.
inline Box around(const glm::dvec3& p, double by) { return {p - by, p + by}; }

inline glm::dvec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<> normal;
  return glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
}
inline double uniform(std::mt19937& random, double lo, double hi) {
  return std::uniform_real_distribution<>(lo, hi)(random);
}
inline double anyScale(std::mt19937& random, double lo, double hi) {
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}

class Subject {
 public:
  using Slopes = Dual<Interval, 3>;

  /// `exactness`: how far an "exact" distance may be off, scene units, for those that are iterated.
  Subject(Shape shape, unsigned seed, double exactness = 0.0)
      : shape_(std::move(shape)), tape_(shape_.distance), seed_(seed), exactness_(exactness) {
    const Box region = sampleRegion(shape_);
    longest_ = region.longestSide();
    Sampler sampler(region, seed);
    for (int i = 0; i < kAnywhere; ++i) points_.push_back(sampler.anywhere());
    for (int i = 0; i < kOnAxes; ++i) points_.push_back(sampler.orOnAnAxis());
    std::mt19937 random(seed);
    for (int i = 0; i < kNearSurface; ++i) {
      const double off = anyScale(random, 1e-9, 0.1) * longest_;
      points_.push_back(towardsSurface(sampler.anywhere()) + off * randomDirection(random));
    }
  }

  const Shape& shape() const { return shape_; }
  const Tape& tape() const { return tape_; }
  const std::vector<glm::dvec3>& points() const { return points_; }
  double exactness() const { return exactness_; }
  /// Side of the region that is sampled.
  double longest() const { return longest_; }
  /// Random choices of one clause, the same every time.
  std::mt19937 random() const { return std::mt19937(seed_ + 1); }

  double value(const glm::dvec3& p) const {
    doubles_.run(tape_, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
    return doubles_.output();
  }
  Interval over(const Box& box) const { return evaluate(tape_, box, intervals_); }
  /// The exact value at p and all that rounding can make of it.
  Interval at(const glm::dvec3& p) const { return over({p, p}); }
  /// Value and derivatives over a box, rounding included; across a crease those of all sides.
  Slopes slopesOver(const Box& box) const {
    std::array<Slopes, kVariableCount> variables{};
    for (int i = 0; i < 3; ++i) {
      variables[i].v = Interval(box.min[i], box.max[i]);
      variables[i].d[i] = Interval(1.0);
    }
    duals_.run(tape_, variables);
    return duals_.output();
  }

 private:
  static constexpr int kAnywhere = 96, kOnAxes = 32, kNearSurface = 64;

  glm::dvec3 towardsSurface(glm::dvec3 p) const {
    constexpr int kSteps = 4;
    for (int i = 0; i < kSteps; ++i) {
      const ValueAndGradient f = evaluateGradient(tape_, p);
      const double steep = glm::dot(f.gradient, f.gradient);
      if (steep > 0.0 && std::isfinite(f.value / steep)) p -= f.gradient * (f.value / steep);
    }
    return p;
  }

  Shape shape_;
  Tape tape_;
  unsigned seed_;
  double exactness_, longest_;
  std::vector<glm::dvec3> points_;
  mutable ScalarReading<double> doubles_;
  mutable ScalarReading<Interval> intervals_;
  mutable ScalarReading<Slopes> duals_;
};

}  // namespace sdf::test
