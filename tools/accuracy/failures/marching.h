// Rays that the cases of marching measure with. Private to the failure cases.
#pragma once
#include <cmath>
#include <vector>

#include "probe.h"
#include "sdf/march/march.h"

namespace sdf::accuracy {

inline constexpr double kEpsilon = 1e-4;  // of a hit, scene units
inline constexpr double kReach = 20.0;    // how far the rays go

/// Rays of a pinhole camera at `from` that looks at the origin, y up: 320 x 200, `tangent` half the height at
/// distance 1.
inline Rays cameraRays(const glm::dvec3& from, double tangent) {
  constexpr int kWidth = 320, kHeight = 200;
  const glm::dvec3 forward = glm::normalize(-from);
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

inline Hits trace(const Shape& shape, const Rays& rays, const MarchOptions& options) {
  return take(take(Marcher::make(shape, options)).trace(rays));
}

/// t of the hits, infinite where there is none.
inline std::vector<double> timesOf(const Hits& hits) {
  std::vector<double> t = hits.t;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (hits.status[i] != RayStatus::Hit) t[i] = kInfinity;
  return t;
}

}  // namespace sdf::accuracy
