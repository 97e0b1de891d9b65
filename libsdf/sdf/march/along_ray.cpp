#include "sdf/march/along_ray.h"

#include <algorithm>

namespace sdf {

Dual<Interval, 1> AlongRay::over(double from, double to) {
  ++readings_;
  using D = Dual<Interval, 1>;
  const Interval t(from, to);
  std::array<D, kVariableCount> variables{};
  for (int axis = 0; axis < 3; ++axis) {
    const Interval slope(direction_[axis]);
    variables[axis] = {add(mul(slope, t), Interval(origin_[axis])), {slope}};
  }
  segments_.run(*field_.distance, variables);
  const D f = segments_.output();
  const Interval divisor(field_.divisor());
  D g{div(f.v, divisor), {div(f.d[0], divisor)}};
  if (field_.hasSlope()) {
    g.d[0].lo = std::clamp(g.d[0].lo, -1.0, 1.0);
    g.d[0].hi = std::clamp(g.d[0].hi, -1.0, 1.0);
  }
  return g;
}

}  // namespace sdf
