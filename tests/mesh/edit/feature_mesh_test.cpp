// What stages that change a mesh have in common.
#include "sdf/mesh/edit/feature_mesh.h"

#include <gtest/gtest.h>

#include "mesh/feature_meshes.h"
#include "sdf/mesh/edit/indices-inl.h"

namespace sdf::test {
namespace feature_mesh_test {

TEST(FeatureMesh, DropsWhatIsGoneWithAllThatBelongsToIt) {
  FeatureMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},
                   .triangles = {{0, 0, 0}, {1, 3, 4}},
                   .creases = {{1, 3}, {3, 4}},
                   .tips = {0, 1, 0, 1}};
  std::vector<glm::vec3> normals{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {0, 4, 0}};
  const std::vector<std::uint32_t> after = dropUnused(mesh, &normals);
  constexpr std::uint32_t kNone = Compaction::kNone;
  EXPECT_EQ(after, (std::vector<std::uint32_t>{kNone, 0, kNone, 1, 2}));
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{1, 0, 0}, {3, 0, 0}, {4, 0, 0}}));
  EXPECT_EQ(normals, (std::vector<glm::vec3>{{0, 1, 0}, {0, 3, 0}, {0, 4, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(mesh.creases, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(mesh.tips, (std::vector<char>{1, 1}));
}

TEST(FeatureMesh, TrianglesFaceNormalsUpTo60Degrees) {
  for (const float size : {1e-6f, 1.0f, 1e6f})
    for (int degrees = 0; degrees <= 180; degrees += 5) {
      if (degrees == 60) continue;
      const float angle = 3.14159265f / 180.0f * static_cast<float>(degrees);
      const glm::vec3 normal(std::sin(angle), std::cos(angle), 0.0f), area(0.0f, size, 0.0f);
      EXPECT_EQ(isFacing(area, normal), degrees < 60) << degrees;
      EXPECT_EQ(isFacing(glm::dvec3(area), glm::dvec3(normal)), degrees < 60) << degrees;
    }
  EXPECT_FALSE(isFacing(glm::vec3(0, 1, 0), glm::vec3(0.0f)));
}

TEST(Collected, IsInTheOrderOfTheNumbersWhateverTheChunks) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kIndexChunk, 3 * kIndexChunk + 7}) {
    const auto found = collected<std::uint32_t>(count, [](std::uint32_t i, std::vector<std::uint32_t>& out) {
      for (std::uint32_t k = 0; k < i % 3; ++k) out.push_back(i);
    });
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < count; ++i) expected.insert(expected.end(), i % 3, i);
    EXPECT_EQ(found, expected);
    const auto odd = indicesThat(count, [](std::uint32_t i) { return i % 2 == 1; });
    EXPECT_EQ(odd.size(), count / 2);
    EXPECT_TRUE(std::ranges::is_sorted(odd));
  }
}

}  // namespace feature_mesh_test
}  // namespace sdf::test
