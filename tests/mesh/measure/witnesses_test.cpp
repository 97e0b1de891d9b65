#include "sdf/mesh/measure/witnesses.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sdf::test {
namespace witnesses_test {

// A square of two triangles at a height, whose diagonal is a crease.
FeatureMesh square(float height) {
  FeatureMesh mesh;
  mesh.positions = {{0, 0, height}, {1, 0, height}, {1, 1, height}, {0, 1, height}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.creases = {{0, 2}};
  return mesh;
}

Witnesses witnesses(const FeatureMesh& mesh, const std::vector<glm::vec3>& borders = {}) {
  return {{}, mesh, borders};
}

TEST(Witnesses, AreAsFarAsTheFarthestVertex) {
  Progress progress;
  FeatureMesh higher = square(0.0f);
  higher.positions[1].z = 0.25f;
  const SurfaceDistance d = witnesses(higher).toSurface(square(0.0f), progress);
  EXPECT_EQ(d.max, 0.25);
  EXPECT_EQ(d.farthest, higher.positions[1]);
  EXPECT_EQ(d.points, 4u);
  EXPECT_EQ(witnesses(higher).toBorders(square(0.0f), progress), 0.0);
}

TEST(Witnesses, OfBordersAreAsFarAsTheNextCrease) {
  Progress progress;
  const std::vector<glm::vec3> corner{{0, 0, 0.5f}};
  FeatureMesh other = square(0.0f);
  EXPECT_EQ(witnesses(other, corner).toBorders(other, progress), 0.5);
  other.creases = {{1, 3}};
  // Roundings of floats near 1.
  EXPECT_NEAR(witnesses(other, corner).toBorders(other, progress), std::hypot(0.5, std::sqrt(0.5)), 1e-6);
  EXPECT_EQ(witnesses(other).toBorders(other, progress), 0.0);
  other.creases.clear();
  EXPECT_EQ(witnesses(other, corner).toBorders(other, progress), HUGE_VAL);
  EXPECT_EQ(witnesses(other).toBorders(other, progress), 0.0);
}

}  // namespace witnesses_test
}  // namespace sdf::test
