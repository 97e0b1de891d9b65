// The parts of a mesh that are changed at the same time.
#include "sdf/mesh/refine/blocks.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "mesh/lattice_mesh.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::test {
namespace blocks_test {

constexpr float kApart = 0.03f;

HalfEdgeMesh ball(double voxel) { return HalfEdgeMesh(LatticeMesh(sphere(1.0), voxel).mesh); }

TEST(MeshBlocks, AreNoneOfASmallMesh) {
  const HalfEdgeMesh mesh = ball(0.1);
  const MeshBlocks blocks(mesh, kApart);
  EXPECT_EQ(blocks.count(), 0u);
  EXPECT_EQ(blocks.of(0), MeshBlocks::kNone);
  EXPECT_FALSE(blocks.isInside(0));
  EXPECT_EQ(blocks.triangles().size(), 1u);
}

TEST(MeshBlocks, AreApartAndHoldMostOfAMesh) {
  const HalfEdgeMesh mesh = ball(0.016);
  const MeshBlocks blocks(mesh, kApart);
  ASSERT_EQ(blocks.count(), 8u);
  std::size_t held = 0, triangles = 0;
  for (std::size_t block = 1; block <= blocks.count(); ++block) {
    EXPECT_GT(blocks.vertices()[block].size(), mesh.vertices() / 16) << block;
    held += blocks.vertices()[block].size();
    triangles += blocks.triangles()[block].size();
  }
  EXPECT_GT(held, mesh.vertices() * 3 / 4);
  EXPECT_GT(triangles, mesh.liveTriangles() * 2 / 3);
  std::mt19937 random(5);
  std::uniform_int_distribution<HalfEdgeMesh::Index> any(0, mesh.vertices() - 1);
  float nearest = HUGE_VALF;
  for (int i = 0; i < 2'000'000; ++i) {
    const auto u = any(random), v = any(random);
    if (blocks.of(u) == MeshBlocks::kNone || blocks.of(v) == MeshBlocks::kNone ||
        blocks.of(u) == blocks.of(v))
      continue;
    nearest = std::min(nearest, glm::distance(mesh.positions[u], mesh.positions[v]));
  }
  EXPECT_GE(nearest, kApart);
  EXPECT_LT(nearest, 2.0f * kApart);
}

TEST(MeshBlocks, HoldWhatIsInsideWithItsNeighbours) {
  const HalfEdgeMesh mesh = ball(0.016);
  const MeshBlocks blocks(mesh, kApart);
  std::size_t inside = 0;
  for (HalfEdgeMesh::Index h = 0; h < mesh.halfEdges(); ++h)
    if (blocks.isInside(mesh.from(h))) {
      ++inside;
      ASSERT_EQ(blocks.of(mesh.to(h)), blocks.of(mesh.from(h)));
    }
  EXPECT_GT(inside, mesh.halfEdges() / 2);
  const auto triangles = blocks.triangles();
  for (std::uint8_t block = 1; block <= blocks.count(); ++block)
    for (const auto h : triangles[block])
      for (HalfEdgeMesh::Index k = 0; k < 3; ++k) ASSERT_EQ(blocks.of(mesh.from(h + k)), block);
}

TEST(MeshBlocks, LoseWhatLeavesItsBox) {
  HalfEdgeMesh mesh = ball(0.016);
  MeshBlocks blocks(mesh, kApart);
  const HalfEdgeMesh::Index v = blocks.vertices()[3][0], far = blocks.vertices()[7][0];
  blocks.moved(v);
  EXPECT_EQ(blocks.of(v), 3);
  mesh.positions[v] = mesh.positions[far];
  EXPECT_FALSE(blocks.contains(3, mesh.positions[v]));
  blocks.moved(v);
  EXPECT_EQ(blocks.of(v), MeshBlocks::kNone);
}

}  // namespace blocks_test
}  // namespace sdf::test
