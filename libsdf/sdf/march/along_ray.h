// One ray through a field, read in double and in intervals. Private to march/.
#pragma once
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/march.h"
#include "sdf/march/sampler.h"

namespace sdf {

/// How one ray ended.
struct RayEnd {
  double t;
  int steps;
  RayStatus status;
};

/// f and g as functions of t alone. Counts its readings.
class AlongRay {
 public:
  AlongRay(const MarchField& field, const Rays& rays, std::size_t ray)
      : field_(field), origin_(rays.origin[ray]), direction_(rays.direction[ray]) {}

  Sample at(double t) {
    ++readings_;
    const glm::dvec3 p = origin_ + t * direction_;
    points_.run(*field_.distance, {p.x, p.y, p.z, 0.0, 0.0, 0.0});
    return {points_.output(0), points_.output(1)};
  }

  /// Encloses g over t in [from, to], and in d[0] every quotient (g(s) - g(t)) / (s - t) there.
  Dual<Interval, 1> over(double from, double to);

  bool hasSlope() const { return field_.hasSlope(); }
  int readings() const { return readings_; }

 private:
  const MarchField& field_;
  glm::dvec3 origin_, direction_;
  ScalarReading<double> points_;
  ScalarReading<Dual<Interval, 1>> segments_;
  int readings_ = 0;
};

/// Where the solid may begin on a ray.
inline double threshold(const MarchOptions& o, double t) { return o.epsilon + o.footprint * t; }

/// MarchMethod::Segment and MarchMethod::Bisection for one ray.
RayEnd marchBySegments(AlongRay& g, const MarchOptions& options, double tMin, double tMax);
RayEnd marchByBisection(AlongRay& g, const MarchOptions& options, double tMin, double tMax);

}  // namespace sdf
