#include "sdf/shape/triangle_solid.h"

#include "sdf/shape/check.h"

namespace sdf {

Shape triangleSolid(const std::shared_ptr<const MeshField>& field) {
  const TriangleDistance& distance = field->distance();
  const Vec3E p = position();
  Shape s;
  s.distance = Expr::payload({field}, {p.x, p.y, p.z});
  s.bounds = {distance.min(), distance.max()};
  s.claim = {distance.signBy() == SignBy::Normals ? ClaimKind::Exact : ClaimKind::Bound, 1.0, 1.0};
  return s;
}

Shape triangleSolid(const TriangleMesh& mesh, int voxels) {
  constexpr int kLeast = 16, kMost = 1024;
  Check c("mesh");
  c.that(voxels >= kLeast && voxels <= kMost,
         "voxels must be from 16 to 1024, got " + std::to_string(voxels));
  if (!c.ok()) return c.failure();
  ClosedTriangles triangles = closed(mesh);
  c.that(!triangles.triangles.empty(), "there is no triangle with an area");
  if (!c.ok()) return c.failure();
  const auto field = std::make_shared<const MeshField>(std::move(triangles), voxels);
  c.that(field->distance().hasInside(), "its triangles enclose nothing; give a mesh of a solid");
  return c.ok() ? triangleSolid(field) : c.failure();
}

}  // namespace sdf
