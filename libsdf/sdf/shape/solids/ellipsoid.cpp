// Exact distance to an ellipsoid by an unrolled iteration.
//
// With y the point (in the positive octant) and r the radii, the closest point is x_i = r_i^2 y_i / (t +
// r_i^2), where t is the largest root of S(t) = sum (r_i y_i / (t + r_i^2))^2 = 1 (Eberly, "Distance from a
// Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid", 2013). This is the secular equation of a trust
// region step, and like there (More, Sorensen 1983) Newton's method is applied to 1 / sqrt(S) = 1, which is
// concave and nearly straight: from any start left of the root it climbs to it and never passes it.
//
// It is slow only where y is near the disc between the focal points, for there a weak pole of S stands next
// to the root. So the start is a lower bound of the root that sees the pole: with s = t + r_0^2 (r_0 the
// smallest), A / s the pole and c the other terms, c(s) is convex, hence c(s) >= c(0) - k s and s^2 (1 - c(0)
// + k s) >= A^2. Where r_1 is close to r_0 the two poles act as one at r_1, so the same bound is taken of
// both together.
#include <algorithm>
#include <numeric>

#include "sdf/shape/formula.h"

namespace sdf {

namespace {

// Enough for the error to stay under 2e-7 radii, that is the guard below, for radii in ratios up to 100 (the
// test Ellipsoid.IsExactForNeedlesDiscsAndPointsNearTheFocalDisc).
constexpr int kSteps = 5;
// Points closer to a symmetry plane than this many radii are moved off it, which keeps 0 / 0 away.
constexpr double kOffPlane = 1e-7;

struct Axis {
  Expr radius;
  Expr coordinate;  // not negative
};

void order(Axis& a, Axis& b) {
  const Expr swap = less(b.radius, a.radius);
  const Axis small{select(swap, b.radius, a.radius), select(swap, b.coordinate, a.coordinate)};
  const Axis large{select(swap, a.radius, b.radius), select(swap, a.coordinate, b.coordinate)};
  a = small, b = large;
}

// Axes of one radius act as one, with the length of their coordinates.
std::vector<Axis> merged(const std::vector<Expr>& radii, const std::vector<Expr>& coordinates) {
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto same =
        std::find_if(axes.begin(), axes.end(), [&](const Axis& a) { return a.radius == radii[i]; });
    if (same == axes.end())
      axes.push_back({radii[i], coordinates[i]});
    else
      same->coordinate = norm(same->coordinate, coordinates[i]);
  }
  return axes;
}

// The terms of S(s): weight_i / (s + gap_i), squared.
struct Secular {
  std::vector<Expr> weight, gap, radius;

  Expr sum(const Expr& s, std::size_t i) const { return i == 0 ? s : s + gap[i]; }

  // Lower bound of the root from the pole `strength` / (s + shift) and the terms from `first` on.
  Expr start(const Expr& strength, std::size_t first, const Expr& shift) const {
    Expr others = 0.0, slope = 0.0;
    for (std::size_t i = first; i < weight.size(); ++i) {
      const Expr distance = max(gap[i] - shift, 1e-6 * square(radius[i]));
      const Expr term = square(weight[i] / distance);
      others = others + term;
      slope = slope + term * (2.0 / distance);
    }
    const Expr rest = 1.0 - others, strength2 = square(strength);
    const auto cubeRoot = [](const Expr& e) { return pow(e, 1.0 / 3.0); };
    // One of the two terms of s^2 rest + s^3 slope must reach half of strength^2; where rest < 0 the second
    // alone does all of it.
    const Expr shared = min(strength / sqrt(2.0 * max(rest, 1e-12)), cubeRoot(strength2 / (2.0 * slope)));
    const Expr alone = max(-rest / slope, cubeRoot(strength2 / slope));
    return select(less(0.0, rest), shared, alone) - shift;
  }

  // Newton's step for 1 / sqrt(S) = 1.
  Expr improved(const Expr& s) const {
    Expr value = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < weight.size(); ++i) {
      const Expr inverse = 1.0 / sum(s, i);
      const Expr term = square(weight[i] * inverse);
      value = value + term;
      slope = slope + term * inverse;
    }
    return s + value * (sqrt(value) - 1.0) / slope;
  }
};

Secular secularOf(const std::vector<Axis>& axes) {
  Secular f;
  const Expr& smallest = axes.front().radius;
  for (const Axis& a : axes) {
    f.weight.push_back(a.radius * a.coordinate);
    f.gap.push_back((a.radius - smallest) * (a.radius + smallest));
    f.radius.push_back(a.radius);
  }
  return f;
}

Expr rootOf(const Secular& f) {
  const std::size_t last = f.weight.size() - 1;
  // With every pole moved to the farthest S only falls, so that root is no larger.
  Expr total = square(f.weight[0]);
  for (std::size_t i = 1; i <= last; ++i) total = total + square(f.weight[i]);
  // Each term alone is at most 1 at the root.
  Expr s = max(f.weight[0], sqrt(total) - f.gap[last]);
  for (std::size_t i = 1; i <= last; ++i) s = max(f.weight[i] - f.gap[i], s);
  // max takes its second argument where the first is NaN, which a start far away may overflow to.
  s = max(f.start(f.weight[0], 1, 0.0), s);
  if (last == 2) s = max(f.start(length(f.weight[0], f.weight[1]), 2, f.gap[1]), s);
  for (int i = 0; i < kSteps; ++i) s = f.improved(s);
  return s;
}

}  // namespace

Expr ellipsoidDistance(std::vector<Expr> radii, std::vector<Expr> coordinates) {
  std::vector<Axis> axes = merged(radii, coordinates);
  if (axes.size() == 1) return (abs(axes[0].coordinate) - axes[0].radius).claimLipschitz(1.0);
  for (Axis& a : axes) a.coordinate = max(abs(a.coordinate), kOffPlane * a.radius);
  order(axes[0], axes[1]);
  if (axes.size() == 3) order(axes[1], axes[2]), order(axes[0], axes[1]);

  const Secular f = secularOf(axes);
  const Expr s = rootOf(f);
  // y - x = t y / (t + r^2), and t has the distance's sign.
  Expr squares = square(axes[0].coordinate / s);
  for (std::size_t i = 1; i < axes.size(); ++i) squares = squares + square(axes[i].coordinate / f.sum(s, i));
  return ((s - square(axes[0].radius)) * sqrt(squares)).claimLipschitz(1.0);
}

}  // namespace sdf
