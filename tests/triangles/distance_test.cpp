// Signed distances to triangles, whole and broken.
#include "sdf/triangles/distance.h"

#include <gtest/gtest.h>

#include "support/triangle_meshes.h"

namespace sdf::test {
namespace distance_test {

double boxDistance(const glm::dvec3& p, const glm::dvec3& half) {
  const glm::dvec3 q = glm::abs(p) - half;
  return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

const glm::dvec3 kHalf(1.0, 0.5, 0.75);
TriangleMesh box() { return boxOf(-glm::vec3(kHalf), glm::vec3(kHalf)); }

TEST(TriangleDistance, OfABoxIsTheFormulas) {
  const TriangleDistance distance(closed(box()));
  EXPECT_EQ(distance.signBy(), SignBy::Normals);
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = randomIn(random, 2.0);
    EXPECT_NEAR(distance.read(p).distance, boxDistance(p, kHalf), 1e-15);
  }
}

TEST(TriangleDistance, IsExactNextToTheSurface) {
  const TriangleDistance distance(closed(box()));
  for (const double off : {1e-3, 1e-9, 1e-15, 0x1p-53}) {
    EXPECT_EQ(distance.read({1.0 + off, 0.1, 0.2}).distance, (1.0 + off) - 1.0);
    EXPECT_EQ(distance.read({1.0 - off, 0.1, 0.2}).distance, (1.0 - off) - 1.0);
  }
  EXPECT_EQ(distance.read({1.0, 0.1, 0.2}).distance, 0.0);
}

TEST(TriangleDistance, GradientsAreUnitAndPointAway) {
  const TriangleDistance distance(closed(bumpyTorus(40)));
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = randomIn(random, 1.6);
    const auto [f, gradient, triangle] = distance.read(p);
    ASSERT_NEAR(glm::length(gradient), 1.0, 1e-12);
    EXPECT_NEAR(distance.read(p - 0.999999 * f * gradient).distance, 1e-6 * f, 1e-12);
  }
}

// On faces, edges and corners: a direction out of the solid.
TEST(TriangleDistance, GradientsOnTheSurfacePointOutwards) {
  const TriangleDistance distance(closed(box()));
  for (const glm::dvec3& p :
       {glm::dvec3(1.0, 0.1, 0.3), glm::dvec3(1.0, 0.5, 0.1), glm::dvec3(1.0, 0.5, 0.75),
        glm::dvec3(-1.0, -0.5, -0.75), glm::dvec3(0.0, -0.5, 0.0)}) {
    const TriangleDistance::Read read = distance.read(p);
    EXPECT_EQ(read.distance, 0.0);
    EXPECT_NEAR(glm::length(read.gradient), 1.0, 1e-6);
    EXPECT_GT(distance.read(p + 1e-3 * read.gradient).distance, 0.0);
    EXPECT_LT(distance.read(p - 1e-3 * read.gradient).distance, 0.0);
  }
}

// The classic trap: at the tip of a wedge the nearest triangle's own normal may point the wrong way.
TEST(TriangleDistance, SignsAtASharpTipAreRight) {
  TriangleMesh spike;
  spike.positions = {{0.0f, 3.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, {-0.1f, 0.0f, 0.1f}, {-0.1f, 0.0f, -0.1f}};
  spike.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const TriangleDistance distance(closed(spike));
  ASSERT_EQ(distance.signBy(), SignBy::Normals);
  std::mt19937 random(3);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = glm::dvec3(0.0, 3.0, 0.0) + randomIn(random, 1.0);
    if (p.y > 3.0) {
      EXPECT_GT(distance.read(p).distance, 0.0);
    }
  }
}

TEST(TriangleDistance, BoxesThatOverlapAreOneSolid) {
  const TriangleDistance distance(
      closed(together(boxOf(glm::vec3(-1.0f), glm::vec3(0.5f)), boxOf(glm::vec3(-0.5f), glm::vec3(1.0f)))));
  EXPECT_EQ(distance.signBy(), SignBy::Winding);
  EXPECT_TRUE(distance.hasInside());
  std::mt19937 random(4);
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = randomIn(random, 1.5);
    const double both =
        std::min(boxDistance(p + 0.25, glm::dvec3(0.75)), boxDistance(p - 0.25, glm::dvec3(0.75)));
    const double f = distance.read(p).distance;
    EXPECT_EQ(f < 0.0, both < 0.0);
    if (both > 0.0) {
      EXPECT_NEAR(f, both, 1e-15);
    }
  }
}

TEST(TriangleDistance, ABallInsideABallIsAHollowOnlyIfItIsTurned) {
  const TriangleMesh inner = boxOf(glm::vec3(-0.5f), glm::vec3(0.5f));
  TriangleMesh turned = inner;
  for (glm::uvec3& t : turned.triangles) std::swap(t.x, t.y);
  const TriangleMesh outer = boxOf(glm::vec3(-1.0f), glm::vec3(1.0f));
  const TriangleDistance hollow(closed(together(outer, turned))), solid(closed(together(outer, inner)));
  EXPECT_EQ(hollow.signBy(), SignBy::Normals);
  EXPECT_EQ(hollow.read(glm::dvec3(0.0)).distance, 0.5);
  EXPECT_EQ(solid.signBy(), SignBy::Winding);
  EXPECT_EQ(solid.read(glm::dvec3(0.0)).distance, -0.5);
  for (const TriangleDistance* d : {&hollow, &solid}) EXPECT_EQ(d->read({0.75, 0.0, 0.0}).distance, -0.25);
}

