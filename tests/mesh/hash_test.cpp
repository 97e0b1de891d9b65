// Formulas that floats give other values of, from their samples to their colours.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/scenes.h"

namespace sdf::test {
namespace hash_test {

double hash(double i, double k) {
  const double h = std::sin(i * 12.9898 + k * 78.233) * 43758.5453;
  return h - std::floor(h);
}

Expr hash(const Expr& i, const Expr& k) {
  const Expr h = sin(i * 12.9898 + k * 78.233) * 43758.5453;
  return h - floor(h);
}

// 25 towers, each of its own height, and of its own red.
Shape city() {
  const auto [x, y, z] = position();
  const Expr i = floor(x * 0.5 + 0.5), k = floor(z * 0.5 + 0.5);
  const Vec3E q{abs(x - 2.0 * i) - 0.6, abs(y) - (1.0 + 3.0 * hash(i, k)), abs(z - 2.0 * k) - 0.6};
  const Shape field =
      sdf::field(length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0), Box::everything(), 8.0);
  return intersect(field, box({5.0, 5.0, 5.0})).paint({.color = {hash(k, i), 0.5, 0.5}});
}

TEST(Hash, TowersAreAsHighAndAsRedAsTheFormulaSays) {
  Progress progress;
  const auto meshed = meshShape(city(), "city", {.voxelSize = 0.15}, progress);
  ASSERT_TRUE(meshed.ok()) << meshed.error().message;
  const Mesh& mesh = meshed->mesh;
  EXPECT_EQ(meshed->stats.components, 25);
  double height[5][5] = {};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3 p(mesh.positions[v]);
    const int i = static_cast<int>(std::floor(p.x * 0.5 + 0.5)),
              k = static_cast<int>(std::floor(p.z * 0.5 + 0.5));
    double& most = height[i + 2][k + 2];
    most = std::max(most, p.y);
    EXPECT_NEAR(mesh.colors[v].x, hash(k, i), 1e-4) << i << ", " << k;
  }
  for (int i = -2; i <= 2; ++i)
    for (int k = -2; k <= 2; ++k)
      EXPECT_NEAR(height[i + 2][k + 2], 1.0 + 3.0 * hash(i, k), 1e-4) << i << ", " << k;
  EXPECT_LE(meshed->stats.maxDistance, 1e-4);
}

}  // namespace hash_test
}  // namespace sdf::test
