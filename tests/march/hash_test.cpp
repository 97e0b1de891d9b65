// Rays to a formula that floats give other values of.
#include <gtest/gtest.h>

#include <cmath>

#include "sdf/march/march.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace march_hash_test {

double hash(double i, double k) {
  const double h = std::sin(i * 12.9898 + k * 78.233) * 43758.5453;
  return h - std::floor(h);
}

// 81 towers, each of its own height, from above.
TEST(MarchedHash, RaysMeetTheTowersOfTheFormula) {
  const auto [x, y, z] = position();
  const Expr i = floor(x * 0.5 + 0.5), k = floor(z * 0.5 + 0.5),
             h = sin(i * 12.9898 + k * 78.233) * 43758.5453;
  const Expr sides = max(abs(x - 2.0 * i), abs(z - 2.0 * k)) - 0.6, height = 1.0 + 3.0 * (h - floor(h));
  const Shape towers = field(max(sides, abs(y) - height), Box::everything(), 8.0);
  auto marcher = Marcher::make(intersect(towers, box({9.0, 5.0, 9.0})), {});
  ASSERT_TRUE(marcher.ok());
  Rays rays;
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) rays.add({2.0 * i + 0.1, 6.0, 2.0 * k - 0.2}, {0.0, -1.0, 0.0}, 0.0, 12.0);
  const auto hits = marcher->trace(rays);
  ASSERT_TRUE(hits.ok());
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const int i = static_cast<int>(r) / 9 - 4, k = static_cast<int>(r) % 9 - 4;
    EXPECT_EQ(hits->status[r], RayStatus::Hit);
    EXPECT_NEAR(6.0 - hits->t[r], 1.0 + 3.0 * hash(i, k), 2e-3) << i << ", " << k;
  }
}

}  // namespace march_hash_test
}  // namespace sdf
