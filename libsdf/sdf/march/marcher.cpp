#include <algorithm>
#include <cmath>
#include <string>

#include "sdf/march/along_ray.h"
#include "sdf/march/march.h"
#include "sdf/march/sampler.h"

namespace sdf {
namespace {

constexpr const char* kUser = "march";
// Of `lookBehind`: how far behind the surface a ray looks, in ways to it by the last slope; the least that is
// believed of that slope; from how many thresholds on; how many it may step at once; and after how many
// readings within one it hits, of which those that rise count 1 / kFalling.
constexpr double kBehind = 1.25, kLeastFall = 1.0 / 16, kCandidate = 2.0, kLongest = 8.0,
                 kHair = 4095.0 / 4096;
constexpr int kMostClose = 64, kFalling = 8;
constexpr double kRefinedThresholds = 4.0;  // that a refined hit may move on: enough where g falls by 1/4

Error wrongOption(const std::string& what) { return {ErrorKind::Usage, std::string(kUser) + ": " + what}; }

Status checkOptions(const MarchOptions& o) {
  const auto isIn = [](double x, double lo, double hi) { return lo <= x && x <= hi; };
  if (!isPositive(o.epsilon)) return wrongOption("epsilon must be positive and finite");
  if (!isNotNegative(o.footprint)) return wrongOption("footprint must be finite and at least 0");
  if (o.maxSteps < 1) return wrongOption("maxSteps must be at least 1");
  if (o.refinements < 0) return wrongOption("refinements must be at least 0");
  if (!isIn(o.overRelaxation, 1.0, 2.0) || o.overRelaxation == 2.0)
    return wrongOption("overRelaxation must be at least 1 and below 2");
  if (!isIn(o.acceleration, 0.0, 1.0)) return wrongOption("acceleration must be from 0 to 1");
  if (!isIn(o.smoothing, 0.0, 1.0) || o.smoothing == 0.0)
    return wrongOption("smoothing must be above 0 and at most 1");
  if (!(o.growth > 1.0 && std::isfinite(o.growth))) return wrongOption("growth must be above 1 and finite");
  return okStatus();
}

bool marchesBalls(MarchMethod m) { return m != MarchMethod::Segment && m != MarchMethod::Bisection; }

// The methods that step by unbounding spheres, as march.h states them.
class BallWalker {
 public:
  // Where a step ends, of the surface.
  enum class StepEnds : std::uint8_t {
    Before,  // or nothing is known of it
    Behind,  // to look whether there is one
    On       // where a look behind has placed it
  };
  struct State {
    double at;         // t + step: where g is read next
    double t, radius;  // the last point taken, and g there
    double step;       // from t to the next point
    double slope;      // of g along the ray, as the method estimates it
    double fall;       // of g along the step before, a unit
    bool relaxed;      // OverRelaxed: no failure yet
    StepEnds ends;
    int close;  // readings within the threshold, those that fall or stay kFalling times
    std::uint32_t steps;
    std::size_t ray;
  };

  BallWalker(const MarchOptions& options, const Rays& rays, Hits& hits)
      : options_(options), rays_(rays), hits_(hits) {}

  State start(std::size_t ray) const {
    const double t = rays_.tMin[ray];
    return {t, t, 0.0, 0.0, -1.0, 1.0, true, StepEnds::Before, 0, 0, ray};
  }

  bool advance(State& s, const Sample& sample) {
    const double g = sample.step;
    ++s.steps;
    if (std::isnan(sample.distance)) return finish(s, s.at, RayStatus::Undefined);
    const bool inside = s.ends == StepEnds::Behind && g <= 0.0;
    if (inside && s.step <= kLongest * threshold(options_, s.t)) return finishBetween(s, g);
    if (inside || (s.step > s.radius && s.step > s.radius + g && !passesFilm(s, g))) {
      s.ends = s.ends == StepEnds::Behind ? StepEnds::On : StepEnds::Before;
      s.step = s.ends == StepEnds::On ? s.radius / s.fall : s.radius;
      s.slope = -1.0;
      s.relaxed = false;
    } else {
      const double rise = s.step > 0.0 ? (g - s.radius) / s.step : -1.0;
      learnSlope(s, g);
      s.t = s.at;
      s.radius = g;
      const double left = rays_.tMax[s.ray] - s.t;
      if (isHit(s, sample.toHit(), rise)) return finish(s, s.t, RayStatus::Hit);
      if (g >= left) return finish(s, rays_.tMax[s.ray], RayStatus::Miss);
      const bool near = sample.toHit() <= kCandidate * threshold(options_, s.t);
      s.ends = options_.lookBehind && near && rise < 0.0 ? StepEnds::Behind : StepEnds::Before;
      s.fall = std::max(-rise, kLeastFall);
      s.step = s.ends == StepEnds::Behind ? kBehind * std::max(g, options_.epsilon) / s.fall
                                          : std::min(relaxedStep(s), left);
    }
    s.at = s.t + s.step;
    return s.steps < static_cast<std::uint32_t>(options_.maxSteps) || finish(s, s.t, RayStatus::Budget);
  }

 private:
  bool isHit(State& s, double toHit, double rise) const {
    const double near = threshold(options_, s.t);
    if (toHit > near) return false;
    if (!options_.lookBehind || s.radius < (rise < 0.0 ? -near : 0.0)) return true;
    s.close += rise <= 0.0 ? kFalling : 1;
    return s.close > kMostClose * kFalling;
  }

