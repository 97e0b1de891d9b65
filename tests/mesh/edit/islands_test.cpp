#include "sdf/mesh/edit/islands.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/feature_meshes.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/mesher.h"

namespace sdf::test {
namespace islands_test {

// A tetrahedron with a corner at a point and legs along the axes.
void addTetrahedron(FeatureMesh& mesh, const glm::vec3& at, float leg) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& to : {glm::vec3(0.0f), glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(0.0f, 1.0f, 0.0f),
                              glm::vec3(0.0f, 0.0f, 1.0f)})
    mesh.positions.push_back(at + leg * to);
  for (const glm::uvec3& t :
       {glm::uvec3(0, 2, 1), glm::uvec3(0, 1, 3), glm::uvec3(0, 3, 2), glm::uvec3(1, 2, 3)})
    mesh.triangles.push_back(t + first);
}

// The number of tetrahedra that stay of a large solid one and a small one somewhere, solid or a hole.
std::size_t left(const glm::vec3& at, bool solid) {
  FeatureMesh mesh;
  addTetrahedron(mesh, glm::vec3(0.0f), 1.0f);
  addTetrahedron(mesh, at, 0.05f);
  Island island;
  for (std::uint32_t v = 4; v < 8; ++v) {
    island.vertices.push_back(v);
    island.centre += mesh.positions[v] / 4.0f;
  }
  island.solid = solid;
  island.holdsCentre = true;
  dropSwallowed(mesh, {island});
  return mesh.triangles.size() / 4;
}

TEST(Islands, GoWhereTheRestSwallowsThem) {
  const glm::vec3 inside(0.2f), outside(0.7f), acrossASide(0.2f, 0.2f, -0.04f);
  EXPECT_EQ(left(inside, true), 1u);
  EXPECT_EQ(left(outside, true), 2u);
  EXPECT_EQ(left(acrossASide, true), 1u);
  EXPECT_EQ(left(inside, false), 2u) << "a hole in what is solid";
  EXPECT_EQ(left(outside, false), 1u);
  // In line with the rest's edges and corners.
  EXPECT_EQ(left({-0.5f, 0.0f, 0.0f}, true), 2u);
  EXPECT_EQ(left({-0.5f, 0.2f, 0.2f}, true), 2u);
}

TEST(Islands, AreSmallPieces) {
  FeatureMesh mesh;
  addTetrahedron(mesh, glm::vec3(0.0f), 1.0f);
  std::vector<glm::vec3> normals(4, glm::vec3(0.0f, 0.0f, 1.0f));
  EXPECT_FALSE(hasSharpEdges(normals, mesh.triangles));
  normals[2] = glm::vec3(0.0f, 0.8f, -0.6f);
  EXPECT_TRUE(hasSharpEdges(normals, mesh.triangles));
  const std::vector<Island> found = findIslands(mesh.positions, mesh.triangles);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].vertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(found[0].centre, glm::vec3(0.25f));
  EXPECT_TRUE(found[0].solid);
  for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
  EXPECT_FALSE(findIslands(mesh.positions, mesh.triangles)[0].solid);
}

// Along its rim the samples of a thin wedge hang together only here and there.
TEST(Islands, DoNotCrowdTheRimOfACrescent) {
  const Shape crescent = subtract(sphere(0.6), translate(sphere(0.6), Vec3E(0.25, 0.1, 0.0)));
  for (const double voxel : {0.006, 0.008, 0.013, 0.02, 0.03}) {
    SCOPED_TRACE(voxel);
    EXPECT_EQ(meshed(crescent, voxel).stats.components, 1);
  }
}

// What stands alone is no bit of anything: a crescent among small balls, inside which no sample is near the
// surface, and which are each of few triangles.
TEST(Islands, ThatAreSolidsOfTheirOwnStay) {
  Shape all = subtract(sphere(0.6), translate(sphere(0.6), Vec3E(0.25, 0.1, 0.0)));
  for (int i = 0; i < 6; ++i) all = all | translate(sphere(0.1), Vec3E(0.3 * i - 0.75, 0.85, 0.1 * i));
  for (const double voxel : {0.02, 0.03}) {
    SCOPED_TRACE(voxel);
    EXPECT_EQ(meshed(all, voxel).stats.components, 7);
  }
}

// The middle of a ring or of a hollow ball is not of it, and what has a hole may have something in the hole.
TEST(Islands, ThatAreRingsOrHollowStay) {
  const auto at = [](const Shape& shape, double x, double y) { return translate(shape, Vec3E(x, y, 0.0)); };
  const Shape crescent = at(subtract(sphere(0.6), at(sphere(0.6), 0.25, 0.1)), 2.0, 0.0),
              ring = torus(0.24, 0.06);
  struct Case {
    const char* name;
    Shape shape;
    double voxel;
    int pieces;
  };
  const Case cases[] = {
      {"a ring around a cone", cone(0.15, 1.0) | at(ring, 0.0, -0.1), 0.06, 2},
      {"a ring around a rod", cylinder(0.07, 1.0) | ring | crescent, 0.06, 3},
      {"two rings, linked", ring | at(rotate(ring, {kPi / 2.0, 0.0, 0.0}), 0.24, 0.0) | crescent, 0.06, 3},
      {"a hollow ball", subtract(sphere(0.1), sphere(0.055)) | crescent, 0.03, 3},
      {"a ball in a hollow one", subtract(sphere(0.8), sphere(0.105)) | sphere(0.045) | crescent, 0.03, 4},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    EXPECT_EQ(meshed(c.shape, c.voxel).stats.components, c.pieces);
  }
}

// With its rim whole few triangles will do.
TEST(Islands, LeaveACrescentSmall) {
  const Shape crescent = subtract(sphere(0.6), translate(sphere(0.6), Vec3E(0.25, 0.1, 0.0)));
  Progress progress;
  MeshOptions options;
  options.tolerance = 1e-3;
  options.strict = false;
  const Result<MeshedShape> meshed = meshShape(crescent, "crescent", options, progress);
  ASSERT_TRUE(meshed.ok()) << meshed.error().message;
  EXPECT_LE(meshed->stats.triangles, 4000u);
  // The rim, a circle, is left out where it is thin; as far as is said.
  const glm::dvec3 apart(0.25, 0.1, 0.0), u(0.0, 0.0, 1.0), v = glm::cross(glm::normalize(apart), u);
  const double radius = std::sqrt(0.36 - 0.25 * glm::dot(apart, apart));
  std::vector<glm::vec3> rim;
  for (int i = 0; i < 4000; ++i)
    rim.emplace_back(0.5 * apart + radius * (std::cos(i * kPi / 2000) * u + std::sin(i * kPi / 2000) * v));
  const double lost = distanceToMesh(rim, meshed->mesh.positions, meshed->mesh.triangles, progress).max;
  EXPECT_NEAR(meshed->stats.maxDistance, lost, 0.06 * lost);
}

}  // namespace islands_test
}  // namespace sdf::test
