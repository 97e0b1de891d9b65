#include "sdf/mesh/thin.h"

#include <gtest/gtest.h>

#include "mesh/scenes.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/catalog.h"
#include "sdf/shape/deform.h"

namespace sdf::test {
namespace {

MeshedShape thinned(const Shape& shape, double voxel, double tolerance) {
  Progress progress;
  Result<MeshedShape> mesh = meshShape(shape, "part", {.voxelSize = voxel, .tolerance = tolerance}, progress);
  EXPECT_TRUE(mesh.ok()) << mesh.error().message;
  if (!mesh) return {};
  EXPECT_TRUE(mesh->stats.watertight && mesh->stats.manifold);
  EXPECT_LE(mesh->stats.maxDistance, tolerance);
  EXPECT_EQ(mesh->stats.crossings, 0u);
  return std::move(*mesh);
}

// Triangles of the lattice are smaller than what is a needle beside such tolerances.
TEST(Thin, TolerancesOfManyVoxelsLeaveFewTriangles) {
  for (const double tolerance : {0.1, 0.3, 2.0})
    EXPECT_LE(thinned(sphere(1.0), 0.04, tolerance).mesh.triangles.size(), 60u) << tolerance;
}

// A ball that waves rise from: where one ends an edge fades out.
TEST(Thin, EdgesThatFadeOutAreNotSplitIntoNeedles) {
  const Vec3E p = position();
  const Expr waves = sin(4.0 * p.x + 1.0) * sin(4.0 * p.y) * sin(4.0 * p.z + 2.0) +
                     0.5 * sin(9.0 * p.y + p.x) * sin(8.0 * p.z);
  const Shape planet = sphere(1.0) | displace(sphere(1.0), waves * -0.12);
  for (const double tolerance : {2e-3, 4e-3, 8e-3}) {
    const MeshedShape m = thinned(planet, 0.03, tolerance);
    // Three times what a ball needs for each octave.
    EXPECT_LE(static_cast<double>(m.mesh.triangles.size()), 12.0 / tolerance) << tolerance;
  }
}

// A rim about as thin as the tolerance, and letters through the wall that stand out by less.
TEST(Thin, StepsAndRimsBelowTheToleranceDoNotCross) {
  const Shape cup = subtract(
      {round(cylinder(0.72, 0.8), 0.06), translate(round(cylinder(0.7, 0.8), 0.04), {0.0, 0.12, 0.0})},
      Blend::quadratic(0.05));
  const Shape letter = box({0.3, 0.03, 1.0}) | rotate(box({0.03, 0.3, 1.0}), {0.0, 0.0, 0.2});
  const Shape standing = subtract({letter & cylinder(0.815, 0.5), cylinder(0.74, 2.0)});
  for (const double tolerance : {4e-3})
    EXPECT_LE(thinned(cup | standing, 0.025, tolerance).mesh.triangles.size(), 4000u) << tolerance;
}

}  // namespace
}  // namespace sdf::test
