// Triangle meshes as shapes.
#pragma once
#include <array>
#include <memory>
#include <optional>

#include "sdf/shape/shape.h"
#include "sdf/triangles/mesh_field.h"

namespace sdf {

/// The mesh's colour, the mean over its area, with colours of vertices and textures; and the like of its
/// other numbers. Highlights are those of glTF's rough surfaces in Phong's terms: exponent (1 / roughness^4 -
/// 1) / 2, as bright as energy allows. A metal mirrors in its colour, by Schlick; the share that is its
/// roughness it scatters.
Material meanMaterial(const TriangleMesh& mesh);

/// A mesh that is only moved, turned and scaled.
struct PlacedMesh {
  std::shared_ptr<const MeshField> field;
  std::array<Expr, 3> at;  ///< its own coordinates of the scene's position, linear functions of that
};

/// The distance f, which has no claims, as that of a mesh that was only moved, turned and scaled, if it is.
std::optional<PlacedMesh> placedMesh(Expr f);
/// Has the shape the material that triangleSolid gave it?
bool hasOwnMaterial(const Shape& shape, const MeshField& field);

/// The solid that the field's triangles wind around, in its meanMaterial. Exact, with L = 1, where
/// normals tell its sides; else a bound, for triangles may lie within it. The mesher and
/// everything else on the CPU read the exact distance; shaders read the field's samples.
Shape triangleSolid(const std::shared_ptr<const MeshField>& field);

}  // namespace sdf
