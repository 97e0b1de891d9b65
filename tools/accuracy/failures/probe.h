// What the failure cases measure with.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "accuracy/take.h"
#include "failure_case.h"
#include "reference/reference.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/shape.h"

namespace sdf::accuracy {

// Some tens of roundings in double of numbers of size 1 to 10, as each formula here makes.
inline constexpr double kRounding = 1e-13;

/// The shape's distance in double. A shape that was refused must not pass for one that holds.
class Distance {
 public:
  explicit Distance(const Shape& s) : tape_(s.ok() ? s.distance : throw std::runtime_error(*s.error)) {}
  double operator()(const glm::dvec3& p) const { return evaluate(tape_, p); }
  double operator()(double x, double y, double z) const { return evaluate(tape_, {x, y, z}); }
  glm::dvec3 gradient(const glm::dvec3& p) const { return evaluateGradient(tape_, p).gradient; }

 private:
  Tape tape_;
};

/// Largest of figure(p) over a lattice of n^3 points in [-reach, reach]^3, NaN being the worst of all.
template <class F>
double worst(double reach, int n, const F& figure) {
  double most = -kInfinity;
  for (int i = 0; i < n * n * n; ++i) {
    const glm::dvec3 at(i / (n * n), i / n % n, i % n);
    const double v = figure(reach * (2.0 * at / (n - 1.0) - 1.0));
    if (std::isnan(v)) return kInfinity;
    most = std::max(most, v);
  }
  return most;
}

/// The worst of each figure from `from` to `to` in these steps.
template <class F>
Figures worstOf(double from, double to, double step, const F& figures) {
  Figures most;
  for (double x = from; x <= to; x += step) {
    const Figures at = figures(x);
    most = {std::max(most.naive, at.naive), std::max(most.ours, at.ours)};
  }
  return most;
}

/// Largest difference quotient of f over short steps along the axes and diagonals.
template <class F>
double steepest(const F& f, double reach, int n) {
  constexpr double kStep = 1e-4;
  return worst(reach, n, [&](const glm::dvec3& p) {
    double most = 0.0;
    for (int k = 1; k < 27; ++k) {
      const glm::dvec3 q = p + kStep * glm::dvec3(k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1);
      if (q != p) most = std::max(most, std::abs(f(p) - f(q)) / glm::distance(p, q));
    }
    return most;
  });
}

}  // namespace sdf::accuracy
