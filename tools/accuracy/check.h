// Holds a shape's distance to a mesh of the same solid.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "reference.h"
#include "sdf/shape/shape.h"

namespace sdf::accuracy {

/// A shape, and its solid as a mesh that was not made from its formula.
struct ReferenceCase {
  std::string entry;  ///< catalog name
  std::string name;   ///< the entry and what it was given, for people: "torus 2, 0.01"
  Shape shape;
  TriangleMesh mesh;
  /// Proven Hausdorff distance between the mesh and the true surface; their distance functions differ by no
  /// more (0 for polyhedra).
  double chord = 0.0;
  /// Where formulas break: vertices, points of edges, centres, points of the medial axis and of symmetry
  /// planes.
  std::vector<glm::dvec3> special{};
};

/// What was found. Distances in scene units; d is the reference's signed distance.
struct Checked {
  std::uint64_t points = 0;
  double maxError = 0.0;      ///< of |f - d|, where the claim says exact
  double maxUlps = 0.0;       ///< the same, less the chord, in float ulps of |p|
  double tightness = 1.0;     ///< least f / d where |d| is well above the chord
  double lipschitz = 0.0;     ///< largest difference quotient
  std::uint64_t refuted = 0;  ///< points at which the claim does not hold
  std::string worst{};        ///< the first of them: where, f, d, what was allowed
};

/// Tries `points` points: near the surface at many scales, inside, around, far, on the symmetry planes, and
/// all of c.special and their neighbourhoods; by seed, in parallel. Each claim allows the chord and the
/// rounding of four float ulps of |p|.
Checked check(const ReferenceCase& c, std::uint64_t points, unsigned seed);

}  // namespace sdf::accuracy
