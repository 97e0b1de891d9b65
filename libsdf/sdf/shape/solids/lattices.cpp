// Triply periodic minimal surfaces by their usual trigonometric approximations (von Schnering, Nesper 1991;
// Lord, Mackay 2003), as walls. Each wave is divided by the largest length of its gradient, which makes L = 1
// and hence a bound.
#include <numbers>

#include "sdf/shape/check.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {

namespace {

// `steepest`: largest gradient of the wave per radian; `highest`: its largest value, of either sign.
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

// The largest gradients of these were looked for, and are proven by the tests, from the highest frequency
// that their squares have.

Shape iwp(const Expr& cell, const Expr& thickness) {
  const double steepest = 3.0 * std::numbers::sqrt3;  // at (2 pi / 3, 0, 0)
  return lattice("iwp", cell, thickness, steepest, 5.0, [](const Vec3E&, const Vec3E& c) {
    const Expr pairs = c.x * c.y + c.y * c.z + c.z * c.x, squares = square(c.x) + square(c.y) + square(c.z);
    return 2.0 * (pairs - squares) + 3.0;
  });
}

Shape neovius(const Expr& cell, const Expr& thickness) {
  return lattice("neovius", cell, thickness, 7.0, 13.0, [](const Vec3E&, const Vec3E& c) {
    return 3.0 * (c.x + c.y + c.z) + 4.0 * (c.x * c.y * c.z);
  });
}

Shape lidinoid(const Expr& cell, const Expr& thickness) {
  const double steepest = 1.5 * std::numbers::sqrt3;  // at 3 pi / 8 (1, 1, 1)
  return lattice("lidinoid", cell, thickness, steepest, 1.35, [](const Vec3E& s, const Vec3E& c) {
    const Vec3E twice{2.0 * square(c.x) - 1.0, 2.0 * square(c.y) - 1.0, 2.0 * square(c.z) - 1.0};
    const Expr sines = s.x * s.y * c.y * c.z + s.y * s.z * c.z * c.x + s.z * s.x * c.x * c.y;
    return sines - 0.5 * (twice.x * twice.y + twice.y * twice.z + twice.z * twice.x) + 0.15;
  });
}

Shape fischerKochS(const Expr& cell, const Expr& thickness) {
  return lattice(
      "fischer_koch_s", cell, thickness, 2.443973, std::numbers::sqrt2, [](const Vec3E& s, const Vec3E& c) {
        const Vec3E twice{2.0 * square(c.x) - 1.0, 2.0 * square(c.y) - 1.0, 2.0 * square(c.z) - 1.0};
        return twice.x * s.y * c.z + c.x * twice.y * s.z + s.x * c.y * twice.z;
      });
}

}  // namespace sdf
