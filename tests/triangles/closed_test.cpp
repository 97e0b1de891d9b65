// Surfaces of solids from triangles as they come from files.
#include "sdf/triangles/closed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/triangle_meshes.h"

namespace sdf::test {
namespace closed_test {

bool hasNoBorder(const ClosedTriangles& all) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const glm::uvec3& t : all.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

double volumeOf(const ClosedTriangles& all) {
  double sum = 0.0;
  for (const glm::uvec3& t : all.triangles)
    sum += glm::dot(glm::dvec3(all.points[t.x]),
                    glm::cross(glm::dvec3(all.points[t.y]), glm::dvec3(all.points[t.z]))) /
           6.0;
  return sum;
}

const TriangleMesh kBox = boxOf(glm::vec3(-1.0f), glm::vec3(1.0f, 2.0f, 3.0f));
constexpr double kVolume = 2.0 * 3.0 * 4.0;

TEST(Closed, AClosedMeshStaysAsItIs) {
  const ClosedTriangles all = closed(kBox);
  EXPECT_EQ(all.triangles, kBox.triangles);
  EXPECT_EQ(all.holes, 0u);
  EXPECT_EQ(all.turned, 0u);
  EXPECT_TRUE(all.manifold);
  EXPECT_NEAR(volumeOf(all), kVolume, 1e-12);
}

TEST(Closed, TrianglesWithCornersOfTheirOwnAreJoined) {
  const ClosedTriangles all = closed(apart(kBox));
  EXPECT_EQ(all.points.size(), 8u);
  EXPECT_TRUE(all.manifold);
  EXPECT_EQ(all.holes, 0u);
}

TEST(Closed, CornersThatAreNearlyOneAreJoinedToo) {
  TriangleMesh mesh = apart(kBox);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] += 1e-6f * glm::vec3(static_cast<float>(i % 5), static_cast<float>(i % 3), 0.0f);
  const ClosedTriangles all = closed(mesh);
  EXPECT_TRUE(all.manifold);
  EXPECT_EQ(all.holes, 0u);
  EXPECT_NEAR(volumeOf(all), kVolume, 1e-3);
}

TEST(Closed, AHoleIsClosedByTrianglesBetweenItsPoints) {
  for (const int missing : {1, 2}) {
    const ClosedTriangles all =
        closed(without(kBox, [&](std::size_t i) { return static_cast<int>(i) < missing; }));
    EXPECT_EQ(all.holes, 1u);
    EXPECT_EQ(all.triangles.size(), 12u);
    EXPECT_EQ(all.source.size(), 12u - missing);
    EXPECT_TRUE(all.manifold);
    EXPECT_NEAR(volumeOf(all), kVolume, 1e-12);
  }
}

TEST(Closed, TurnedTrianglesAreTurnedBack) {
  TriangleMesh mesh = kBox;
  for (const std::size_t i : {0u, 5u, 6u}) std::swap(mesh.triangles[i].x, mesh.triangles[i].y);
  const ClosedTriangles all = closed(mesh);
  EXPECT_EQ(all.turned, 3u);
  EXPECT_TRUE(all.manifold);
  EXPECT_NEAR(volumeOf(all), kVolume, 1e-12);
}

TEST(Closed, TrianglesWithoutAnAreaAreDropped) {
  TriangleMesh mesh = kBox;
  mesh.triangles.emplace_back(0, 0, 1);
  mesh.positions.emplace_back(0.5f * (mesh.positions[0] + mesh.positions[1]));
  mesh.triangles.emplace_back(0, 8, 1);
  EXPECT_EQ(closed(mesh).triangles.size(), 12u);
}

TEST(Closed, NothingIsLeftOfATriangleWithoutAnArea) {
  TriangleMesh mesh;
  mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}, {2.0f, 2.0f, 2.0f}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(closed(mesh).triangles.empty());
  EXPECT_TRUE(closed(TriangleMesh()).triangles.empty());
}

