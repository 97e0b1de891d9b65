// Triply periodic minimal surfaces by their usual trigonometric approximations (von Schnering, Nesper 1991),
// as walls. Each wave is divided by the largest length of its gradient, which makes L = 1 and hence a bound.
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

// `steepest`: largest gradient of the wave per radian; `highest`: its largest value.
template <class Wave>
Shape lattice(const char* name, const Expr& cell, const Expr& thickness, double steepest, double highest,
              Wave wave) {
  const double fills = highest / (steepest * std::numbers::pi);
  Check c(name);
  c.positive("cell", cell).positive("thickness", thickness);
  if (!c.below("thickness", thickness, shown(fills) + " cell", fills * cell).ok()) return c.failure();
  const Expr frequency = 2.0 * std::numbers::pi / positiveSize(cell);
  const Vec3E p = position() * frequency;
  const Vec3E sine{sin(p.x), sin(p.y), sin(p.z)}, cosine{cos(p.x), cos(p.y), cos(p.z)};
  const Expr height = wave(sine, cosine) * (1.0 / (steepest * frequency));
  return solid(abs(height.claimLipschitz(1.0)) - 0.5 * thickness, Box::everything(), ClaimKind::Bound);
}

}  // namespace

Shape gyroid(const Expr& cell, const Expr& thickness) {
  // d/dx = cos x cos y - sin x sin z, whose square is at most cos^2 y + sin^2 z (Cauchy, Schwarz); the three
  // add up to 3. Its largest value is 3/2, at x = y = z = pi / 4.
  return lattice("gyroid", cell, thickness, std::numbers::sqrt3, 1.5,
                 [](const Vec3E& s, const Vec3E& c) { return s.x * c.y + s.y * c.z + s.z * c.x; });
}

Shape schwarzP(const Expr& cell, const Expr& thickness) {
  return lattice("schwarz_p", cell, thickness, std::numbers::sqrt3, 3.0,
                 [](const Vec3E&, const Vec3E& c) { return c.x + c.y + c.z; });
}

Shape schwarzD(const Expr& cell, const Expr& thickness) {
  // With X = cos 2x and so on and T = sin 2x sin 2y sin 2z, the squared gradient is (3 - XY - YZ - ZX + 3 T)
  // / 4. Let m = (X^2 + Y^2 + Z^2) / 3. Then -XY - YZ - ZX <= 3 m / 2, and T <= (1 - m)^(3/2) <= 1 - m by the
  // inequality of means, so the gradient is at most sqrt(6) / 2.
  return lattice("schwarz_d", cell, thickness, std::numbers::sqrt2 * std::numbers::sqrt3 / 2.0, 1.0,
                 [](const Vec3E& s, const Vec3E& c) { return c.x * c.y * c.z - s.x * s.y * s.z; });
}

}  // namespace sdf
