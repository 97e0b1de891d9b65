#include "sdf/march/along_ray.h"

#include <algorithm>
#include <cmath>
#include <vector>

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
  D g = segments_.output(1);
  if (field_.hasSlope()) {
    g.d[0].lo = std::clamp(g.d[0].lo, -1.0, 1.0);
    g.d[0].hi = std::clamp(g.d[0].hi, -1.0, 1.0);
  }
  return g;
}

namespace {

// Steepest fall of g over the next `length`, which is halved while nothing is known of it, rounded up. Where
// that fails down to epsilon the result is infinite: g may jump there.
double steepestFall(AlongRay& g, const MarchOptions& options, double t, double& length) {
  while (true) {
    const double fall = std::nextafter(std::max(0.0, -g.over(t, t + length).d[0].lo), kInfinity);
    if (std::isfinite(fall) || length <= options.epsilon || g.readings() >= options.maxSteps) return fall;
    length = std::max(0.5 * length, options.epsilon);
  }
}

// Is g above 0 on all of [from, to]? By its values there, or by its value `start` at `from` and its slopes.
bool proveFree(AlongRay& g, const Interval& start, double from, double to) {
  const Dual<Interval, 1> piece = g.over(from, to);
  if (piece.v.lo > 0.0) return true;
  const Interval way(0.0, sub(Interval(to), Interval(from)).hi);
  return add(start, mul(piece.d[0], way)).lo > 0.0;
}

// The same by the Lipschitz constant and a value in double: intervals cannot tell a sign that flips twice at
// one point, as that of a polygon does at the height of a corner.
bool slopeProvesFree(AlongRay& g, double from, double to) {
  return g.hasSlope() && g.at(from).step > to - from;
}

}  // namespace

RayEnd marchBySegments(AlongRay& g, const MarchOptions& options, double tMin, double tMax) {
  double t = tMin, length = tMax - tMin;
  while (g.readings() < options.maxSteps) {
    const Sample here = g.at(t);
    const double r = here.step;
    if (std::isnan(here.distance)) return {t, g.readings(), RayStatus::Undefined};
    if (here.toHit() <= threshold(options, t)) return {t, g.readings(), RayStatus::Hit};
    if (t >= tMax) return {t, g.readings(), RayStatus::Miss};
    length = std::min(length, tMax - t);
    const double fall = steepestFall(g, options, t, length);
    // Where g falls without bound, epsilon at a time is what the dense march would do.
    const double step = !std::isfinite(fall) ? std::min(length, options.epsilon)
                        : fall * length < r  ? length
                                             : r / fall;
    t = step >= tMax - t ? tMax : t + step;
    length = options.growth * step;
  }
  return {t, g.readings(), RayStatus::Budget};
}

RayEnd marchByBisection(AlongRay& g, const MarchOptions& options, double tMin, double tMax) {
  double from = tMin;
  const Sample first = g.at(tMin);
  if (std::isnan(first.distance)) return {tMin, g.readings(), RayStatus::Undefined};
  if (first.toHit() <= threshold(options, tMin)) return {tMin, g.readings(), RayStatus::Hit};
  Interval start = g.over(from, from).v;
  std::vector<double> ends{tMax};  // of the pieces still to be searched, the nearest last
  while (!ends.empty()) {
    if (g.readings() >= options.maxSteps) return {from, g.readings(), RayStatus::Budget};
    const double to = ends.back();
    const bool small = to - from <= threshold(options, from);
    if (proveFree(g, start, from, to) || (small && slopeProvesFree(g, from, to))) {
      ends.pop_back();
      from = to;
      start = g.over(from, from).v;
    } else if (small) {
      return {from, g.readings(), RayStatus::Hit};
    } else {
      ends.push_back(from + 0.5 * (to - from));
    }
  }
  return {tMax, g.readings(), RayStatus::Miss};
}

}  // namespace sdf
