// The light that a scene's background gives to surfaces.
#pragma once
#include <array>
#include <glm/vec3.hpp>

#include "sdf/eval/function.h"
#include "sdf/scene/scene.h"

namespace sdf {

/// Light from all around by the unit normal n of what it falls on, in the terms of Scene::ambient, linear
/// RGB: the mean of the radiance over the hemisphere about n, weighted by the cosine. A background of one
/// colour gives that colour.
struct BackgroundLight {
  /// The factors of 1, x, y, z, xy, yz, zx, 3 z^2 - 1 and x^2 - y^2 of the normal.
  std::array<glm::dvec3, 9> parts{};

  /// The light at this normal; not negative.
  glm::dvec3 at(const glm::dvec3& normal) const;
  bool operator==(const BackgroundLight&) const = default;
};

/// The light that Scene::background sends: a function of the direction, held in x, y and z, with three
/// outputs.
Function backgroundRadiance(const Scene& scene);

/// The light of a radiance, a tape of backgroundRadiance: its spherical harmonics up to the second order,
/// which carry 99 % of what a cosine lets through (Ramamoorthi, Hanrahan, "An efficient representation for
/// irradiance environment maps", 2001). Exact for radiance that is quadratic in the direction; a small sun is
/// a sixteenth too bright for what faces it, and a tenth or less of its light gets to what faces away. The
/// coefficients are sums over 16,384 directions in double, so that what is smaller than a degree may be
/// missed. Radiance that is negative or not a number counts as none. Cost: some milliseconds.
BackgroundLight backgroundLight(const Tape& radiance);
/// The same of a scene at its present values.
BackgroundLight backgroundLight(const Scene& scene);

}  // namespace sdf
