// How much of a light reaches points: shadows, hard and soft.
#pragma once
#include <vector>

#include "sdf/base/result.h"
#include "sdf/march/march.h"

namespace sdf {

/// Share of the light that arrives, from the distances f met on the way to it, which goes by the steps g.
/// With k the sharpness, the light's angular radius is about atan(1 / k).
///
///   Hard: 0 where the ray hits, else 1.
///
///   Soft: least k f / t, at most 1; 0 where the ray hits (Quilez, "Soft shadows", 2010). Between readings,
///   where that is too light and shows as bands, it is the least of the parabola through the squares of three
///   f in a row of which the middle one's f / t is the least, but at least sqrt(3) / 2 of that: exact where a
///   point, a straight edge or a plane is nearest, whose squared distance along a ray is a parabola. Where k
///   f / t < 1 steps are 0.6 g.
///
///   Improved: at the readings the same, with the closest approach estimated between two samples (Aaltonen
///   2018). The balls of radius f' and f around samples s apart meet y = (s^2 + f^2 - f'^2) / (2 s) before
///   the second, at d = sqrt(max(0, f^2 - y^2)) from the ray; least k d / (t - y) where that is between the
///   two, else k f / t, for a ray that leaves a surface steeper than 1 would meet none. Aaltonen writes f'
///   for s. No bands, but up to 13 % too dark.
///
///   Signed: least x = k f / t, down to -1, the march going on through the solid; then (1 + x)^2 (2 - x) / 4
///   (Quilez 2010, later addition). At the edge of the solid half the light is seen, as of a disc. Light
///   leaks through solids thinner than about 2 t / k.
enum class ShadowMethod { Hard, Soft, Improved, Signed };

struct ShadowOptions {
  ShadowMethod method = ShadowMethod::Hard;
  double sharpness = 8.0;  ///< k, > 0
  double epsilon = 1e-4;   ///< a hit, and the least step where Signed crosses the surface; scene units, > 0
  int maxSteps = 512;      ///< readings a ray may take, > 0
};

/// Hit: no light. Miss: the ray came to its end. Budget: it did not, and nothing says that light arrives: it
/// is 0. Undefined: f was not a number, and the light is 0.
struct Shade {
  std::vector<double> light;  ///< 0 to 1
  std::vector<RayStatus> status;
};

/// Rays from the points towards a light far away (`towards` of any length but 0), for t from `start` to
/// `reach`.
Rays raysTowards(const Vectors& points, const glm::dvec3& towards, double start, double reach);
/// Rays from the points to a light at `position`, for t from `start` to the light (an empty range for points
/// nearer than `start`, or at the light itself).
Rays raysToPoint(const Vectors& points, const glm::dvec3& position, double start);

/// Marches the rays plainly in float SIMD batches, as Marcher does. Start a ray some epsilons off the
/// surface: a soft shadow darkens by k f / t from its start on. Errors: Usage (an option out of range, tMin =
/// 0 for a soft shadow, what checkRays finds), Scene (no known Lipschitz constant).
Result<Shade> shadows(const MarchField& field, const Rays& rays, const ShadowOptions& options);

}  // namespace sdf
