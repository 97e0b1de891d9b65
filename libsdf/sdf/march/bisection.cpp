#include <algorithm>
#include <cmath>
#include <vector>

#include "sdf/march/along_ray.h"

namespace sdf {
namespace {

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
  return g.hasSlope() && g.value(from) > to - from;
}

}  // namespace

RayEnd marchByBisection(AlongRay& g, const MarchOptions& options, double tMin, double tMax) {
  double from = tMin;
  if (const double first = g.value(tMin); !(first > threshold(options, tMin)))
    return {tMin, g.readings(), std::isnan(first) ? RayStatus::Undefined : RayStatus::Hit};
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
