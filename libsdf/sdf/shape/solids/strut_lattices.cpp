// Struts along the edges of endless grids. Each grid is its own image in the planes of the cubic
// kaleidoscope, x = cell / 2 and its like, x = y and its like: space is folded by these into one chamber,
// where a few straight lines are left. What is nearest to a point of a chamber lies in the same one, for the
// image of any other place in it is no farther.
#include <algorithm>
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

// Distance from p to the line through a point with a unit direction.
Expr toLine(const Vec3E& p, const glm::dvec3& unit) {
  const Expr along = weighted(p, Vec3E(unit));
  const auto off = [&](const Expr& coordinate, double part) {
    return (coordinate - scaled(along, part)).claimLipschitz(1.0);
  };
  return norm(off(p.x, unit.x), off(p.y, unit.y), off(p.z, unit.z));
}

// Distance to the half of a strut that leads from its middle, the origin, in a unit direction, and to what
// would lead on from there the other way, beyond the chamber.
Expr toHalf(const Vec3E& p, const glm::dvec3& unit, const Expr& half) {
  const Expr along = weighted(p, Vec3E(unit)), held = min(along, half);
  const auto off = [&](const Expr& coordinate, double part) { return coordinate - scaled(held, part); };
  return norm(off(p.x, unit.x), off(p.y, unit.y), off(p.z, unit.z));
}

}  // namespace

Shape strutLattice(Struts kind, const Expr& cell, const Expr& radius) {
  Check c("strut_lattice");
  if (!c.positive("cell", cell).positive("radius", radius).ok()) return c.failure();
  const Expr size = positiveSize(cell);
  const auto folded = [&](const Expr& x) { return abs(x - round(x / size) * size).claimLipschitz(1.0); };
  const Vec3E p = position();
  const Expr x = folded(p.x), y = folded(p.y), z = folded(p.z);
  const Expr most = largest(x, y, z), least = min(min(x, y), z);
  // Where two are equal, each of the three has its gradient from another of them.
  const Expr between = (x + y + z - most - least).claimLipschitz(1.0);
  const Vec3E q{most, between, least};
  const Expr half = 0.5 * size, quarter = 0.25 * size;
  constexpr double kR2 = 0.5 * std::numbers::sqrt2, kR3 = std::numbers::inv_sqrt3;
  const auto distance = [&]() -> Expr {
    switch (kind) {
      case Struts::Cubic:
        return norm(between, least);
      case Struts::BodyCentred:
        return toLine(q, glm::dvec3(kR3));
      case Struts::Octet:
        return min(toLine(q, {kR2, kR2, 0.0}), toLine(q - Vec3E(half, half, 0.0), {0.0, -kR2, kR2}));
      case Struts::Kelvin:
        break;
    }
    // From (1/2, 1/8, 1/8) and (3/8, 3/8, 0) to where three edges meet, at (1/2, 1/4, 0).
    const Expr end = kR2 * quarter;
    return min(toHalf(q - Vec3E(half, 0.5 * quarter, 0.5 * quarter), {0.0, kR2, -kR2}, end),
               toHalf(q - Vec3E(1.5 * quarter, 1.5 * quarter, 0.0), {kR2, -kR2, 0.0}, end));
  };
  return solid(distance().claimLipschitz(1.0) - radius, Box::everything(), ClaimKind::ExactOutside);
}

}  // namespace sdf
