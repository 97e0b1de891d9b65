// Whether what a graph describes has only moved from one moment to another.
#pragma once
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "sdf/expr/expr.h"

namespace sdf {

/// Turns, then moves: p becomes rotation * p + translation.
struct RigidMotion {
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< of length 1
  glm::dvec3 translation{0.0};

  glm::dvec3 operator()(const glm::dvec3& p) const { return rotation * p + translation; }
};

/// The rigid motion m by which each of `after` is the one of `before` at its place, moved: after(m(p),
/// m.rotation * n) = before(p, n) for all points p and normals n. Found from the graphs: where both are
/// affine in the position or in the normal their coefficients are compared, to within 1e-10 of their size,
/// and elsewhere the operations, one by one. So a motion that is found holds everywhere, but one may be
/// missed if the graphs are not written alike. Of several, as a ball has, it is the one that turns least from
/// `near`. Nothing where there is none, or where a body without extent along some way, such as a plane,
/// leaves it open how it moved. Cost: the size of the graphs.
std::optional<RigidMotion> motionBetween(std::span<const Expr> before, std::span<const Expr> after,
                                         const RigidMotion& near = {});

/// A number that lists of graphs share where motionBetween finds a motion, and rarely else: the operations
/// without what is affine. Cost: the size of the graphs.
std::size_t hashWithoutMotion(std::span<const Expr> graphs);

}  // namespace sdf
