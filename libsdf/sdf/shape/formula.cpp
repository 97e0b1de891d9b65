#include "sdf/shape/formula.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sdf {

double upper(const Expr& e) { return e.range().nan ? kInfinity : e.range().hi; }
double lower(const Expr& e) { return e.range().nan ? -kInfinity : e.range().lo; }

Expr positiveSize(const Expr& size) { return lower(size) > 0.0 ? size : max(size, kSmallestSize); }

Expr scaled(const Expr& a, const Expr& factor) {
  if (a.isConstant(0.0) || factor.isConstant(0.0)) return 0.0;
  return factor.isConstant(-1.0) ? -a : a * factor;
}

Vec3E scaled(const Vec3E& v, const Expr& factor) {
  return {scaled(v.x, factor), scaled(v.y, factor), scaled(v.z, factor)};
}

Expr weighted(const Vec3E& v, const Vec3E& weights) {
  return scaled(v.x, weights.x) + scaled(v.y, weights.y) + scaled(v.z, weights.z);
}

Expr norm(const Expr& a, const Expr& b) { return length(a, b).claimLipschitz(1.0); }
Expr norm(const Expr& a, const Expr& b, const Expr& c) { return length(a, b, c).claimLipschitz(1.0); }

Expr largest(const Expr& a, const Expr& b, const Expr& c) { return max(max(a, b), c); }

Expr beyond(const Expr& a, const Expr& limit) {
  // a - clamp(a) grows with a at slope 0 or 1.
  return (a - clamp(a, 0.0, limit)).claimLipschitz(a.lipschitz());
}

Expr segmentDistance(const Expr& out, const Expr& past) { return max(out, norm(out, past)); }

Expr boxDistance(const Expr& x, const Expr& y) { return boxDistance({x, y}, 1.0); }
Expr boxDistance(const Expr& x, const Expr& y, const Expr& z) { return boxDistance({x, y, z}, 1.0); }

Expr boxDistance(const std::vector<Expr>& sides, double slope) {
  const auto off = [&](int i) { return max(sides[i], 0.0); };
  const bool plane = sides.size() == 2;
  const Expr corner = plane ? length(off(0), off(1)) : length(off(0), off(1), off(2));
  const Expr most = plane ? max(sides[0], sides[1]) : largest(sides[0], sides[1], sides[2]);
  return (corner.claimLipschitz(slope) + min(most, 0.0)).claimLipschitz(slope);
}

namespace {

// Distance to a half-line, from that to its line and how far its end is passed; negative on its inner side.
Expr pastOrOut(const Expr& out, const Expr& past) {
  return (norm(max(out, 0.0), max(past, 0.0)) + min(out, 0.0)).claimLipschitz(1.0);
}

}  // namespace

Expr cornerDistance(const Expr& a, const Expr& b, const Expr& cosine, const Expr& sine) {
  const Expr out = max(a, b);
  // Along the edge that is nearer, past the corner. Where `out` is not positive nor is this, however rounded.
  const Expr past = scaled(min(a, b), 1.0 / sine) - scaled(out, cosine / sine);
  return pastOrOut(out, past.claimLipschitz(1.0));
}

Expr insideOr(const Expr& inside, const Expr& outside) {
  return select(lessEqual(inside, 0.0), inside, outside).claimLipschitz(1.0);
}

Expr trapezoidDistance(const Expr& across, const Expr& along, const Expr& bottom, const Expr& top,
                       const Expr& half) {
  const Expr run = bottom - top, rise = half + half;
  const Expr slant = length(run, rise);
  const Expr x = across - top, y = along - half;
  // The distance out of the slanted side.
  const Expr out = (scaled(x, rise / slant) + scaled(y, run / slant)).claimLipschitz(1.0);
  const Expr atBottom = cornerDistance(-along - half, out, -run / slant, rise / slant);
  if (!top.isConstant(0.0)) return max(atBottom, cornerDistance(out, y, run / slant, rise / slant));
  // The tip's two sides are folded on each other.
  const Expr past = (scaled(y, rise / slant) - scaled(across, run / slant)).claimLipschitz(1.0);
  return max(atBottom, pastOrOut(out, past));
}

