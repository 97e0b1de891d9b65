// Meshes held to the solids' definitions: how far each is from the other, beside what the mesher says of it.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "piecewise_solid.h"
#include "reference/reference.h"
#include "sdf/mesh/mesher.h"

namespace sdf::accuracy {

/// A shape, and the same solid written by hand.
struct MeshCase {
  std::string name;  ///< "S2", and what it is
  Shape shape;
  PiecewiseSolid solid;
  bool easy;  ///< tolerances are kept and proofs found, and soon
};

/// A box of these half sizes.
PiecewiseSolid boxSolid(const glm::dvec3& half);

/// The measuring shapes S1 to S5 (bench/shapes.h).
struct NamedMeshCase {
  std::string name;
  std::function<MeshCase()> make;
};
const std::vector<NamedMeshCase>& meshCases();

/// Distances over many points, scene units.
struct Spread {
  double rms = 0.0;
  double max = 0.0;
};

/// The mesh with each point once, however many normals it has there.
TriangleMesh weldedMesh(const Mesh& mesh);
/// Points of the mesh, uniform over its area; a seed gives the same points.
std::vector<glm::dvec3> pointsOn(const TriangleMesh& mesh, std::size_t count, unsigned seed);
/// Of distance(p) over all these points, taken in parallel.
Spread spreadOver(const std::vector<glm::dvec3>& points,
                  const std::function<double(const glm::dvec3&)>& distance);
/// From the mesh to the solid's surface: the root mean square over `points` points uniform over its area, the
/// maximum over these and all vertices.
Spread toSurface(const TriangleMesh& mesh, const PiecewiseSolid& solid, std::size_t points, unsigned seed);
/// From points of the solid's surface to the mesh; CGAL finds the nearest triangle.
Spread toMesh(const std::vector<glm::dvec3>& surface, const TriangleMesh& mesh);

/// One mesh of a case.
struct MeshRow {
  std::string shape;
  std::string asked;  ///< "128 voxels", "tolerance 0.001"
  MeshStats stats;    ///< provenDistance is 0 where nothing is proven
  Spread toSurface, toMesh;

  double farthest() const { return toSurface.max > toMesh.max ? toSurface.max : toMesh.max; }
  /// Something is farther off than is proven, beyond what distances to the definition are good for.
  bool refuted() const { return stats.provenDistance > 0.0 && farthest() > stats.provenDistance + 1e-9; }
};
/// Meshes of voxels that are 1/64 and 1/128 of the region's side; of an easy shape they are proven, and there
/// are meshes of tolerances of 0.01 and 0.001 that begin with the former. One Nth of the points, and of the
/// meshes the first where N is not 1. Throws std::runtime_error where the mesher refuses.
std::vector<MeshRow> meshRows(const NamedMeshCase& c, std::uint64_t fraction = 1);

}  // namespace sdf::accuracy
