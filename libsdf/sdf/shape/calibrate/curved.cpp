#include "sdf/shape/calibrate/curved.h"

#include <array>

#include "sdf/expr/gradient.h"
#include "sdf/shape/calibrate/forms.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"

namespace sdf {
namespace {

Vec3E cross(const Vec3E& a, const Vec3E& b) {
  return {scaled(a.y, b.z) - scaled(a.z, b.y), scaled(a.z, b.x) - scaled(a.x, b.z),
          scaled(a.x, b.y) - scaled(a.y, b.x)};
}

// Bound of |J^T grad log |J^T n|| over all n that stay as they are: of t^T N t in each direction, with N the
// derivative of A = J^T times the inverse of A, and t of length 1.
Expr turnOf(const Warp& warp) {
  std::array<Vec3E, 3> column, row;  // of A, of its inverse times the determinant
  for (int i = 0; i < 3; ++i) {
    Vec3E axis(0.0);
    component(axis, i) = 1.0;
    column[i] = warp.pulled(axis);
  }
  for (int i = 0; i < 3; ++i) row[i] = cross(column[(i + 1) % 3], column[(i + 2) % 3]);
  const Expr inverse = 1.0 / weighted(column[0], row[0]);
  // Of each entry of N the gradient's direction is that of the derivative.
  const auto entry = [&](int k, int j) {
    Vec3E sum(0.0);
    for (int i = 0; i < 3; ++i)
      sum = sum + scaled(gradientOf(component(column[i], k)), scaled(component(row[i], j), inverse));
    return sum;
  };
  Expr squares = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      const Vec3E g = warp.pulled(scaled(entry(k, j) + entry(j, k), 0.5));
      squares = squares + weighted(g, g);
    }
  return sqrt(squares);
}

}  // namespace

// With v = f + offset, n its gradient, s = |J^T n| and u the usual slope, the value is c / s + (v - c) / u: c
// is v near the surface and falls to 0 half as fast beyond. Of its gradient, J^T n has the factor
// - 1 / s where c is v: a vector of length 1,
// - (rho - (1 - rho) / 2) / s with rho = s / u where c falls, at most (3 shear - 1) / 2 / s,
// - 1 / u where c is 0.
// To that comes c / s^2 times the gradient of s: for a J that turns at most turnOf / s; for an n that turns
// J^T H J J^T n, with H n = 0 and |H| at most 1 / f or 1 / inner. What of J J^T n is at right angles to n is
// at most (q - 1 / q) / 2 of what is along n, q being the ratio of the largest stretch to the least (Wielandt
// 1953). All of this falls with rho, so that the sum is the largest at an end of its range.
std::optional<CurvedPart> curvedPart(const Expr& f, const Expr& offset, const Warp& warp, double share) {
  const auto inner = innerRadius(f);
  if (!inner || share == 0.0 || !(offset.range().hi < 0.0)) return {};
  // Where c is v and where it is 0 again, in sizes. It is at most a third of f: at either end of where it is
  // v.
  constexpr double kIn = 0.25, kInEnd = 0.75, kOut = 0.5, kOutEnd = 1.5, kMostOfF = 1.0 / 3.0;
  const Expr &u = warp.usual, &shear = warp.shear, &least = warp.least;
  const Expr radius = -offset, size = radius * share, v = f + offset;
  const Expr end = min(size * kOutEnd, warp.reach), near = end * (kOut / kOutEnd);
  const Expr below = clamp((v + size * kInEnd) * 0.5, 0.0, size * kIn);
  const Expr above = clamp((end - v) * 0.5, 0.0, near);
  const bool isLimited = !inner->isConstant();
  const Expr c = isLimited ? clamp(v, -min(below, *inner), min(above, *inner)) : clamp(v, -below, above);
  // Where the gradient is not known, at infinity, max leaves the least.
  const Expr s = max(least * u, warp.stretchAlong(gradientOf(f)));

  const Expr most = max(max(min(below, -v), min(above, v)), 0.0);  // of |c|
  const Expr q = shear / least, aside = (q - 1.0 / q) * 0.5;
  const Expr atSlope = scaled(abs(v) / u, warp.climb(u));
  Expr bend = min(most / max(f, radius - size * kInEnd), kMostOfF), limited = 0.0;
  if (isLimited) {
    const Expr tiny = size * 1e-3;
    bend = max(bend, select(less(*inner, tiny), 1.0, min(most / max(*inner, tiny), 1.0)));
    // Where c is `inner`, it changes with that.
    limited = select(less(most, *inner), 0.0, shear * max(1.0 - 1.0 / shear, 1.0 / least - 1.0));
  }
  const Expr turning = scaled(most / (least * u), turnOf(warp)) + bend * q * aside;
  const Expr beside = max(1.0 + turning, shear * 1.5 - 0.5 + turning / q) + limited + atSlope;
  const Expr isNear = min(lessEqual(-size * kIn, v), lessEqual(v, near));
  const Expr isWhole = isLimited ? min(isNear, less(most, *inner)) : isNear;
  const Expr slope = select(isWhole, 1.0 + turning, select(less(0.0, most), beside, shear + atSlope));
  return CurvedPart{c / s + (v - c) / u, slope};
}

}  // namespace sdf