Expr roundConeDistance(const Expr& across, const Expr& along, const Expr& bottom, const Expr& top,
                       const Expr& half) {
  const Expr height = half + half;
  const Expr steep = clamp((bottom - top) / height, -kSteepestCone, kSteepestCone);  // the slope's sine
  // The ball between the two, of radius bottom - steep * s, that comes closest to the point.
  const Expr s = clamp(along + half - scaled(across, steep / sqrt(1.0 - square(steep))), 0.0, height);
  // Between the balls this is across / cos(slope).
  const double steepest = std::max(upper(steep), -lower(steep));
  const Expr toCentre =
      length(across, along + half - s).claimLipschitz(1.0 / std::sqrt(1.0 - steepest * steepest));
  const Expr distance = toCentre + scaled(s, steep) - bottom;
  // What has become of the ball at the top is smaller than it where it holds the other.
  return upper(top - bottom - height) < 0.0 ? distance : min(distance, norm(across, along - half) - top);
}

Expr arcDistance(const Expr& along, const Expr& across, const Expr& radius, const Expr& angle) {
  const Expr side = abs(across), s = sin(angle), c = cos(angle);
  const Expr within = lessEqual(side * c, along * s);
  const Expr toCircle = abs(norm(along, across) - radius);
  const Expr toEnd = norm(along - radius * c, side - radius * s);
  return select(within, toCircle, toEnd).claimLipschitz(1.0);
}

double arcReach(const Expr& radius, const Expr& angle) {
  const double widest = upper(angle), smallest = std::max(lower(radius), 0.0);
  if (widest <= std::numbers::pi / 2) return smallest;
  return widest < std::numbers::pi ? smallest * std::sin(widest) : 0.0;
}

std::pair<glm::dvec2, glm::dvec2> arcBounds(const Expr& radius, const Expr& angle, double half) {
  const double widest = upper(angle), most = upper(radius), end = std::cos(widest);
  const double side = most * (widest < std::numbers::pi / 2 ? std::sin(widest) : 1.0) + half;
  const double back = (end < 0.0 ? most : std::max(lower(radius), 0.0)) * end - half;
  return {{-side, back}, {side, most + half}};
}

ClaimKind tubeKind(const Expr& radius, double reach) {
  return upper(radius) <= reach ? ClaimKind::Exact : ClaimKind::ExactOutside;
}

Wedge foldDihedral(const Expr& along, const Expr& across, int sides) {
  Wedge w{along, abs(across)};
  // Angles [0, m pi / sides] are folded in half about a symmetry line until m = 1.
  for (int m = sides; m > 1;) {
    m = (m + 1) / 2;
    if (2 * m == sides) {
      w.along = abs(w.along);
      continue;
    }
    const double angle = m * std::numbers::pi / sides;
    const double s = std::sin(angle), c = std::cos(angle);
    const Expr above = max((w.across * c - w.along * s).claimLipschitz(1.0), 0.0);
    w.along = (w.along + above * (2.0 * s)).claimLipschitz(1.0);
    w.across = (w.across - above * (2.0 * c)).claimLipschitz(1.0);
  }
  return w;
}

Expr regularPolygonDistance(const Expr& along, const Expr& across, int sides, const Expr& radius) {
  const Wedge w = foldDihedral(along, across, sides);
  const double s = std::sin(std::numbers::pi / sides), c = std::cos(std::numbers::pi / sides);
  const Expr out = (w.along * c + w.across * s).claimLipschitz(1.0) - radius * c;
  // Past the corner, along the side; where `out` is not positive nor is this, however rounded.
  const Expr sideways = (out * (s / c) - w.across * (1.0 / c)).claimLipschitz(1.0);
  return pastOrOut(out, sideways);
}

std::pair<glm::dvec2, glm::dvec2> regularPolygonBounds(int sides) {
  glm::dvec2 lo(0.0), hi(0.0);
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const glm::dvec2 corner(std::sin(angle), std::cos(angle));
    lo = glm::min(lo, corner);
    hi = glm::max(hi, corner);
  }
  return {lo, hi};
}

Shape solid(const Expr& distance, const Box& bounds, ClaimKind kind) {
  Shape s;
  s.distance = distance.claimLipschitz(1.0);
  s.bounds = bounds;
  s.claim.kind = kind;
  return s;
}

Shape flat(const Expr& distance, const glm::dvec2& min, const glm::dvec2& max, ClaimKind kind) {
  Shape s = solid(distance, {{min, -kInfinity}, {max, kInfinity}}, kind);
  s.dimension = 2;
  return s;
}

}  // namespace sdf
