#include "sdf/mesh/measure/solid.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sdf/gltf/part.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {
namespace solid_test {

MeshStats statsOf(const Shape& shape, const MeshOptions& options) {
  Progress progress;
  return meshShape(shape, "part", options, progress).value().stats;
}

TEST(MeasureSolid, OfABoxIsItsOwn) {
  const MeshStats stats =
      statsOf(translate(box({1.0, 0.5, 0.25}), {3.0, -2.0, 100.0}), {.voxelSize = 0.1, .tolerance = 1e-3});
  // Corners are floats, those at z = 100 within 4e-6.
  // A face of 2 by 1 that is off by that has 8e-6 of the volume; each side adds it twice to the area's 7.
  EXPECT_NEAR(stats.volume, 1.0, 2e-5);
  EXPECT_NEAR(stats.area, 7.0, 1e-4);
  EXPECT_NEAR(glm::distance(stats.centreOfMass, glm::dvec3(3.0, -2.0, 100.0)), 0.0, 1e-5);
}

// What the mesh is off by is a shell around the surface.
TEST(MeasureSolid, OfAHalfBallIsWithinItsDistance) {
  const double pi = std::numbers::pi;
  const Shape half = intersect(sphere(1.0), translate(box({2.0, 1.0, 2.0}), {0.0, 1.0, 0.0}));
  // The surface has the area 3 pi, each part of which is off by the tolerance at most; a ball's mesh of that
  // sagitta lacks about as much of its area.
  const MeshStats stats = statsOf(half, {.voxelSize = 0.05, .tolerance = 1e-3});
  EXPECT_NEAR(stats.volume, 2.0 / 3.0 * pi, 3.0 * pi * 1e-3);
  EXPECT_NEAR(stats.area, 3.0 * pi, 1e-2 * pi);
  EXPECT_NEAR(stats.centreOfMass.x, 0.0, 1e-3);
  EXPECT_NEAR(stats.centreOfMass.y, 3.0 / 8.0, 1e-3);
}

TEST(MeasureSolid, OfPiecesIsTheirSum) {
  const Shape two = unite(box({0.5, 0.5, 0.5}), translate(box({0.5, 0.5, 1.0}), {4.0, 0.0, 0.0}));
  const MeshStats stats = statsOf(two, {.voxelSize = 0.1, .tolerance = 1e-3});
  // Corners are floats, those at x = 4 within 5e-7.
  EXPECT_NEAR(stats.volume, 3.0, 1e-5);
  EXPECT_NEAR(stats.centreOfMass.x, 8.0 / 3.0, 1e-5);
  const MeshStats both = combined(std::vector<MeshStats>{stats, stats});
  EXPECT_EQ(both.volume, 2.0 * stats.volume);
  EXPECT_EQ(both.area, 2.0 * stats.area);
  EXPECT_NEAR(both.centreOfMass.x, stats.centreOfMass.x, 1e-12);
}

// An open mesh encloses nothing.
TEST(MeasureSolid, OfAnOpenMeshIsItsArea) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  MeshStats stats;
  measureSolid(mesh, stats);
  EXPECT_EQ(stats.area, 0.5);
  EXPECT_EQ(stats.volume, 0.0);
}

}  // namespace solid_test
}  // namespace sdf::test
