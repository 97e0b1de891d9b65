// Points in which a surface ends that bends around them: the tips of cones.
#pragma once
#include <cstdint>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// Puts a vertex onto each tip that is within four voxels of the mesh, with a fan around it in the place of
/// the triangles there, and of islands that it swallows. A tip is where all tangent planes around meet in one
/// point and turn all the way round: planes at the vertices about give the first place (least squares,
/// Garland and Heckbert 1997), planes of the exact gradients ever closer to it the next ones. Corners of flat
/// faces are none; creases meet in these, and what is on a crease stays. `normals` are the vertices'; they
/// become zero at tips, which are marked (FeatureMesh::tips). `doubtful` vertices keep their meaning where
/// the mesh's numbers change (sharpen.h). Cost: one pass over the triangles, and 24 readings for each vertex
/// that is nearest to where the planes meet around one by which normals turn by more than 25 degrees.
void placeTips(FeatureMesh& mesh, std::vector<glm::vec3>& normals, std::vector<std::uint32_t>& doubtful,
               const LocalField& field, Progress& progress);

}  // namespace sdf
