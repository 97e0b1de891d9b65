#include "sdf/mesh/refine/close_creases.h"

#include <gtest/gtest.h>

#include "mesh/feature_meshes.h"

namespace sdf::test {
namespace close_creases_test {

TEST(CloseCreases, ClosesGaps) {
  const FeatureMesh whole = griddedCube(3);
  FeatureMesh mesh = whole;
  mesh.creases.erase(mesh.creases.begin() + 7);
  closeCreases(mesh);
  EXPECT_EQ(mesh.creases, whole.creases);
}

// Around the tip of a cone a coarse mesh turns as much, and has no crease.
TEST(CloseCreases, MakesNoneWhereThereAreNone) {
  Sewn s;
  const glm::vec3 x(1.0f, 0.0f, 0.0f), y(0.0f, 1.0f, 0.0f), z(0.0f, 0.0f, 1.0f);
  for (const auto& [a, b] : {std::pair{x, z}, {z, -x}, {-x, -z}, {-z, x}})
    s.triangle(a, y, b), s.triangle(a, b, -y);
  FeatureMesh mesh = s.take();
  closeCreases(mesh);
  EXPECT_TRUE(mesh.creases.empty());
}

}  // namespace close_creases_test
}  // namespace sdf::test
