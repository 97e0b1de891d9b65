#include <algorithm>
#include <cmath>

#include "sdf/march/along_ray.h"

namespace sdf {
namespace {

// Steepest fall of g over the next `length`, which is halved while nothing is known of it. Where that fails
// down to epsilon the result is infinite: g may jump there.
double steepestFall(AlongRay& g, const MarchOptions& options, double t, double& length) {
  while (true) {
    const double fall = std::max(0.0, -g.over(t, t + length).d[0].lo);
    if (std::isfinite(fall) || length <= options.epsilon || g.readings() >= options.maxSteps) return fall;
    length = std::max(0.5 * length, options.epsilon);
  }
}

}  // namespace

RayEnd marchBySegments(AlongRay& g, const MarchOptions& options, double tMin, double tMax) {
  double t = tMin, length = tMax - tMin;
  while (g.readings() < options.maxSteps) {
    const double r = g.value(t);
    if (std::isnan(r)) return {t, g.readings(), RayStatus::Undefined};
    if (r <= threshold(options, t)) return {t, g.readings(), RayStatus::Hit};
    if (t >= tMax) return {t, g.readings(), RayStatus::Miss};
    length = std::min(length, tMax - t);
    const double fall = steepestFall(g, options, t, length);
    // Where g falls without bound, epsilon at a time is what the dense march would do.
    const double step = std::max(fall * length < r ? length : r / fall, std::min(length, options.epsilon));
    t = step >= tMax - t ? tMax : t + step;
    length = options.growth * step;
  }
  return {t, g.readings(), RayStatus::Budget};
}

}  // namespace sdf
