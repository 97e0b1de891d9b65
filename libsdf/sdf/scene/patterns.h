// Colours that vary over space, for materials, and backgrounds, where position() stands for the ray's unit
// direction.
#pragma once
#include <optional>

#include "sdf/expr/lattice_noise.h"
#include "sdf/expr/vec.h"

namespace sdf {

/// Squares of two colours in x and z, as on a floor; `side` > 0 is a square's length in scene units.
Vec3E checkerboard(const Vec3E& a, const Vec3E& b, const Expr& side = 1.0);

/// From a to b as `along`, a formula of the position, goes from `from` to `to`; constant beyond.
Vec3E gradient(const Expr& along, const Vec3E& a, const Vec3E& b, const Expr& from = 0.0,
               const Expr& to = 1.0);

/// A smooth irregular number in [-1, 1] that varies over about one unit of p. Each further octave adds detail
/// half as large and half as strong. Made of sines of slope of order one, so that float and double agree: the
/// usual hash, the fraction of a large multiple of a sine, differs between them at every point. octaves >= 1.
Expr noise(const Vec3E& p, int octaves = 1);

struct Octaves {
  int count = 1;        ///< 1 or more, as of `noise`
  bool ridged = false;  ///< is each 1 - 2 |n|, with sharp ridges where n is 0?
  std::uint32_t seed = 0;
};
/// Noise on a lattice of cells of side 1, which sums octaves by their mean. Several octaves and ridges are
/// for values and gradients.
Expr latticeNoise(LatticeNoise::Kind kind, const Vec3E& p, const Octaves& octaves = {});

/// A background: `bottom` straight down, `top` straight up.
Vec3E verticalGradient(const Vec3E& bottom, const Vec3E& top);

struct Sky {
  Vec3E horizon{Expr(0.7), Expr(0.8), Expr(0.9)};
  Vec3E zenith{Expr(0.15), Expr(0.35), Expr(0.7)};
  std::optional<Vec3E> ground{};                    ///< below the horizon; none: the horizon's colour
  std::optional<Vec3E> sun{};                       ///< towards the sun, any length but 0
  Vec3E sunColor{Expr(1.0), Expr(0.9), Expr(0.7)};  ///< added where the ray meets the sun
  Expr sunSize = 256.0;                             ///< exponent of its glow; larger is smaller
};
/// A background with a horizon and perhaps a sun.
Vec3E skyColor(const Sky& sky);

}  // namespace sdf
