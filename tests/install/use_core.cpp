// A program that only evaluates scenes: it must build without the mesher's dependencies.
#include <cstdio>

#include "sdf/expr/vec.h"

int main() {
  const sdf::Expr unitSphere = sdf::length(sdf::position()) - 1.0;
  const bool proven = unitSphere.lipschitz() >= 1.0 && unitSphere.range().contains(-1.0);
  std::printf("the unit sphere's distance: at least %g, Lipschitz %g\n", unitSphere.range().lo,
              unitSphere.lipschitz());
  return proven ? 0 : 1;
}
