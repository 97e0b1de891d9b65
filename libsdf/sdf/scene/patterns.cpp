#include "sdf/scene/patterns.h"

namespace sdf {

Vec3E checkerboard(const Vec3E& a, const Vec3E& b, const Expr& side) {
  const Vec3E p = position();
  const Expr odd = mod(floor(p.x / side) + floor(p.z / side), 2.0);
  return {select(odd, b.x, a.x), select(odd, b.y, a.y), select(odd, b.z, a.z)};
}

Vec3E gradient(const Expr& along, const Vec3E& a, const Vec3E& b, const Expr& from, const Expr& to) {
  return mix(a, b, clamp((along - from) / (to - from), 0.0, 1.0));
}

namespace {

// The mean of three sines along directions at right angles, with wave numbers in no simple ratio; two more
// sines bend their phases, so that no period shows.
Expr sines(const Vec3E& p) {
  const Expr u = 2.3 * (0.36 * p.x + 0.48 * p.y + 0.80 * p.z);
  const Expr v = 2.9 * (-0.80 * p.x + 0.60 * p.y);
  const Expr w = 2.6 * (-0.48 * p.x - 0.64 * p.y + 0.60 * p.z);
  const Expr bend = sin(0.73 * (u - v) + 1.7), turn = cos(0.61 * (v + w) + 0.4);
  const Expr sum = sin(u + 1.3 * turn) + sin(v + 1.1 * bend) + sin(w + 1.2 * bend * turn + 0.9);
  // No gradient is longer, whatever the phases of the three sines and of the two that bend them.
  constexpr double kSlope = 3.82;
  return (sum * (1.0 / 3.0)).claimLipschitz(kSlope * stretchOf(p));
}

// The mean of octaves, each of which is octave(place, its number).
template <class Octave>
Expr meanOf(const Vec3E& p, int octaves, const Octave& octave) {
  // Not quite doubled, and moved along, so that octaves do not line up.
  constexpr double kFrequencyStep = 2.03, kWeightStep = 0.5, kShift = 5.1;
  Expr sum = 0.0;
  double weight = 1.0, total = 0.0, frequency = 1.0;
  for (int i = 0; i < octaves; ++i) {
    sum = sum + weight * octave(p * Expr(frequency) + Vec3E(Expr(kShift * i)), i);
    total += weight;
    weight *= kWeightStep;
    frequency *= kFrequencyStep;
  }
  return sum * (1.0 / total);
}

}  // namespace

Expr noise(const Vec3E& p, int octaves) {
  return meanOf(p, octaves, [](const Vec3E& at, int) { return sines(at); });
}

Expr latticeNoise(LatticeNoise::Kind kind, const Vec3E& p, const Octaves& octaves) {
  return meanOf(p, octaves.count, [&](const Vec3E& at, int i) {
    const auto noise = LatticeNoise::of(kind, octaves.seed + static_cast<std::uint32_t>(i));
    const Expr n =
        Expr::payload({noise}, {at.x, at.y, at.z}).claimLipschitz(noise->lipschitz() * stretchOf(at));
    return octaves.ridged ? 1.0 - 2.0 * abs(n) : n;
  });
}

Vec3E verticalGradient(const Vec3E& bottom, const Vec3E& top) {
  return mix(bottom, top, clamp(0.5 + 0.5 * position().y, 0.0, 1.0));
}

Vec3E skyColor(const Sky& sky) {
  constexpr double kGroundEdge = 8.0;  // the ground is reached an eighth below the horizon
  const Vec3E ray = position();
  Vec3E color = mix(sky.horizon, sky.zenith, sqrt(max(ray.y, 0.0)));
  color = mix(color, sky.ground.value_or(sky.horizon), clamp(ray.y * -kGroundEdge, 0.0, 1.0));
  if (!sky.sun) return color;
  const Expr facing = max(dot(ray, *sky.sun) / length(*sky.sun), 0.0);
  return color + sky.sunColor * pow(facing, sky.sunSize);
}

}  // namespace sdf
