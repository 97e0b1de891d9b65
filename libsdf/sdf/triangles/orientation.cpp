#include "sdf/triangles/orientation.h"

#include <cmath>

#include "sdf/triangles/exact_sum.h"

namespace sdf {

int orientation(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  constexpr double kFilter = 4e-16;  // (3 + 16 e) e after Shewchuk, e = 2^-53
  const double ax = a.x, ay = a.y, bx = b.x, by = b.y, cx = c.x, cy = c.y;
  const double left = (bx - ax) * (cy - ay), right = (by - ay) * (cx - ax), area = left - right;
  if (std::abs(area) > kFilter * (std::abs(left) + std::abs(right))) return area > 0.0 ? 1 : -1;
  ExactSum sum;  // a double holds the product of two floats
  for (const double term : {bx * cy, -bx * ay, -ax * cy, -by * cx, by * ax, ay * cx}) sum.add(term);
  return sum.sign();
}

}  // namespace sdf