  // Of a film nothing is known to lie between the readings on both sides of it.
  bool passesFilm(const State& s, double g) const {
    return (s.ends == StepEnds::Behind && s.radius <= options_.epsilon) ||
           (s.ends == StepEnds::On && g < s.radius);
  }

  // Between t and a reading in the solid, no farther than the slopes before and after t place the surface,
  // and a hair less: on it distances that are roots have no gradient.
  bool finishBetween(const State& s, double g) {
    const double secant = s.step * s.radius / (s.radius - g), end = rays_.tMax[s.ray];
    const double t = s.t + std::max(0.0, kHair * std::min(s.step / kBehind, secant));
    return t < end ? finish(s, t, RayStatus::Hit) : finish(s, end, RayStatus::Miss);
  }

  void learnSlope(State& s, double g) const {
    if (s.step == 0.0) return;
    const double slope = (g - s.radius) / s.step;
    s.slope = options_.method == MarchMethod::AutoRelaxed ? s.slope + options_.smoothing * (slope - s.slope)
                                                          : slope;
  }

  // At least the radius. A slope of 1 leads straight away from the surface, and the step has no limit.
  double relaxedStep(const State& s) const {
    const double r = s.radius, m = std::clamp(s.slope, -1.0, 1.0);
    switch (options_.method) {
      case MarchMethod::OverRelaxed:
        return s.relaxed ? options_.overRelaxation * r : r;
      case MarchMethod::Accelerated:
        return r + options_.acceleration * r * (1.0 + m) / (1.0 - m);
      case MarchMethod::AutoRelaxed:
        return 2.0 * r / (1.0 - m);
      default:
        return r;
    }
  }

  bool finish(const State& s, double t, RayStatus status) {
    hits_.t[s.ray] = t;
    hits_.steps[s.ray] = static_cast<int>(s.steps);
    hits_.status[s.ray] = status;
    return false;
  }

  const MarchOptions& options_;
  const Rays& rays_;
  Hits& hits_;
};

// Secant steps from the hit at `t` towards f = 0, by at most the threshold. They start with a plain step,
// which cannot pass the surface.
double refined(AlongRay& f, const MarchOptions& options, double t) {
  const double limit = t + kRefinedThresholds * threshold(options, t);
  const Sample hit = f.at(t);
  if (!(hit.distance > 0.0)) return t;
  double before = t, fBefore = hit.distance;
  double after = t + hit.step, fAfter = f.at(after).distance;
  for (int i = 0; i < options.refinements && fAfter != 0.0 && fAfter != fBefore; ++i) {
    const double next = after - fAfter * (after - before) / (fAfter - fBefore);
    if (!(next >= t && next <= limit)) break;
    before = after, fBefore = fAfter;
    after = next, fAfter = f.at(next).distance;
  }
  return std::abs(fAfter) < std::abs(fBefore) ? after : before;
}

}  // namespace

struct Marcher::State {
  MarchField field;
  MarchOptions options;
  Sampler sampler{field};

  Status checkLengths(const Rays& rays) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double far = std::max(std::abs(rays.tMin[i]), std::abs(rays.tMax[i]));
      if (far + 0.25 * options.epsilon == far)
        return wrongOption("ray " + std::to_string(i) + ": double does not resolve epsilon at t = " +
                           std::to_string(far) + "; start it nearer or raise epsilon");
    }
    return okStatus();
  }

  void traceOneByOne(const Rays& rays, Hits& hits) const {
    const auto march = options.method == MarchMethod::Segment ? marchBySegments : marchByBisection;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      AlongRay g(field, rays, i);
      const RayEnd end = march(g, options, rays.tMin[i], rays.tMax[i]);
      hits.t[i] = end.t;
      hits.steps[i] = end.steps;
      hits.status[i] = end.status;
    }
  }

  void refineHits(const Rays& rays, Hits& hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits.status[i] != RayStatus::Hit) continue;
      AlongRay g(field, rays, i);
      hits.t[i] = refined(g, options, hits.t[i]);
      hits.steps[i] += g.readings();
    }
  }
};

Marcher::Marcher(std::unique_ptr<State> state) : state_(std::move(state)) {}
Marcher::Marcher(Marcher&&) noexcept = default;
Marcher& Marcher::operator=(Marcher&&) noexcept = default;
Marcher::~Marcher() = default;

Result<Marcher> Marcher::make(MarchField field, const MarchOptions& options) {
  if (const Status s = checkOptions(options); !s) return s.error();
  if (marchesBalls(options.method))
    if (const Status s = checkSlope(field, kUser); !s) return s.error();
  return Marcher(std::unique_ptr<State>(new State{std::move(field), options}));
}

Result<Marcher> Marcher::make(const Shape& shape, const MarchOptions& options) {
  Result<MarchField> field = marchField(shape);
  if (!field) return field.error();
  return make(std::move(field).value(), options);
}

Result<Hits> Marcher::trace(const Rays& rays) {
  if (const Status s = checkRays(rays, kUser); !s) return s.error();
  if (const Status s = state_->checkLengths(rays); !s) return s.error();
  const std::size_t count = rays.size();
  Hits hits{std::vector<double>(count), std::vector<int>(count), std::vector<RayStatus>(count)};
  if (marchesBalls(state_->options.method)) {
    BallWalker walker(state_->options, rays, hits);
    marchTogether(rays, state_->sampler, walker);
  } else {
    state_->traceOneByOne(rays, hits);
  }
  if (state_->options.refinements > 0) state_->refineHits(rays, hits);
  return hits;
}

}  // namespace sdf
