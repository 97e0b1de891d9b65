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

}  // namespace sdf
