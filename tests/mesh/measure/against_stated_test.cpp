// Faults of a mesh: who is blamed for them.
#include "sdf/mesh/measure/against_stated.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "mesh/feature_meshes.h"

namespace sdf::test {
namespace against_stated_test {

// A tetrahedron, about as large as the unit ball, and what is said of it.
struct Mesh {
  FeatureMesh mesh;
  std::vector<float> distances{0.1f, 0.1f, 0.1f, 0.1f};
  MeshStats stats;

  Mesh() {
    mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    stats.watertight = true;
    stats.farthest = mesh.positions[0];
  }

  std::optional<std::string> fault(const Shape& shape, const glm::dvec3& origin = glm::dvec3(0.0)) const {
    const Model model(shape);
    const auto found =
        faultOf({mesh, distances, stats, Box::centred(glm::dvec3(1.5)), 0.1, origin}, model.at());
    if (!found) return {};
    return found->what;
  }
};

// As steep as 1, which is what is stated of it.
Shape ball() { return field(length(position()) - 1.0, Box::centred(glm::dvec3(1.5)), 1.0); }
// Twice as steep as that.
Shape steepBall() { return field((length(position()) - 1.0) * 2.0, Box::centred(glm::dvec3(1.5)), 1.0); }

TEST(AgainstStated, FindsNoFaultOfWhatIsClosedAndNear) {
  Mesh m;
  m.stats.maxDistance = 0.29;
  EXPECT_FALSE(m.fault(ball()));
  EXPECT_FALSE(m.fault(steepBall()));
}

TEST(AgainstStated, BlamesNothingThatIsSeenToHold) {
  const std::string none =
      ", though nothing that is stated of the shape is seen to be false there; take a smaller voxel size";
  Mesh far;
  far.stats.maxDistance = 0.5;
  EXPECT_EQ(far.fault(ball()), "the mesh is off by about 0.5, 5 voxels, at (1, 1, 1)" + none);
  EXPECT_EQ(far.fault(ball(), {10, 0, 0}), "the mesh is off by about 0.5, 5 voxels, at (11, 1, 1)" + none);
  Mesh torn;
  torn.mesh.triangles.pop_back();
  torn.stats.watertight = false;
  const auto fault = torn.fault(ball());
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->find("the mesh is torn open at ("), 0u) << *fault;
  EXPECT_NE(fault->find(none), std::string::npos) << *fault;
}

TEST(AgainstStated, BlamesASlopeThatIsSeenToBeFalse) {
  Mesh far;
  far.stats.maxDistance = 0.5;
  const auto fault = far.fault(steepBall());
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->find("a unit of length, and what is stated of the shape allows 1. Enlarge the lipschitz"),
            std::string::npos)
      << *fault;
}

TEST(AgainstStated, BlamesBoundsThatTheSurfaceLeaves) {
  Mesh out;
  out.mesh.positions[0] = {1, 1, 2};
  out.distances[0] = 0.0f;
  const auto fault = out.fault(ball());
  ASSERT_TRUE(fault);
  EXPECT_EQ(*fault,
            "the surface leaves the bounds (-1.5, -1.5, -1.5) to (1.5, 1.5, 1.5) that are stated for "
            "it, at (1, 1, 2); enlarge the bounds of its field, leave them out, or intersect it with a box");
}

}  // namespace against_stated_test
}  // namespace sdf::test
