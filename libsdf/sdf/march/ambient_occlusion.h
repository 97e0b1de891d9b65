// How much of its surroundings a point of a surface sees: 1 all, 0 nothing.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "sdf/base/result.h"
#include "sdf/march/march.h"
#include "sdf/march/shadow.h"

namespace sdf {

/// From the steps that the rays to the points took: max(0, 1 - strength * steps). Free, and no more than a
/// look: creases and grazing rays take many steps. strength >= 0. Errors (Usage): strength.
Result<std::vector<double>> occlusionBySteps(std::span<const int> steps, double strength);

/// What a tap at height h = i spacing counts for, f being the distance there or, of a field steeper than 1, h
/// where f says more:
///
///   Halving   (h - f) / 2^i: near taps count most (Evans, "Fast approximations for global illumination on
///             dynamic scenes", 2006, with five taps)
///   Relative  (h - f) / h: the missing share of the height, all taps alike; with strength 1 / count a point
///             against a wall gets nothing (Learn Creative Coding 40, "Raymarching: Materials and Lighting")
enum class TapWeights { Halving, Relative };

struct TapOptions {
  int count = 5;          ///< samples along the normal, > 0
  double spacing = 0.08;  ///< between them, scene units, > 0
  double strength = 1.0;  ///< >= 0
  TapWeights weights = TapWeights::Halving;
};

/// 1 - strength * sum over i = 1 … count of what tap i at p + i spacing n counts for, held to [0, 1]. A plane
/// alone leaves 1. A value that is not a number counts as nothing seen. Errors: Usage (options, rows of
/// different length, normals not of length 1), Scene (no known Lipschitz constant). Cost: `count` readings a
/// point.
Result<std::vector<double>> occlusionByTaps(const MarchField& field, const Vectors& points,
                                            const Vectors& normals, const TapOptions& options);

struct OcclusionRayOptions {
  int count = 256;         ///< rays a point, > 0
  double cutoff = 1.0;     ///< how far they look, scene units, > `start`
  double start = 1e-3;     ///< where they leave the surface along its normal, scene units, >= 0
  std::uint64_t seed = 1;  ///< the same seed gives the same rays on any machine
  MarchOptions march;      ///< how they are marched
};

/// Share of rays, cosine-weighted about the normal, that meet nothing within the cutoff: what the others
/// approximate. Its standard deviation is at most 0.5 / sqrt(count). A ray counts as free only on a Miss; a
/// point's status is Budget or Undefined where one of its rays was, else Miss. Errors: Usage (options, rows
/// of different length, normals not of length 1), Scene (what Marcher::make finds). Cost: `count` marches a
/// point.
Result<Shade> occlusionByRays(const MarchField& field, const Vectors& points, const Vectors& normals,
                              const OcclusionRayOptions& options);

}  // namespace sdf