TriangleMesh overAndOver(const TriangleMesh& mesh, int times) {
  TriangleMesh all;
  all.positions = mesh.positions;
  for (int i = 0; i < times; ++i)
    all.triangles.insert(all.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  return all;
}

// As many as a file may hold: the work grows as their number does.
TEST(Closed, TrianglesThatAreThereAgainAreLeftOut) {
  const ClosedTriangles all = closed(overAndOver(kBox, 20000));
  EXPECT_EQ(all.triangles, kBox.triangles);
  EXPECT_EQ(all.repeated, 12u * 19999u);
  EXPECT_EQ(all.holes + all.films, 0u);
  EXPECT_TRUE(all.manifold);
}

// Two pyramids on one base, on the same side of it: the base belongs to both.
TEST(Closed, ATriangleThatTwoSolidsShareIsNoHole) {
  TriangleMesh mesh;
  mesh.positions = {
      {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.2f, 0.2f, 2.0f}};
  for (const std::uint32_t tip : {3u, 4u})
    mesh.triangles.insert(mesh.triangles.end(), {{0, 2, 1}, {0, 1, tip}, {1, 2, tip}, {2, 0, tip}});
  const ClosedTriangles all = closed(mesh);
  EXPECT_EQ(all.triangles.size(), 8u);
  EXPECT_EQ(all.holes + all.repeated + all.films, 0u);
}

TEST(Closed, WhatHasNothingBehindItIsLeftOut) {
  TriangleMesh mesh = kBox;
  mesh.positions.emplace_back(5.0f, 5.0f, 5.0f);
  mesh.triangles.emplace_back(0, 1, 8);
  const ClosedTriangles all = closed(mesh);
  EXPECT_EQ(all.triangles, kBox.triangles);
  EXPECT_EQ(all.films, 1u);
  EXPECT_EQ(all.holes, 0u);
}

// A wall between two boxes is no border of what they make together.
TEST(Closed, AWallBetweenSolidsIsLeftOut) {
  const TriangleMesh beside = boxOf(glm::vec3(1.0f, -1.0f, -1.0f), glm::vec3(4.0f, 2.0f, 3.0f));
  const ClosedTriangles all = closed(together(kBox, beside));
  EXPECT_EQ(all.films + all.triangles.size(), 24u);
  EXPECT_GE(all.films, 2u);
  EXPECT_TRUE(hasNoBorder(all));
  EXPECT_NEAR(volumeOf(all), 2.5 * kVolume, 1e-12);
}

// All on one edge, as the leaves of a book.
TEST(Closed, ABookOfManyLeavesIsNothing) {
  TriangleMesh book;
  book.positions = {{0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  constexpr std::uint32_t kLeaves = 40000;
  for (std::uint32_t i = 0; i < kLeaves; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kLeaves;
    book.positions.emplace_back(std::cos(angle), 0.5, std::sin(angle));
    book.triangles.emplace_back(0, 1, i + 2);
  }
  const ClosedTriangles all = closed(book);
  EXPECT_TRUE(all.triangles.empty());
  EXPECT_EQ(all.films, kLeaves);
}

// Any heap of triangles: borders that meet in points, edges of many triangles, holes within holes.
TEST(Closed, WhateverIsGivenHasNoBorderThen) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    TriangleMesh mesh;
    const auto corners = 4u + random() % 12u;
    for (unsigned i = 0; i < corners; ++i) mesh.positions.emplace_back(randomIn(random, 1.0));
    for (unsigned i = 0; i < 3u + random() % 30u; ++i)
      mesh.triangles.emplace_back(random() % corners, random() % corners, random() % corners);
    const ClosedTriangles all = closed(mesh);
    EXPECT_TRUE(hasNoBorder(all)) << "seed " << seed;
    EXPECT_LE(all.source.size(), all.triangles.size());
  }
}

TEST(Closed, ATorusThatLostTrianglesIsClosed) {
  std::mt19937 random(7);
  const TriangleMesh torus = bumpyTorus(60);
  const ClosedTriangles all = closed(without(torus, [&](std::size_t) { return random() % 20 == 0; }));
  EXPECT_GT(all.holes, 200u);
  EXPECT_TRUE(hasNoBorder(all));
  EXPECT_NEAR(volumeOf(all), volumeOf(closed(torus)), 1e-3);
}

// Two boxes that share an edge, and two that touch in a corner.
TEST(Closed, WhatTouchesItselfIsNoManifold) {
  const TriangleMesh unit = boxOf(glm::vec3(0.0f), glm::vec3(1.0f));
  const auto besides = [&](const glm::vec3& low) { return closed(together(unit, boxOf(low, low + 1.0f))); };
  EXPECT_FALSE(besides({1.0f, 1.0f, 0.0f}).manifold);
  EXPECT_FALSE(besides({1.0f, 1.0f, 1.0f}).manifold);
  EXPECT_TRUE(besides({2.0f, 0.0f, 0.0f}).manifold);
}

}  // namespace closed_test
}  // namespace sdf::test
