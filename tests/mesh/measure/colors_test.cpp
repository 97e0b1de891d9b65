#include "sdf/mesh/measure/colors.h"

#include <gtest/gtest.h>

#include "mesh/feature_meshes.h"

namespace sdf::test {
namespace colors_test {

// On the sides of a cube of half size 1; a wave of so many radians a unit.
Shape waves(double steepness) {
  const Expr x = position().x;
  return box(Vec3E(1.0)).paint({.color = {0.5 + 0.4 * sin(steepness * x), Expr(0.5), Expr(0.5)}});
}

bool keeps(const Shape& shape, const FeatureMesh& mesh, double voxel = 0.1) {
  Progress progress;
  return keepsColors(mesh, 1e-3, WholeField(shape, voxel), progress);
}

// Between two corners at a distance e a wave is off by about e^2 / 8 of its second derivative, which is 0.4
// of the steepness squared: of squares of an eighth 0.014 is seen of the steepness 3, a sixth of the colour's
// root.
TEST(Colors, AreKeptWhereTrianglesAreSmallEnough) {
  EXPECT_TRUE(keeps(waves(0.0), griddedCube(1)));
  EXPECT_FALSE(keeps(waves(3.0), griddedCube(1)));
  EXPECT_FALSE(keeps(waves(3.0), griddedCube(4)));
  EXPECT_TRUE(keeps(waves(3.0), griddedCube(16)));
  EXPECT_FALSE(keeps(waves(12.0), griddedCube(16)));
}

TEST(Colors, OfTrianglesAsSmallAsVoxelsAreNotLookedAt) {
  EXPECT_FALSE(keeps(waves(12.0), griddedCube(16), 0.17));
  EXPECT_TRUE(keeps(waves(12.0), griddedCube(16), 0.18));  // sides are 1/8, their diagonals 0.177
}

TEST(Colors, KeepNothingFromBeingStopped) {
  Progress progress;
  progress.stop();
  EXPECT_TRUE(keepsColors(griddedCube(4), 1e-3, WholeField(waves(12.0), 0.1), progress));
}

}  // namespace colors_test
}  // namespace sdf::test
