#include "sdf/mesh/edit/crossings.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <functional>

#include <random>

#include "mesh/feature_meshes.h"
#include "sdf/triangles/triangle_pairs.h"
#ifdef SDF_REFERENCE
#include "reference/reference.h"
#endif

namespace sdf::test {
namespace crossings_test {

using Pairs = TrianglePairs;

/// A soup of tetrahedra: closed, and each apart from the others but where they cross.
struct Soup {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;

  void add(const std::array<glm::vec3, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), corners.begin(), corners.end());
    for (const glm::uvec3 t : {glm::uvec3(0, 2, 1), {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      triangles.push_back(t + first);
  }
};

Soup randomSoup(unsigned seed, int count, float size, const std::function<float(float)>& rounded) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> at(0.0f, 1.0f), way(-size, size);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 middle{at(random), at(random), at(random)};
    std::array<glm::vec3, 4> corners;
    for (glm::vec3& p : corners)
      for (int k = 0; k < 3; ++k) p[k] = rounded(middle[k] + way(random));
    soup.add(corners);
  }
  return soup;
}

float asItIs(float x) { return x; }
/// Many corners are then on the same planes, edges and points.
float toGrid(float x) { return std::round(x * 16.0f) / 16.0f; }

Pairs bruteForce(const Soup& s) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < s.triangles.size(); ++i) {
    if (hasNoArea(s.positions, s.triangles[i])) {
      pairs.push_back({i, i});
      continue;
    }
    for (std::uint32_t k = i + 1; k < s.triangles.size(); ++k)
      if (!hasNoArea(s.positions, s.triangles[k]) && cross(s.positions, s.triangles[i], s.triangles[k]))
        pairs.push_back({i, k});
  }
  return pairs;
}

TEST(Crossings, AreAllThatComparingEachWithEachFinds) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Soup s = randomSoup(seed, 300, seed % 2 ? 0.3f : 0.03f, seed < 3 ? asItIs : toGrid);
    const Pairs expected = bruteForce(s);
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(crossingTriangles(s.positions, s.triangles), expected);
  }
}

TEST(Crossings, OfWhatIsAskedForAreThoseThatHaveIt) {
  const Soup s = randomSoup(7, 300, 0.1f, asItIs);
  std::vector<std::uint32_t> all;
  std::vector<char> asked;
  for (std::uint32_t i = 0; i < s.triangles.size(); ++i) all.push_back(i), asked.push_back(i % 5 == 0);
  Pairs expected = crossingTriangles(s.positions, s.triangles);
  std::erase_if(expected, [&](const auto& pair) { return !asked[pair[0]] && !asked[pair[1]]; });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(crossingTriangles(s.positions, s.triangles, all, asked), expected);
}

TEST(Crossings, DoNotDependOnTheNumberOfThreads) {
  const Soup s = randomSoup(8, 3000, 0.05f, asItIs);
  const auto by = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return crossingTriangles(s.positions, s.triangles);
  };
  const Pairs one = by(1);
  EXPECT_EQ(one, by(2));
  EXPECT_EQ(one, by(8));
}

TEST(Crossings, AreNoneWhereTrianglesShareWhatTheyHaveInCommon) {
  const FeatureMesh cube = griddedCube(12), cylinder = griddedCylinder(40, 6);
  EXPECT_EQ(crossingTriangles(cube.positions, cube.triangles), Pairs{});
  EXPECT_EQ(crossingTriangles(cylinder.positions, cylinder.triangles), Pairs{});
}

TEST(Crossings, OfTrianglesThatFoldOntoEachOtherAreFound) {
  const std::vector<glm::vec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.2f, 0.2f, 0}, {2, 2, 0}};
  EXPECT_FALSE(cross(p, {0, 1, 2}, {1, 3, 2}));  // side by side
  EXPECT_TRUE(cross(p, {0, 1, 2}, {1, 4, 2}));   // on one another, on the same side of a shared edge
  EXPECT_TRUE(cross(p, {0, 1, 2}, {0, 3, 2}));   // they share an edge and overlap
  EXPECT_FALSE(cross(p, {0, 1, 2}, {3, 1, 5}));  // one corner in common
  EXPECT_TRUE(hasNoArea(p, {0, 3, 5}));
}

// Distances far below what double resolves of the volumes that decide.
TEST(Crossings, AreDecidedExactly) {
  const float tiny = 0x1p-60f;
  const std::vector<glm::vec3> p{
      {0, 0, 0},        {1, 0, 0},        {0, 1, 0},         {0.25f, 0.25f, tiny},
      {0.5f, 0.25f, 1}, {0.25f, 0.5f, 1}, {0.25f, 0.25f, 0}, {0.25f, 0.25f, -tiny}};
  EXPECT_FALSE(cross(p, {0, 1, 2}, {3, 4, 5}));
  EXPECT_TRUE(cross(p, {0, 1, 2}, {6, 4, 5}));
  EXPECT_TRUE(cross(p, {0, 1, 2}, {7, 4, 5}));
}

#ifdef SDF_REFERENCE
std::size_t crossingsByCgal(const Soup& s) {
  accuracy::TriangleMesh all;
  for (const glm::vec3& p : s.positions) all.points.emplace_back(p);
  for (const glm::uvec3& t : s.triangles) all.triangles.emplace_back(t);
  return accuracy::crossings(all);
}

TEST(Crossings, AreAsManyAsCgalFinds) {
  for (unsigned seed = 10; seed < 20; ++seed) {
    const Soup s = randomSoup(seed, 500, seed % 2 ? 0.2f : 0.05f, seed < 15 ? asItIs : toGrid);
    EXPECT_EQ(crossingTriangles(s.positions, s.triangles).size(), crossingsByCgal(s)) << seed;
  }
}

// Triangles that share corners and edges, folded over one another.
TEST(Crossings, OfCrumpledMeshesAreAsManyAsCgalFinds) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const FeatureMesh cube = griddedCube(10);
    Soup s{cube.positions, cube.triangles};
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> way(-0.15f, 0.15f);
    for (glm::vec3& p : s.positions)
      for (int k = 0; k < 3; ++k) p[k] = seed < 4 ? p[k] + way(random) : toGrid(p[k] + way(random));
    const std::size_t expected = crossingsByCgal(s);
    EXPECT_GT(expected, 10u);
    EXPECT_EQ(crossingTriangles(s.positions, s.triangles).size(), expected) << seed;
  }
}
#endif

}  // namespace crossings_test
}  // namespace sdf::test
