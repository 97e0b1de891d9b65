// Shapes that are only moved, turned and scaled, seen from their distances. Private to shape/.
#pragma once
#include "sdf/expr/gradient.h"

namespace sdf {

inline bool isUniform(const Expr& e) { return !dependsOnSpace(e); }

/// f without a factor that does not depend on space.
inline Expr withoutFactor(Expr f) {
  if (f.op() == Op::Mul && isUniform(f.arg(0))) f = f.arg(1);
  if (f.op() == Op::Mul && isUniform(f.arg(1))) f = f.arg(0);
  return f;
}

/// Is e a linear function of the position?
inline bool isLinear(const Expr& e) {
  const Vec3E g = gradientOf(e);
  return isUniform(g.x) && isUniform(g.y) && isUniform(g.z);
}

}  // namespace sdf
