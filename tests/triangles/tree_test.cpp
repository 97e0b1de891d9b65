// The tree over triangles.
#include "sdf/triangles/tree.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "sdf/triangles/triangle_pairs.h"
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

// Boxes of triangles on one edge hold one another; planes tell them apart.
TEST(TriangleTree, FindsTheNearestOfManyOnAnEdge) {
  std::mt19937 random(9);
  TriangleMesh mesh;
  mesh.positions = {{0.0f, 0.0f, -1.0f}, {0.0f, 0.0f, 1.0f}};
  constexpr int kCount = 500;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.1 * std::sin(5.0 * angle));
    const auto third = static_cast<std::uint32_t>(i + 2);
    mesh.triangles.emplace_back(i % 2, 1 - i % 2, third);  // by turns one way and the other
  }
  const TriangleTree tree(mesh.positions, mesh.triangles);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = randomIn(random, i % 2 ? 0.1 : 1.5);
    double least = std::numeric_limits<double>::infinity();
    for (const glm::uvec3& t : mesh.triangles)
      least = std::min(least,
                       nearestOf(p, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]).squared);
    ASSERT_EQ(tree.nearest(p).squared, least);
  }
}

// What is near enough is any triangle that is; what is not is the nearest one.
TEST(TriangleTree, StopsAtWhatIsNearEnough) {
  std::mt19937 random(4);
  const TriangleMesh mesh = bumpyTorus(24);
  const TriangleTree tree(mesh.positions, mesh.triangles);
  int stopped = 0;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p = randomIn(random, 2.0);
    const NearestPoint nearest = tree.nearest(p), some = tree.nearest(p, 0, 0.04);
    if (nearest.squared > 0.04) {
      ASSERT_EQ(some.squared, nearest.squared);
      ASSERT_EQ(some.triangle, nearest.triangle);
    } else {
      ASSERT_LE(some.squared, 0.04);
      stopped += some.triangle != nearest.triangle;
    }
  }
  EXPECT_GT(stopped, 0);
}

// So many triangles around a tip, side by side; with `twisted`, each turned about its way from there, so that
// some run through others.
TriangleMesh triangleFan(std::uint32_t count, double twisted) {
  TriangleMesh fan;
  fan.positions.emplace_back(0.0f, 1.0f, 0.0f);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double width = 2.0 * std::numbers::pi / count;
    for (const double side : {0.0, 1.0}) {
      const double angle = (i + side) * width, height = twisted * (side - 0.5) * std::sin(i);
      fan.positions.emplace_back(std::cos(angle), height, std::sin(angle));
    }
    // Those that lie side by side have a gap of a hundredth of their width.
    if (twisted == 0.0) fan.positions.back() = glm::mix(fan.positions.back(), fan.positions.end()[-2], 0.01f);
    fan.triangles.emplace_back(0, 2 * i + 1, 2 * i + 2);
  }
  return fan;
}

TEST(TriangleTree, TakesThousandsOfTrianglesAroundACorner) {
  TriangleMesh fan = triangleFan(20'000, 0.0);
  EXPECT_FALSE(TriangleTree(fan.positions, fan.triangles).crosses());
  // One that leads from the tip through three of them.
  fan.positions.emplace_back(-0.5f, -0.1f, 0.3f);
  fan.positions.emplace_back(-0.5f, 0.7f, 0.3f);
  fan.triangles.emplace_back(0, fan.positions.size() - 2, fan.positions.size() - 1);
  const TriangleTree tree(fan.positions, fan.triangles);
  EXPECT_TRUE(tree.crosses());
  EXPECT_TRUE(tree.crosses(static_cast<std::uint32_t>(fan.triangles.size()) - 1));
}

TEST(TriangleTree, FindsWhatCrossesAroundACornerAsEachTwoTell) {
  for (const double twisted : {0.01, 0.1, 1.0}) {
    const TriangleMesh fan = triangleFan(200, twisted);
    const TriangleTree tree(fan.positions, fan.triangles);
    const std::vector<char> crossing = tree.crossing();
    for (std::uint32_t i = 0; i < fan.triangles.size(); ++i) {
      bool crosses = false;
      for (std::uint32_t k = 0; k < fan.triangles.size(); ++k)
        crosses = crosses || (k != i && cross(fan.positions, fan.triangles[i], fan.triangles[k]));
      EXPECT_EQ(tree.crosses(i), crosses) << "triangle " << i << ", twisted by " << twisted;
      EXPECT_EQ(crossing[i] != 0, crosses) << "triangle " << i << ", twisted by " << twisted;
    }
  }
}

// Of two tips with a rim in common each triangle's box has those of a quarter of the others in it.
TEST(TriangleTree, TakesTwoFansOfThousandsThatTouch) {
  constexpr std::uint32_t kCount = 50'000;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  mesh.positions.emplace_back(0.0f, 0.0f, 1.0f);
  mesh.positions.emplace_back(0.0f, 0.0f, -1.0f);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    mesh.triangles.emplace_back(i, (i + 1) % kCount, kCount);
    mesh.triangles.emplace_back((i + 1) % kCount, i, kCount + 1);
  }
  EXPECT_FALSE(TriangleTree(mesh.positions, mesh.triangles).crosses());
  mesh.positions[kCount / 2] = {0.9f, 0.0f, 0.9f};  // through the fan and out on the other side
  EXPECT_TRUE(TriangleTree(mesh.positions, mesh.triangles).crosses());
}

// Heaps in which few, some and nearly all cross, and flat ones among them.
TEST(TriangleTree, FindsWhatCrossesAsEachTwoTell) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const double size = std::array{0.05, 0.3, 1.0}[seed % 3];
    TriangleMesh heap;
    for (std::uint32_t i = 0; i < 150; ++i) {
      const glm::dvec3 at = randomIn(random, 1.0);
      for (int k = 0; k < 3; ++k) heap.positions.emplace_back(at + randomIn(random, size));
      heap.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    if (seed % 4 == 0)
      for (glm::vec3& p : heap.positions) p = glm::round(8.0f * p) / glm::vec3(8.0f, 8.0f, 2.0f);
    const TriangleTree tree(heap.positions, heap.triangles);
    const std::vector<char> crossing = tree.crossing();
    bool any = false;
    for (std::uint32_t i = 0; i < heap.triangles.size(); ++i) {
      bool crosses = hasNoArea(heap.positions, heap.triangles[i]);
      for (std::uint32_t k = 0; k < heap.triangles.size() && !crosses; ++k)
        crosses = k != i && !hasNoArea(heap.positions, heap.triangles[k]) &&
                  cross(heap.positions, heap.triangles[i], heap.triangles[k]);
      ASSERT_EQ(crossing[i] != 0, crosses) << "seed " << seed << ", triangle " << i;
      ASSERT_EQ(tree.crosses(i), crosses) << "seed " << seed << ", triangle " << i;
      any = any || crosses;
    }
    EXPECT_EQ(tree.crosses(), any) << "seed " << seed;
  }
}

}  // namespace tree_test
}  // namespace sdf::test
