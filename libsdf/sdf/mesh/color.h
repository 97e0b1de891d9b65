// Materials on a mesh, from the same attribute expressions that the viewer draws.
#pragma once
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface_points.h"
#include "sdf/model/model.h"

namespace sdf {

/// Fills colors, triangleMaterial and materials, orders the triangles by material, and repeats vertices where
/// materials meet (copyOf), each copy coloured on its own side of the border. positions, normals, triangles
/// and welded are given; `values` are the inputs' that the field was made for. Once progress is stopped the
/// mesh may be left unfinished.
void colorMesh(const Shape& shape, const Values& values, const LocalField& field, Progress& progress,
               Mesh& mesh);

}  // namespace sdf
