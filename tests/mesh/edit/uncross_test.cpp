#include "sdf/mesh/edit/uncross.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "mesh/feature_meshes.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/surface/project.h"

namespace sdf::test {
namespace uncross_test {

TEST(Uncross, PutsBackWhatWasMovedThroughOtherTriangles) {
  FeatureMesh mesh = griddedCube(10);
  const std::vector<glm::vec3> before = mesh.positions;
  // One point of a face goes out through the face opposite, another moves within its own.
  std::uint32_t far = 0, near = 0;
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    if (glm::distance(before[v], {1.0f, 0.0f, 0.0f}) < 1e-3f) far = v;
    if (glm::distance(before[v], {0.0f, 1.0f, 0.0f}) < 1e-3f) near = v;
  }
  mesh.positions[far].x = -1.2f;
  mesh.positions[near].x += 0.05f;
  ASSERT_FALSE(crossingTriangles(mesh.positions, mesh.triangles).empty());
  uncrossMoved(mesh, {far, near}, before);
  EXPECT_EQ(crossingTriangles(mesh.positions, mesh.triangles), TrianglePairs{});
  EXPECT_EQ(mesh.positions[far], before[far]);
  EXPECT_NE(mesh.positions[near], before[near]);
}

// Knife edges all around a wall that a ball cuts: cut sharp, some of its triangles would cross.
TEST(Uncross, LeavesNoCrossingsAndDoesNotDependOnTheNumberOfThreads) {
  const Shape shape = rotate(latticeBall(), {0.3, 0.5, 0.7});
  const auto by = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Progress progress;
    NarrowBand band = bandOf(shape, region(1.6), 1.0 / 24);
    const BandField field(band, wholeTapes(tapeOf(shape)));
    RawSurface raw = band.extract();
    const std::vector<glm::vec3> extracted = raw.points;
    std::vector<glm::vec3> normals;
    refineVertices(raw.points, normals, field, progress);
    return sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, field, progress);
  };
  const Sharpened one = by(1), many = by(8);
  EXPECT_EQ(crossingTriangles(one.mesh.positions, one.mesh.triangles), TrianglePairs{});
  EXPECT_FALSE(one.doubtful.empty());
  EXPECT_EQ(one.mesh.positions, many.mesh.positions);
  EXPECT_EQ(one.mesh.triangles, many.mesh.triangles);
  EXPECT_EQ(one.mesh.creases, many.mesh.creases);
  EXPECT_EQ(one.doubtful, many.doubtful);
}

}  // namespace uncross_test
}  // namespace sdf::test
