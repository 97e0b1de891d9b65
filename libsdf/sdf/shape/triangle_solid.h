// Triangle meshes as shapes.
#pragma once
#include <memory>

#include "sdf/shape/shape.h"
#include "sdf/triangles/mesh_field.h"

namespace sdf {

/// The solid that the field's triangles wind around, in the default material. Exact, with L = 1, where
/// normals tell its sides; else a bound, for triangles may lie within it. The exact distance is what is
/// meshed and computed on the CPU; shaders read the field's samples.
Shape triangleSolid(const std::shared_ptr<const MeshField>& field);

/// The same of a mesh whose holes are closed. Fails if it has no triangle with an area, or its triangles wind
/// around nothing. `voxels` (16 to 1024): of a shader's samples along the longest side. Cost: n log n.
Shape triangleSolid(const TriangleMesh& mesh, int voxels = 128);

}  // namespace sdf
