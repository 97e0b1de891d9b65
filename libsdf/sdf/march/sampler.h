// Values of a march's field at many points, and many rays marched together. Private to march/.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/field.h"

namespace sdf {

inline bool isPositive(double x) { return x > 0.0 && std::isfinite(x); }
inline bool isNotNegative(double x) { return x >= 0.0 && std::isfinite(x); }

/// A field at a point: f and g (see MarchField).
struct Sample {
  double distance, step;

  /// The value that is held to a hit's threshold: f, so that hits do not depend on how tightly its slope is
  /// known, or g where it proves that the surface is farther off.
  double toHit() const { return std::max(distance, step); }
};

/// Reads f and g in float, hundreds of points at once. Values so near 0 that float rounding could be most of
/// them are read again in double: positions far from the origin still come within epsilon of the surface.
class Sampler {
 public:
  explicit Sampler(const MarchField& field) : field_(field) {}

  /// samples[i] is what is read at points[i]. Makes `samples` as long as `points`.
  void sample(const Vectors& points, std::vector<Sample>& samples);
  /// The same in double.
  Sample at(const glm::dvec3& p);

 private:
  const MarchField& field_;
  BatchEvaluator batch_;
  ScalarReading<double> scalar_;
};

/// Marches every ray, as many together as one pass of the batch reading takes. A ray that is done makes room
/// for the next. Walker has a State with members `ray`, its number, and `at`, the t to be read next, and
///   State start(ray)              where ray number `ray` begins;
///   bool advance(State&, const Sample&) moves on, knowing what is read at `at`; false when the ray is done.
template <class Walker>
void marchTogether(const Rays& rays, Sampler& sampler, Walker& walker) {
  std::vector<typename Walker::State> active;
  Vectors points;
  std::vector<Sample> samples;
  std::size_t next = 0;
  while (true) {
    while (active.size() < kBatchPoints && next < rays.size()) active.push_back(walker.start(next++));
    if (active.empty()) return;
    points.clear();
    for (const auto& state : active) points.add(rays.at(state.ray, state.at));
    sampler.sample(points, samples);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (walker.advance(active[k], samples[k])) active[kept++] = active[k];
    active.resize(kept);
  }
}

}  // namespace sdf
