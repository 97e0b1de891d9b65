#include "sdf/march/oracle.h"

#include <algorithm>
#include <cmath>

#include "sdf/march/along_ray.h"

namespace sdf {

std::optional<RootBracket> marchDensely(const MarchField& field, const Rays& rays, std::size_t ray,
                                        double epsilon) {
  AlongRay g(field, rays, ray);
  const double first = rays.tMin[ray], length = rays.tMax[ray] - first;
  const double steps =
      std::ceil(length * (field.hasSlope() ? std::max(1.0, field.lipschitz) : 1.0) / epsilon);
  double before = first;
  for (double i = 0.0; i <= steps; ++i) {
    const double t = first + (steps > 0.0 ? length * (i / steps) : 0.0);
    if (g.at(t).distance <= 0.0) return RootBracket{before, t};
    before = t;
  }
  return std::nullopt;
}

}  // namespace sdf