TEST(TriangleDistance, AMeshInsideOutHasAnInside) {
  TriangleMesh mesh = box();
  for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
  const TriangleDistance distance(closed(mesh));
  EXPECT_TRUE(distance.hasInside());
  EXPECT_EQ(distance.read(glm::dvec3(0.0)).distance, -0.5);
  EXPECT_EQ(distance.read({2.0, 0.0, 0.0}).distance, 1.0);
}

// Two halves of a square before, and two others behind.
TEST(TriangleDistance, AFilmHasNoInside) {
  ClosedTriangles film;
  film.points = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
  film.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}};
  EXPECT_FALSE(TriangleDistance(film).hasInside());
}

// A twentieth of the faces gone: away from the holes signs are as before.
TEST(TriangleDistance, SignsOfAMeshWithHolesAreRight) {
  const TriangleMesh torus = bumpyTorus(100);
  std::mt19937 random(5);
  const TriangleDistance whole(closed(torus)),
      broken(closed(without(torus, [&](std::size_t) { return random() % 20 == 0; })));
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = randomIn(random, 1.6);
    const double f = whole.read(p).distance;
    if (std::abs(f) > 0.05) wrong += (f < 0.0) != (broken.read(p).distance < 0.0);
  }
  EXPECT_EQ(wrong, 0);
}

// |f(p) - f(q)| <= |p - q| wherever the sign changes: only where f is 0.
TEST(TriangleDistance, OfAnyHeapOfTrianglesHasSlopeOne) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    TriangleMesh heap;
    for (int i = 0; i < 8; ++i) heap.positions.emplace_back(randomIn(random, 1.0));
    for (int i = 0; i < 12; ++i) heap.triangles.emplace_back(random() % 8, random() % 8, random() % 8);
    ClosedTriangles all = closed(heap);
    if (all.triangles.empty()) continue;
    const TriangleDistance distance(std::move(all));
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 p = randomIn(random, 1.2), q = p + 0.05 * randomIn(random, 1.0);
      EXPECT_LE(std::abs(distance.read(p).distance - distance.read(q).distance),
                glm::distance(p, q) * (1.0 + 1e-12) + 1e-15)
          << "seed " << seed;
    }
  }
}

// Signs that follow from the reading before, or from the patch that is nearest, are those of the winding
// number.
TEST(TriangleDistance, AlongAWayIsTheSame) {
  std::mt19937 random(6);
  TriangleMesh heap;
  for (int i = 0; i < 20; ++i) heap.positions.emplace_back(randomIn(random, 1.0));
  for (int i = 0; i < 40; ++i) heap.triangles.emplace_back(random() % 20, random() % 20, random() % 20);
  TriangleMesh moved = bumpyTorus(24);
  for (glm::vec3& p : moved.positions) p += glm::vec3(0.3f, 0.1f, 0.0f);
  for (const TriangleMesh& mesh : {heap, together(bumpyTorus(24), moved), bumpyTorus(24)}) {
    const ClosedTriangles all = closed(mesh);
    const TriangleDistance distance(all);
    const TriangleTree tree(all.points, all.triangles);
    DistanceAlong along(distance);
    glm::dvec3 p(0.0);
    for (int i = 0; i < 20000; ++i) {
      p = i % 100 == 0 ? randomIn(random, 1.5) : p + randomIn(random, 0.05);
      const TriangleDistance::Read read = distance.read(p), next = along(p);
      ASSERT_EQ(next.distance, read.distance) << i;
      ASSERT_EQ(next.gradient, read.gradient) << i;
      if (std::abs(read.distance) > 1e-9) {
        ASSERT_EQ(read.distance<0.0, std::abs(tree.winding(p))> 0.5) << i;
      }
    }
  }
}

TEST(WindingOf, OfAnOctantIsAnEighth) {
  const glm::dvec3 x(3, 0, 0), y(0, 0.5, 0), z(0, 0, 1);
  EXPECT_NEAR(windingOf(x, y, z), 1.0 / 8, 0x1p-52);
  EXPECT_NEAR(windingOf(x, z, y), -1.0 / 8, 0x1p-52);
}

TEST(TriangleTree, HoldsWhatIsVeryUneven) {
  TriangleMesh mesh;
  for (int i = 0; i < 120; ++i) {
    const float size = std::ldexp(1.0f, -i);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p :
         {glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(1.0f, 1.0f, 0.0f), glm::vec3(1.0f, 0.0f, 1.0f)})
      mesh.positions.push_back(size * p);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  const TriangleTree tree(mesh.positions, mesh.triangles);
  for (std::uint32_t i = 0; i < 100; ++i)
    EXPECT_EQ(tree.nearest(glm::dvec3(std::ldexp(1.01, -static_cast<int>(i)), 0.0, 0.0)).triangle, i);
}

}  // namespace distance_test
}  // namespace sdf::test
