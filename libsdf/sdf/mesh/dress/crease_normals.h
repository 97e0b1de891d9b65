// Vertices and normals of a mesh with creases.
#pragma once
#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Fills positions, triangles, welded, copyOf and normals from a mesh with creases. A vertex on a crease is
/// repeated for each of the fans of triangles that the creases leave around it, with the gradient a little
/// inside the fan; any other has the gradient at its place. Normals are fitted (fitNormals), of a mesh with a
/// `tolerance` (0: none), whose triangles span more than voxels, to the gradients all over the triangles
/// (fitToGradients).
void splitAtCreases(const FeatureMesh& features, const LocalField& field, float tolerance, Progress& progress,
                    Mesh& mesh);

}  // namespace sdf
