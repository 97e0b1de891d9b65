// Colours and materials of a mesh.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/eval/function.h"
#include "sdf/mesh/edit/feature_mesh.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/shape/shape.h"

namespace sdf {

/// Fills colors, ambient, triangleMaterial and materials, orders the triangles by material, and repeats
/// vertices where materials meet (copyOf), each copy coloured on its own side of the border. positions,
/// normals, triangles and welded are given, the triangles in the features' order; of these materials and
/// colours are taken. `values` are the inputs' that the field was made for. Once progress is stopped the mesh
/// may be left unfinished.
void colorMesh(const Shape& shape, const FeatureMesh& features, const Values& values, const LocalField& field,
               Progress& progress, Mesh& mesh);

/// Fills triangleMaterial and materials of a coloured mesh, and orders the triangles by material. `numbers`
/// are those of each triangle's material among the shape's, `values` as above.
void takeMaterials(const Shape& shape, const std::vector<int>& numbers, const Values& values, Mesh& mesh);

}  // namespace sdf
