// Holds a shape's distance to a mesh of the same solid.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/reference.h"
#include "sdf/shape/shape.h"

namespace sdf::accuracy {

/// The axis of a solid of revolution; the direction has length 1.
struct Axis {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 1.0, 0.0};
};

/// A solid as a mesh that was made from its geometric definition. Lengths in scene units.
struct Tessellation {
  /// A flat shape's mesh is its outline extruded along z; its `region` then stays far enough from the ends
  /// that they are never nearest. The same holds for a solid of revolution that has an `axis`: its outline is
  /// its profile, x being the distance from the axis and y the way along it.
  TriangleMesh mesh;
  /// Proven Hausdorff distance between the mesh and the true surface; their distance functions differ by no
  /// more (0 for polyhedra).
  double chord = 0.0;
  /// Where formulas break: vertices, points of edges, centres, points of the medial axis and of symmetry
  /// planes. In the mesh's coordinates, as is `region`.
  std::vector<glm::dvec3> special{};
  /// Where the mesh stands for the surface: for unbounded solids, which the mesh cuts off. Points are tried
  /// only here.
  Box region = Box::everything();
  std::optional<Axis> axis{};
};

/// A shape, and its solid as a mesh that was not made from its formula.
struct ReferenceCase : Tessellation {
  std::string name;  ///< what the shape is and what it was given, for people: "torus 2, 0.01"
  Shape shape;
};

/// What was found. Distances in scene units; f is the shape's distance at p read in double, d the reference's
/// signed distance. A float ulp of p is the step from its largest coordinate to the next float.
struct Checked {
  std::uint64_t points = 0;
  double maxError = 0.0;  ///< of |f - d|, where the claim says exact
  double maxUlps = 0.0;   ///< the same, less the chord, in float ulps of p
  double tightness =
      1.0;  ///< least (|f| + what is allowed) / |d| where |d| is at least 20 times that, at most 1
  double lipschitz = 0.0;  ///< largest difference quotient of f, over steps of 1e-4 to 0.3 sizes
  double floatUlps = 0.0;  ///< of the float reading's difference from f, in float ulps of p or of the mesh's
                           ///< largest coordinate, whichever is larger
  std::uint64_t refuted = 0;  ///< points at which the claim does not hold
  std::string worst{};        ///< the first of them: where, f, d, what was allowed

  /// Sums of the counts, the worst of each figure.
  void add(const Checked& more);
};

/// Tries `points` points: near the surface at many scales, inside, around, far (100 sizes), on symmetry
/// planes and axes, on the medial axis, and all of c.special with their neighbourhoods; by seed, in parallel,
/// with one result for any number of threads. Each claim allows the chord, four float ulps of p and the
/// rounding of doubles; the sign must be right wherever |d| is larger than that. Costs some 10 us a point.
Checked check(const ReferenceCase& c, std::uint64_t points, unsigned seed);

}  // namespace sdf::accuracy
