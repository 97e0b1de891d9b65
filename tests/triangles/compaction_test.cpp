#include "sdf/triangles/compaction.h"

#include <gtest/gtest.h>

namespace sdf::test {
namespace compaction_test {

TEST(Compaction, DropsWhatNoTriangleHas) {
  std::vector<glm::uvec3> triangles{{5, 1, 3}, {3, 1, 6}};
  const Compaction left = dropUnusedVertices(triangles, 8);
  EXPECT_EQ(left.before, (std::vector<std::uint32_t>{1, 3, 5, 6}));
  constexpr std::uint32_t kNone = Compaction::kNone;
  EXPECT_EQ(left.after, (std::vector<std::uint32_t>{kNone, 0, kNone, 1, kNone, 2, 3, kNone}));
  EXPECT_EQ(triangles, (std::vector<glm::uvec3>{{2, 0, 1}, {1, 0, 3}}));
}

TEST(Compaction, TakesWhatVerticesHaveAlong) {
  std::vector<glm::uvec3> triangles{{5, 1, 3}};
  const Compaction left = dropUnusedVertices(triangles, 6);
  std::vector<int> all{0, 1, 2, 3, 4, 5}, none, ofTheFirst{0, 1, 2, 3};
  left.apply(all), left.apply(none), left.apply(ofTheFirst);
  EXPECT_EQ(all, (std::vector<int>{1, 3, 5}));
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(ofTheFirst, (std::vector<int>{1, 3}));
}

TEST(Compaction, OfNoTrianglesLeavesNothing) {
  std::vector<glm::uvec3> triangles;
  EXPECT_TRUE(dropUnusedVertices(triangles, 3).before.empty());
}

}  // namespace compaction_test
}  // namespace sdf::test
