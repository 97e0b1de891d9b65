// How far a mesh is from the surface that it stands for, all over it.
#pragma once
#include <vector>

#include "sdf/shape/shape.h"
#include "viewer/render/scene_mesh.h"
#include "viewer/render/shown_mesh.h"

namespace sdf::viewer {

/// ErrorFigures sum up the distances of a mesh's points to the surface, scene units, negative inside.
struct ErrorFigures {
  static constexpr std::size_t kBins = 48;

  double least = 0.0, most = 0.0;
  double rms = 0.0;        ///< weighted by area
  double tolerance = 0.0;  ///< that they are compared with; 0: none
  /// What the colours reach to, to either side: the tolerance, or the first of 1, 2 and 5 times a power of
  /// ten that 99 % of the area keeps.
  double limit = 1.0;
  /// Shares of the area: beyond the limit on the inner side, kBins from there to the limit on the outer one,
  /// and beyond that.
  std::vector<double> histogram;
  std::size_t triangles = 0;  ///< of the mesh
  bool operator==(const ErrorFigures&) const = default;
  double beyond() const { return histogram.front() + histogram.back(); }
};

/// MeshErrors are the points that were measured, as smaller triangles whose vertices have their distances,
/// and what came of it.
struct MeshErrors {
  ShownMesh shown;
  ErrorFigures figures;
};

/// Measures each part's mesh against the part, at its vertices and within its triangles: in the middle, of
/// those that are longer than 1/300 of the diagonal at points as close as that. Each is the distance in
/// double where the part's is exact, else it divided by its slope there, and where that is below half of its
/// bound the way along the gradient to the surface. Errors: Interrupted.
Result<MeshErrors> measureErrors(const SceneMesh& mesh, Progress& progress);
/// The same of a mesh that stands for a scene's whole shape, compared with a tolerance (0: none). Errors:
/// Interrupted.
Result<MeshErrors> measureErrors(const TriangleMesh& mesh, const Shape& whole, double tolerance,
                                 Progress& progress);

}  // namespace sdf::viewer
