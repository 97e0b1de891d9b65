// The tree over triangles.
#include "sdf/triangles/tree.h"

#include <gtest/gtest.h>

#include "support/triangle_meshes.h"

namespace sdf::test {
namespace tree_test {

// From the least floats to the largest, and specks beside what is large.
TEST(TriangleTree, FindsTheNearestTriangleAtAnyScale) {
  std::mt19937 random(3);
  for (const float scale : {1e-44f, 1e-40f, 1e-20f, 1.0f, 1e18f, 1e37f}) {
    TriangleMesh mesh = bumpyTorus(12);
    for (glm::vec3& p : mesh.positions) p *= scale;
    for (const float beside : {0.0f, 1.0f}) {
      if (beside > 0.0f) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& p : {glm::vec3(0.0f), glm::vec3(beside, 0, 0), glm::vec3(0, beside, 0)})
          mesh.positions.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
      }
      const TriangleTree tree(mesh.positions, mesh.triangles);
      for (int i = 0; i < 50; ++i) {
        const glm::dvec3 p = randomIn(random, 2.0) * static_cast<double>(scale);
        double least = std::numeric_limits<double>::infinity();
        for (const glm::uvec3& t : mesh.triangles)
          least = std::min(
              least, nearestOf(p, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]).squared);
        ASSERT_EQ(tree.nearest(p).squared, least) << scale << " " << beside;
      }
    }
  }
}

}  // namespace tree_test
}  // namespace sdf::test
