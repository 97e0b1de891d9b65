// From the mesh of a lattice, whose triangles are of one size, to one whose triangles follow curvature.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

struct CoarsenOptions {
  double off;            ///< how far triangles may come to be from what the normals foretell, scene units
  bool painted = false;  ///< are colours held, too, to 3/4 of kColorTolerance at the vertices that go?
};

/// Takes out vertices where the normals of those around show that they are not needed: arcs are as far from
/// their chords as the normals at both ends say, and the vertex is as far from the triangles that it leaves.
/// All other vertices stay where they are, on the surface, and edges of creases only become longer along
/// them. The field is read once for each vertex, for its normal, and once for its colours: what the surface
/// does between vertices is not seen. Vertices that are farther from the surface than `off`, and those
/// around, stay: where a lattice does not resolve a crevice normals foretell nothing. Precondition: edges are
/// about as long everywhere. Cost: linear; about a microsecond a triangle, twice that with colours.
void coarsen(FeatureMesh& mesh, const LocalField& field, const CoarsenOptions& options, Progress& progress);

}  // namespace sdf
