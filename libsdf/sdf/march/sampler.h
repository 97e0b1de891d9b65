// Values of a march's field at many points, and many rays marched together. Private to march/.
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "sdf/eval/batch.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/field.h"

namespace sdf {

inline bool isPositive(double x) { return x > 0.0 && std::isfinite(x); }
inline bool isNotNegative(double x) { return x >= 0.0 && std::isfinite(x); }

/// Reads g = f / L in float, hundreds of points at once. A value so near 0 that float rounding could be most
/// of it is read again in double: positions far from the origin still come within epsilon of the surface.
class Sampler {
 public:
  explicit Sampler(const MarchField& field) : field_(field) {}

  /// value[i] = g(points[i]). Makes `value` as long as `points`.
  void sample(const Vectors& points, std::vector<double>& value);
  /// g in double.
  double at(const glm::dvec3& p);

 private:
  const MarchField& field_;
  BatchEvaluator batch_;
  ScalarReading<double> scalar_;
};

/// Marches every ray, as many together as one pass of the batch reading takes. A ray that is done makes room
/// for the next. Walker has a State with members `ray`, its number, and `at`, the t to be read next, and
///   State start(ray)              where ray number `ray` begins;
///   bool advance(State&, double g) moves on, knowing g at `at`; false when the ray is done.
template <class Walker>
void marchTogether(const Rays& rays, Sampler& sampler, Walker& walker) {
  std::vector<typename Walker::State> active;
  Vectors points;
  std::vector<double> g;
  std::size_t next = 0;
  while (true) {
    while (active.size() < kBatchPoints && next < rays.size()) active.push_back(walker.start(next++));
    if (active.empty()) return;
    points.clear();
    for (const auto& state : active) points.add(rays.at(state.ray, state.at));
    sampler.sample(points, g);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < active.size(); ++k)
      if (walker.advance(active[k], g[k])) active[kept++] = active[k];
    active.resize(kept);
  }
}

}  // namespace sdf
