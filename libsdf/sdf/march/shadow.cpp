#include "sdf/march/shadow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sdf/march/sampler.h"

namespace sdf {
namespace {

constexpr const char* kShadowUser = "shadows";
constexpr double kPenumbraStep = 0.6;
constexpr double kDips = 0.998;  // less than that is rounding: away from a plane f / t stays

Error wrongShadow(const std::string& what) {
  return {ErrorKind::Usage, std::string(kShadowUser) + ": " + what};
}

Status check(const Rays& rays, const ShadowOptions& o) {
  if (!isPositive(o.sharpness)) return wrongShadow("sharpness must be positive and finite");
  if (!isPositive(o.epsilon)) return wrongShadow("epsilon must be positive and finite");
  if (o.maxSteps < 1) return wrongShadow("maxSteps must be at least 1");
  if (const Status s = checkRays(rays, kShadowUser); !s) return s.error();
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (o.method != ShadowMethod::Hard && rays.tMin[i] == 0.0)
      return wrongShadow("ray " + std::to_string(i) + ": soft shadows divide by t; start above 0");
  return okStatus();
}

class ShadowWalker {
 public:
  struct State {
    double at;                  // where g is read next
    double step;                // from the sample before, 0 at the first
    double before;              // f at the sample before
    double stepBefore, rise;    // Soft: the step to that sample, and how fast f * f rose along it
    double ratio, ratioBefore;  // Soft: f / t at that sample and at the one before
    double least;               // least k f / t so far
    int steps;
    std::size_t ray;
  };

  ShadowWalker(const ShadowOptions& options, const Rays& rays, Shade& shade)
      : options_(options), rays_(rays), shade_(shade) {}

  State start(std::size_t ray) const { return {rays_.tMin[ray], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0, ray}; }

  bool advance(State& s, const Sample& sample) {
    const double f = sample.distance;
    ++s.steps;
    if (std::isnan(f)) return finish(s, 0.0, RayStatus::Undefined);
    const bool crosses = options_.method == ShadowMethod::Signed;
    if (!crosses && sample.toHit() <= options_.epsilon) return finish(s, 0.0, RayStatus::Hit);
    s.least = std::min(s.least, ratio(s, f));
    if (s.least <= -1.0) return finish(s, 0.0, RayStatus::Hit);
    if (options_.method == ShadowMethod::Soft) lookBetween(s, f);
    s.step = stepFrom(s, sample);
    s.before = f;
    if (s.at + s.step >= rays_.tMax[s.ray]) return finish(s, lightOf(s), RayStatus::Miss);
    s.at += s.step;
    return s.steps < options_.maxSteps || finish(s, 0.0, RayStatus::Budget);
  }

 private:
  // k times the tangent of the angle between the ray and what is nearest to it here.
  double ratio(const State& s, double f) const {
    if (options_.method == ShadowMethod::Hard) return 1.0;
    if (options_.method != ShadowMethod::Improved || s.step == 0.0) return options_.sharpness * f / s.at;
    const double y = (s.step * s.step + f * f - s.before * s.before) / (2.0 * s.step);
    if (!(y > 0.0 && y < s.step)) return options_.sharpness * f / s.at;
    return options_.sharpness * std::sqrt(std::max(0.0, f * f - y * y)) / (s.at - y);
  }

  // Where the least f / t is around the sample before: that of the parabola through the squares of the last
  // three f, x from that sample. It is at least sqrt(3) / 2 of what was read, since the balls around the
  // samples are free.
  void lookBetween(State& s, double f) const {
    const double t = s.at - s.step, square = s.before * s.before, rise = (f * f - square) / s.step;
    if (s.steps > 2 && s.ratio < kDips * std::min(s.ratioBefore, f / s.at)) {
      const double bend = (rise - s.rise) / (s.stepBefore + s.step), slope = s.rise + bend * s.stepBefore;
      const double steep = 2.0 * bend * t - slope;
      const double x =
          std::clamp((2.0 * square - slope * t) / (steep == 0.0 ? 1.0 : steep), -s.stepBefore, s.step);
      const double there = (square + (slope + bend * x) * x) / ((t + x) * (t + x));
      s.least = std::min(s.least, options_.sharpness * std::sqrt(std::max(there, 0.75 * s.ratio * s.ratio)));
    }
    s.stepBefore = s.step;
    s.rise = rise;
    s.ratioBefore = s.ratio;
    s.ratio = f / s.at;
  }

  // Smaller in a penumbra, where what is between the samples counts.
  double stepFrom(const State& s, const Sample& sample) const {
    if (options_.method == ShadowMethod::Signed) return std::max(std::abs(sample.step), options_.epsilon);
    const bool penumbra = options_.method == ShadowMethod::Soft && options_.sharpness * s.ratio < 1.0;
    return penumbra ? kPenumbraStep * sample.step : sample.step;
  }

  double lightOf(const State& s) const {
    const double x = s.least;
    return options_.method == ShadowMethod::Signed ? 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x) : x;
  }

  bool finish(const State& s, double light, RayStatus status) {
    shade_.light[s.ray] = light;
    shade_.status[s.ray] = status;
    return false;
  }

  const ShadowOptions& options_;
  const Rays& rays_;
  Shade& shade_;
};

}  // namespace

Rays raysTowards(const Vectors& points, const glm::dvec3& towards, double start, double reach) {
  Rays rays;
  const glm::dvec3 direction = glm::normalize(towards);
  for (std::size_t i = 0; i < points.size(); ++i) rays.add(points[i], direction, start, reach);
  return rays;
}

Rays raysToPoint(const Vectors& points, const glm::dvec3& position, double start) {
  Rays rays;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 way = position - points[i];
    const double length = glm::length(way);
    const glm::dvec3 direction = length > 0.0 ? way / length : glm::dvec3(0.0, 1.0, 0.0);
    rays.add(points[i], direction, start, std::max(start, length));
  }
  return rays;
}

Result<Shade> shadows(const MarchField& field, const Rays& rays, const ShadowOptions& options) {
  if (const Status s = check(rays, options); !s) return s.error();
  if (const Status s = checkSlope(field, kShadowUser); !s) return s.error();
  Shade shade{std::vector<double>(rays.size()), std::vector<RayStatus>(rays.size())};
  Sampler sampler(field);
  ShadowWalker walker(options, rays, shade);
  marchTogether(rays, sampler, walker);
  return shade;
}

}  // namespace sdf
