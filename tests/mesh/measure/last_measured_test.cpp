#include "sdf/mesh/measure/last_measured.h"

#include <gtest/gtest.h>

#include "mesh/lattice_mesh.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/to_mesh.h"

namespace sdf::test {
namespace last_measured_test {

struct Ball : LatticeMesh {
  Ball() : LatticeMesh(sphere(1.0), 0.2) {}
  const std::vector<glm::vec3> points{{1.0f, 0.0f, 0.0f}, {0.0f, 0.6f, 0.8f}};
};

TEST(LastMeasured, IsWhatIsMeasured) {
  const Ball ball;
  Progress progress;
  LastMeasured last;
  MeshStats stats, expected;
  const std::vector<float> distances =
      measureDistance(ball.mesh.positions, ball.mesh.triangles, ball.field, progress, expected);
  EXPECT_EQ(last.fromMesh(ball.mesh, ball.field, progress, stats), distances);
  EXPECT_EQ(stats.maxDistance, expected.maxDistance);
  EXPECT_EQ(stats.rmsDistance, expected.rmsDistance);
  EXPECT_EQ(stats.farthest, expected.farthest);
  const auto far =
      farthestOfSurface(ball.points, ball.field, 2.0, ball.mesh.positions, ball.mesh.triangles, progress);
  const std::vector<FarPoint>& kept = last.fromSurface(ball.points, ball.mesh, ball.field, 2.0, progress);
  ASSERT_EQ(kept.size(), far.size());
  for (std::size_t i = 0; i < far.size(); ++i) EXPECT_EQ(kept[i].distance, far[i].distance);
}

// Nothing can be measured once progress is stopped.
TEST(LastMeasured, IsKeptForTheSameMeshAlone) {
  const Ball ball;
  LastMeasured last;
  MeshStats stats;
  Progress progress, stopped;
  stopped.stop();
  const std::vector<float> distances = last.fromMesh(ball.mesh, ball.field, progress, stats);
  const std::size_t points = last.fromSurface(ball.points, ball.mesh, ball.field, 2.0, progress).size();
  MeshStats again;
  EXPECT_EQ(last.fromMesh(ball.mesh, ball.field, stopped, again), distances);
  EXPECT_EQ(again.maxDistance, stats.maxDistance);
  EXPECT_EQ(last.fromSurface(ball.points, ball.mesh, ball.field, 2.0, stopped).size(), points);
  FeatureMesh moved = ball.mesh;
  moved.positions[0] *= 1.5f;
  last.fromMesh(moved, ball.field, progress, again);
  EXPECT_GT(again.maxDistance, 0.4);
  EXPECT_TRUE(last.fromSurface(ball.points, moved, ball.field, 2.0, stopped).empty());
}

}  // namespace last_measured_test
}  // namespace sdf::test
