#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/measure/topology.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "mesh/feature_meshes.h"

namespace sdf::test {
namespace half_edges_test {

using Index = HalfEdgeMesh::Index;

// Every half-edge has a twin that runs the other way, every vertex one fan, and creases the same flag from
// both sides and the stated number of ends.
void expectConsistent(const HalfEdgeMesh& mesh) {
  std::vector<int> creases(mesh.vertices(), 0);
  std::size_t live = 0;
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    if (!mesh.alive(h)) continue;
    ++live;
    ASSERT_EQ(mesh.twin(mesh.twin(h)), h);
    ASSERT_EQ(mesh.from(mesh.twin(h)), mesh.to(h));
    ASSERT_EQ(mesh.to(mesh.twin(h)), mesh.from(h));
    ASSERT_EQ(mesh.isCrease(h), mesh.isCrease(mesh.twin(h)));
    ASSERT_TRUE(mesh.vertexAlive(mesh.from(h)));
    creases[mesh.from(h)] += mesh.isCrease(h);
  }
  ASSERT_EQ(live, 3 * mesh.liveTriangles());
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.vertexAlive(v)) continue;
    ASSERT_EQ(mesh.from(mesh.outgoing(v)), v);
    ASSERT_EQ(mesh.creasesAt(v), std::min(creases[v], 3));
  }
  const FeatureMesh out = mesh.compacted();
  MeshStats stats;
  measureTopology(out.triangles, out.positions.size(), stats);
  ASSERT_TRUE(stats.watertight);
  ASSERT_TRUE(stats.manifold);
  ASSERT_EQ(stats.eulerCharacteristic, 2);
  ASSERT_EQ(stats.vertices, out.positions.size());
}

TEST(HalfEdgeMesh, IsHandedOnAsItCame) {
  const FeatureMesh cube = griddedCube(4);
  const HalfEdgeMesh mesh(cube);
  expectConsistent(mesh);
  const FeatureMesh same = mesh.compacted();
  EXPECT_EQ(same.positions, cube.positions);
  EXPECT_EQ(same.triangles, cube.triangles);
  EXPECT_EQ(same.creases, cube.creases);
}

TEST(HalfEdgeMesh, RandomChangesKeepItClosedAndItsCreasesWhole) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    HalfEdgeMesh mesh(griddedCube(5));
    int made[3]{};
    for (int i = 0; i < 2000; ++i) {
      const Index h = static_cast<Index>(random() % mesh.halfEdges());
      if (!mesh.alive(h)) continue;
      switch (random() % 5) {
        case 0:
          mesh.split(h, 0.5f * (mesh.positions[mesh.from(h)] + mesh.positions[mesh.to(h)]));
          ++made[0];
          break;
        case 1:
          if (!mesh.canFlip(h)) continue;
          mesh.flip(h);
          ++made[1];
          break;
        default:
          if (!mesh.canCollapse(h)) continue;
          mesh.collapse(h);
          ++made[2];
      }
      if (i % 50 == 0) expectConsistent(mesh);
    }
    expectConsistent(mesh);
    for (const int n : made) EXPECT_GT(n, 50);
    // What was a crease is one still: twelve lines between the eight corners.
    std::set<std::uint32_t> corners;
    for (Index v = 0; v < mesh.vertices(); ++v)
      if (mesh.vertexAlive(v) && mesh.creasesAt(v) == 3) corners.insert(v);
    EXPECT_EQ(corners.size(), 8u);
  }
}

TEST(HalfEdgeMesh, NoCollapseTakesACornerOrLeavesACrease) {
  HalfEdgeMesh mesh(griddedCube(3));
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    const int from = mesh.creasesAt(mesh.from(h));
    const bool bound = from >= 3 || (from == 2 && !mesh.isCrease(h));
    EXPECT_FALSE(bound && mesh.canCollapse(h));
    EXPECT_FALSE(mesh.isCrease(h) && mesh.canFlip(h));
  }
}

TEST(HalfEdgeMesh, ATetrahedronIsTheLeast) {
  FeatureMesh tetrahedron;
  tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const HalfEdgeMesh mesh(tetrahedron);
  for (Index h = 0; h < mesh.halfEdges(); ++h) {
    EXPECT_FALSE(mesh.canCollapse(h));
    EXPECT_FALSE(mesh.canFlip(h));
  }
}

}  // namespace half_edges_test
}  // namespace sdf::test
