// Formulas that do not depend on the position, read at the parameters' present values.
#pragma once
#include <glm/vec3.hpp>

#include "sdf/expr/vec.h"

namespace sdf::test {

inline glm::dvec3 uniform(const Vec3E& v) {
  return {uniformValue(v.x), uniformValue(v.y), uniformValue(v.z)};
}

}  // namespace sdf::test
