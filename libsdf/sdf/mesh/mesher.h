// From a shape to a coloured triangle mesh, with its error measured.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sdf/base/box.h"
#include "sdf/base/progress.h"
#include "sdf/base/result.h"
#include "sdf/mesh/mesh.h"
#include "sdf/model/model.h"
#include "sdf/shape/shape.h"

namespace sdf {

struct MeshOptions {
  /// Scene units; 0 takes 1/200 of the longest side of the bounds. With a tolerance a small shape, and a
  /// small piece of a union that lies apart, has smaller ones, if it is not clipped.
  double voxelSize = 0.0;
  /// Distance between mesh and surface to be kept with few triangles, scene units; voxels are halved up to
  /// three times for it, and for what is thinner than they are. 0: none.
  double tolerance = 0.0;
  /// Is a tolerance that cannot be kept everywhere an error (Limits)? Otherwise it is kept where it can be,
  /// and voxels are not halved for the rest where that would take long; stats.maxDistance tells what was
  /// reached.
  bool strict = true;
  /// Has a mesh from a file that is only moved, turned and scaled its own triangles, whatever the tolerance?
  /// Else it has those where others that keep the tolerance are no fewer.
  bool keepsFiles = false;
  std::optional<Box> bounds{};  ///< clips the shape, closed and watertight
  Values values{};              ///< of the shape's inputs; its bounds hold for all in their ranges
  bool certify = false;  ///< also prove the mesh's two-sided distance to the surface (stats.provenDistance)
  double maxMemory = 16.0 * (1ull << 30);  ///< bytes; refused (ErrorKind::Limits) if the estimate is above
};

struct MeshedShape {
  Mesh mesh;
  MeshStats stats;
  std::vector<std::pair<std::string, double>> stageSeconds;
};

/// Box that contains the shape's surface: its own bounds, tightened or (for fields) found by interval
/// arithmetic, as far as 2^40 from the origin. Infinite sides remain where the shape is unbounded.
Box findBounds(const Shape& shape);

/// What is meshed of a shape within a box: the shape, or where it may leave the box, the shape cut by its
/// sides.
Shape clipped(const Shape& shape, const Box& box);

/// Meshes one shape. Normals are exact gradients where the mesh shows the surface that they belong to, else
/// those of the facets. `name` is used in messages ("part 'floor' is unbounded in x and z: …"). Runs on the
/// calling thread's oneTBB arena; the result does not depend on the number of threads. With a tolerance, what
/// lies apart in a union is meshed alone (pieces.h); stages' times are summed over it. What is stated of a
/// field, its bounds and its slope, is relied on, and found out where the mesh leaves the bounds, is not
/// closed or is farther from the surface than a right one can be. Errors: Scene (failed shape, unbounded, no
/// surface, false statements), Limits (memory, a distance that cannot be proven), Interrupted.
Result<MeshedShape> meshShape(const Shape& shape, const std::string& name, const MeshOptions& options,
                              Progress& progress);

}  // namespace sdf
