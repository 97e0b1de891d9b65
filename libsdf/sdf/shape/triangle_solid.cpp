#include "sdf/shape/triangle_solid.h"

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

}  // namespace sdf
