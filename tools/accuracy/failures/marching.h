// Rays and the marcher without care that the cases of marching measure with. Private to the failure cases.
#pragma once
#include <cmath>
#include <stdexcept>
#include <vector>

#include "failure_case.h"
#include "probe.h"
#include "sdf/march/march.h"

namespace sdf::accuracy {

/// Cases of normals, shadows and level of detail.
std::vector<FailureCase> shadingFailures();

inline constexpr double kEpsilon = 1e-4;  // of a hit, scene units
inline constexpr double kReach = 20.0;    // how far the rays go

/// Rays of a pinhole camera at `from` that looks at `to`, y up: 320 x 200, `tangent` half the height at
/// distance 1.
inline Rays cameraRays(const glm::dvec3& from, const glm::dvec3& to, double tangent) {
  constexpr int kWidth = 320, kHeight = 200;
  const glm::dvec3 forward = glm::normalize(to - from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(right, forward);
  Rays rays;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = (2.0 * x + 1.0 - kWidth) / kHeight, v = 1.0 - (2.0 * y + 1.0) / kHeight;
      rays.add(from, glm::normalize(forward + tangent * (u * right + v * up)), 0.0, kReach);
    }
  return rays;
}

struct NaiveMarch {
  double relaxation = 1.0;
  bool checked = false;  ///< go back where the balls of a relaxed step do not overlap
  int maxSteps = 2000;
};

/// Sphere tracing that believes |f| to be a distance: t of the hit, infinite where there is none. A step that
/// was taken back is repeated without relaxation, and the next one is relaxed again.
template <class F>
double marchNaively(const F& f, const glm::dvec3& from, const glm::dvec3& along, const NaiveMarch& march) {
  double t = 0.0, before = 0.0, step = 0.0;
  for (int i = 0; i < march.maxSteps && t < kReach; ++i) {
    const double distance = f(from + t * along);
    if (march.checked && step > before && std::abs(distance) + before < step) {
      t += before - step;
      step = before;
      continue;
    }
    if (distance < kEpsilon) return t;
    before = distance;
    step = march.relaxation * distance;
    t += step;
  }
  return kInf;
}

template <class F>
std::vector<double> marchAllNaively(const F& f, const Rays& rays, const NaiveMarch& march = {}) {
  std::vector<double> t;
  for (std::size_t i = 0; i < rays.size(); ++i)
    t.push_back(marchNaively(f, rays.origin[i], rays.direction[i], march));
  return t;
}

inline Hits trace(const Shape& shape, const Rays& rays, const MarchOptions& options) {
  Result<Marcher> marcher = Marcher::make(shape, options);
  if (!marcher) throw std::runtime_error(marcher.error().message);
  Result<Hits> hits = marcher->trace(rays);
  if (!hits) throw std::runtime_error(hits.error().message);
  return *hits;
}

/// t of the hits, infinite where there is none.
inline std::vector<double> hitsOf(const Shape& shape, const Rays& rays, MarchMethod method,
                                  int maxSteps = 2000) {
  MarchOptions options;
  options.method = method;
  options.epsilon = kEpsilon;
  options.maxSteps = maxSteps;
  const Hits hits = trace(shape, rays, options);
  std::vector<double> t;
  for (std::size_t i = 0; i < rays.size(); ++i)
    t.push_back(hits.status[i] == RayStatus::Hit ? hits.t[i] : kInf);
  return t;
}

/// Percent of the rays for which bad(i) holds.
template <class Bad>
double percent(const Rays& rays, const Bad& bad) {
  double count = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) count += bad(i);
  return 100.0 * count / static_cast<double>(rays.size());
}

/// Percent of the rays that end more than ten epsilons of f within the solid.
template <class F>
double percentDeep(const F& f, const Rays& rays, const std::vector<double>& t) {
  return percent(rays, [&](std::size_t i) { return t[i] < kInf && f(rays.at(i, t[i])) < -10.0 * kEpsilon; });
}

}  // namespace sdf::accuracy
