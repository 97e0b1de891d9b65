#include "sdf/scene/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace sdf {

std::optional<Box> boundsInView(const Scene& scene) {
  Box box = scene.whole().bounds;
  if (!box.finite() && scene.bounds) box = intersect(box, *scene.bounds);
  if (!box.finite() || !(box.longestSide() > 0.0)) return std::nullopt;
  return box;
}

double viewRadius(const Box& box) { return 0.5 * glm::length(box.size()); }

double fittingDistance(const Box& box, const glm::dmat3& axes, double fov, double aspect) {
  constexpr double kMargin = 1.05;
  const double rise = std::tan(0.5 * fov) / kMargin, run = rise * aspect;  // of the picture's edges, a unit
  const glm::dvec3 half = 0.5 * box.size();
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign(corner & 4 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 1 ? 1.0 : -1.0);
    const glm::dvec3 seen = (sign * half) * axes;  // to the right, up and away
    distance = std::max({distance, std::abs(seen.x) / run - seen.z, std::abs(seen.y) / rise - seen.z});
  }
  return distance;
}

StatedLengths::StatedLengths(const Scene& scene)
    : maxDistance(scene.maxDistance),
      shadowStart(scene.shadow.start),
      shadowReach(scene.shadow.reach),
      tapSpacing(scene.ambientOcclusion.spacing) {}

ViewLengths viewLengths(const StatedLengths& stated, std::optional<double> fittedRadius) {
  const double unit = fittedRadius ? 0.5 * *fittedRadius : 1.0;
  return {unit, stated.maxDistance.value_or(80.0 * unit), stated.shadowStart.value_or(0.02 * unit),
          stated.shadowReach.value_or(20.0 * unit), stated.tapSpacing.value_or(0.08 * unit)};
}

}  // namespace sdf
