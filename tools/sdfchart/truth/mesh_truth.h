// How far a mesh is from the surface that it stands for, by geometry that is not the library's own.
#pragma once
#include <memory>

#include "accuracy/meshes/mesh_cases.h"
#include "sdfchart/measure/subjects.h"
#include "sdfchart/row.h"

namespace sdf::chart {

/// A mesh of any mesher, and the normals that it would be shaded with.
struct JudgedMesh {
  accuracy::TriangleMesh mesh;
  /// Unit normals of the triangles' corners; empty: those of the facets.
  std::vector<std::array<glm::dvec3, 3>> normals{};
};

/// A surface that meshes are held to.
class MeshTruth {
 public:
  virtual ~MeshTruth() = default;
  /// Distance from p to the surface, not signed.
  virtual double distance(const glm::dvec3& p) const = 0;
  /// Unit normal of the surface near p, outward.
  virtual glm::dvec3 normal(const glm::dvec3& p) const = 0;
  /// Points uniform over the surface.
  virtual const std::vector<glm::dvec3>& points() const = 0;
  /// How far all this may be from the true surface, scene units.
  virtual double error() const = 0;
};

/// The truth of a subject, at so many points: the solid's definition where there is one
/// (accuracy/meshes/piecewise_solid.h), else a mesh with voxels of 1/400 of the longest side, whose distances
/// CGAL computes and whose error is that of its facets. Throws std::runtime_error where there is no surface.
std::unique_ptr<MeshTruth> truthOf(const Subject& subject, std::size_t points);

/// Fills the row's error figures: rms and max are the larger of both ways, mesh to surface and surface to
/// mesh; normal is the angle of the shading normals to the surface's, at points uniform over the mesh. Near
/// an edge of the surface the normal may be either side's. Throws std::runtime_error for a mesh without
/// triangles.
void judgeMesh(const JudgedMesh& mesh, const MeshTruth& truth, std::size_t points, Row& row);

}  // namespace sdf::chart
