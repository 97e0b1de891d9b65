#include "sdf/shape/calibrate/surface_points.h"

#include <cmath>
#include <optional>

#include "sdf/base/random_point.h"
#include "sdf/expr/gradient.h"

namespace sdf {

namespace {

Expr atDefaults(const Expr& f) {
  return rewrite(f, [](const Expr& e, std::span<const Expr> /*args*/) {
    return e.op() == Op::Parameter ? std::optional<Expr>(e.parameterInfo().value) : std::nullopt;
  });
}

std::vector<Expr> slopesOf(const Expr& f) {
  const Vec3E g = gradientOf(f);
  return {f, g.x, g.y, g.z};
}

double middle(const Interval& i) { return i.nan || !(i.magnitude() < kInfinity) ? 0.0 : 0.5 * (i.lo + i.hi); }

}  // namespace

SurfaceReading::SurfaceReading(const Expr& f)
    : f_(atDefaults(f)), point_({&f_, 1}), value_({&f_, 1}), gradient_(slopesOf(f_)) {}

// Intervals, which take some times as long, are asked where rounding may decide.
bool SurfaceReading::isInside(const glm::dvec3& p) {
  constexpr double kRounding = 1e-9;
  point_.run({p, p});
  if (std::abs(point_[0]) > kRounding && std::abs(point_[0]) < kInfinity) return point_[0] < 0.0;
  value_.run({p, p});
  return middle(value_[0]) <= 0.0;
}

SurfacePoint SurfaceReading::at(const glm::dvec3& p) {
  gradient_.run({p, p});
  return {p, middle(gradient_[0]), {middle(gradient_[1]), middle(gradient_[2]), middle(gradient_[3])}};
}

std::vector<SurfacePoint> SurfaceReading::zeros(const Box& region, int lines) {
  constexpr int kSteps = 32, kHalvings = 30;
  std::mt19937 random(1);
  std::vector<SurfacePoint> found;
  for (int line = 0; line < lines; ++line) {
    const glm::dvec3 from = pointIn(region, random), way = pointIn(region, random) - from;
    const bool beginsInside = isInside(from);
    for (int i = 1; i <= kSteps; ++i) {
      double lo = (i - 1.0) / kSteps, hi = lo + 1.0 / kSteps;
      if (isInside(from + hi * way) == beginsInside) continue;
      for (int k = 0; k < kHalvings; ++k) {
        const double mid = 0.5 * (lo + hi);
        (isInside(from + mid * way) == beginsInside ? lo : hi) = mid;
      }
      found.push_back(at(from + lo * way));
      break;
    }
  }
  return found;
}

}  // namespace sdf
