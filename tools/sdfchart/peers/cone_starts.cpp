#include "cone_starts.h"

#include <algorithm>
#include <stdexcept>

#include "sdf/eval/scalar_reading.h"

namespace sdf::chart {
namespace {

// The rays of one tile around their mean.
struct Cone {
  glm::dvec3 origin, axis;
  double width;  // how far rays are off the axis, at t = 1
  double first, last;
};

Cone around(const Rays& rays, const std::vector<std::size_t>& tile) {
  glm::dvec3 sum(0.0);
  for (const std::size_t i : tile) sum += rays.direction[i];
  Cone cone{rays.origin[tile[0]], glm::normalize(sum), 0.0, rays.tMin[tile[0]], rays.tMax[tile[0]]};
  for (const std::size_t i : tile)
    cone.width = std::max(cone.width, glm::length(rays.direction[i] - cone.axis));
  return cone;
}

// A ball of radius r around the axis at t holds every ray from there to t + r - t width. Ends where that is
// little beside the cone.
double marched(const Cone& cone, const Tape& tape, int& readings) {
  constexpr double kLittle = 0.1;
  ScalarReading<double> reading;
  double t = cone.first;
  while (t < cone.last) {
    const glm::dvec3 p = cone.origin + t * cone.axis;
    reading.run(tape, {p.x, p.y, p.z});
    ++readings;
    const double step = reading.output(1) - t * cone.width;
    if (!(step > kLittle * t * cone.width)) break;
    t += step;
  }
  return std::min(t, cone.last);
}

}  // namespace

StartedRays coneStarts(const MarchField& field, const Rays& rays, int side) {
  if (!field.hasSlope()) throw std::runtime_error("cones need a field whose slope is known");
  constexpr int kTile = 4;
  StartedRays started{rays};
  int readings = 0;
  for (int top = 0; top < side; top += kTile)
    for (int left = 0; left < side; left += kTile) {
      std::vector<std::size_t> tile;
      for (int y = top; y < std::min(side, top + kTile); ++y)
        for (int x = left; x < std::min(side, left + kTile); ++x)
          tile.push_back(static_cast<std::size_t>(y) * side + x);
      const double t = marched(around(rays, tile), *field.distance, readings);
      for (const std::size_t i : tile) started.rays.tMin[i] = t;
    }
  started.readings = readings / static_cast<double>(rays.size());
  return started;
}

}  // namespace sdf::chart
