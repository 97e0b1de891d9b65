// The distance to edges and corners where faces meet. Private to sdf/shape.
#pragma once
#include <optional>
#include <span>

#include "sdf/base/box.h"
#include "sdf/expr/vec.h"

namespace sdf {

/// A face: the distance to it near by, with a bound of its slope, and the direction of its gradient, of
/// length 1, if that is known.
struct Face {
  Expr distance;
  double slope = 1.0;
  std::optional<Vec3E> normal{};
  int solid = -1;  ///< of faces with the same number, edges and corners among themselves are known already
};

/// The greatest of the faces' distances, and outside of edges and corners the distance to these as far as
/// `reach`: with G the Gram matrix of the normals and d the distances it is the root of d^T G^-1 d where no
/// entry of G^-1 d is negative. The slope is claimed. Edges of curved faces that are sharper than a moderate
/// slope allows are taken for blunter, so that the distance falls short there. Edges that no cell of the
/// region can meet are left out; faces that are not flat have edges only if the region is finite. Nothing
/// where there is no edge or corner.
std::optional<Expr> aroundCorners(std::span<const Face> faces, const Box& region, double reach);

}  // namespace sdf
