#include "sdf/mesh/creases/sharpen.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

#include "mesh/scenes.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/shape/operators/deform.h"

namespace sdf::test {
namespace sharpen_test {

struct Sharp {
  FeatureMesh mesh;
  MeshStats stats;
};

Sharp sharpened(const Shape& shape, double voxel) {
  Progress progress;
  NarrowBand band = bandOf(shape, findBounds(shape), voxel);
  const BandField field(band, wholeTapes(tapeOf(shape)));
  RawSurface raw = band.extract();
  const std::vector<glm::vec3> extracted = raw.points;
  std::vector<glm::vec3> normals;
  refineVertices(raw.points, normals, field, progress);
  Sharp s{sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, field, progress).mesh,
          {}};
  measureDistance(s.mesh.positions, s.mesh.triangles, field, progress, s.stats);
  measureTopology(s.mesh.triangles, s.mesh.positions.size(), s.stats);
  return s;
}

std::vector<glm::dvec3> rotations(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::vector<glm::dvec3> all;
  for (int i = 0; i < count; ++i) all.push_back({angle(random), angle(random), angle(random)});
  return all;
}

// Where a rotated shape has a point of the unrotated one.
glm::dvec3 moved(const glm::dvec3& angles, const glm::dvec3& p) {
  // rotate() substitutes the position; the shape's bounds of a point tell where it went.
  const Box b = rotate(translate(sphere(1e-9), Vec3E(p)), Vec3E(angles)).bounds;
  return b.centre();
}

TEST(Sharpen, ShowsAllCornersOfPolyhedraAtAnyRotation) {
  struct Case {
    const char* name;
    Shape shape;
    std::vector<glm::dvec3> corners;
  };
  std::vector<glm::dvec3> cube;
  for (int i = 0; i < 8; ++i) cube.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 0.6 : -0.6, i & 4 ? 0.8 : -0.8});
  for (const Case& c : {Case{"box", box({1.0, 0.6, 0.8}), cube},
                        Case{"octahedron",
                             octahedron(1.0),
                             {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}}})
    for (const glm::dvec3& r : rotations(10)) {
      SCOPED_TRACE(c.name);
      const Sharp s = sharpened(rotate(c.shape, Vec3E(r)), 1.0 / 20);
      EXPECT_TRUE(s.stats.watertight && s.stats.manifold);
      EXPECT_EQ(s.stats.eulerCharacteristic, 2);
      EXPECT_EQ(s.stats.components, 1);
      for (const glm::dvec3& corner : c.corners)
        EXPECT_LE(nearestVertex(s.mesh.positions, moved(r, corner)), 1e-5)
            << corner.x << ' ' << corner.y << ' ' << corner.z;
    }
}

TEST(Sharpen, LeavesFlatFacesFlat) {
  // Of coordinates up to 2: each is rounded to float, and so is the reading of the distance.
  constexpr double kRounding = 16.0 * 2.0 * kRoundoff;
  for (const glm::dvec3& r : rotations(6)) {
    const Sharp s = sharpened(rotate(box({1.0, 0.6, 0.8}), Vec3E(r)), 1.0 / 20);
    EXPECT_LE(s.stats.maxDistance, kRounding);
  }
}

TEST(Sharpen, FollowsCurvedCreases) {
  const double h = 1.0 / 32;
  const Sharp s = sharpened(boredBox(), h);
  EXPECT_TRUE(s.stats.watertight && s.stats.manifold);
  EXPECT_EQ(s.stats.eulerCharacteristic, -8);
  // The chord of an edge as long as a cell's diagonal on the bores, the most curved part.
  EXPECT_LE(s.stats.maxDistance, 3.0 * h * h / (8.0 * 0.5));
  ASSERT_FALSE(s.mesh.creases.empty());
  for (const auto& [a, b] : s.mesh.creases)
    for (const std::uint32_t v : {a, b}) {
      const glm::dvec3 p(s.mesh.positions[v]);
      double least[2] = {1.0, 1.0};  // how far the two nearest of its pieces are
      for (const double d : {std::abs(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - 1.0),
                             std::abs(glm::length(p) - 1.3), std::abs(std::hypot(p.x, p.y) - 0.5),
                             std::abs(std::hypot(p.y, p.z) - 0.5), std::abs(std::hypot(p.x, p.z) - 0.5)}) {
        if (d < least[0])
          least[1] = std::exchange(least[0], d);
        else
          least[1] = std::min(least[1], d);
      }
      ASSERT_LE(least[1], 1e-4) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(Sharpen, FindsNoCreasesOnWhatIsSmooth) {
  for (const Shape& shape : {sphere(1.0), torus(0.8, 0.3), melt()}) {
    const Sharp s = sharpened(shape, 1.0 / 16);
    EXPECT_TRUE(s.mesh.creases.empty());
    EXPECT_TRUE(s.stats.watertight && s.stats.manifold);
  }
}

TEST(Sharpen, FindsTheTipsOfWedgesThinnerThanAVoxel) {
  // A prism whose edge of 30 degrees, or fewer, lies along z at x = 1.
  for (const double half : {kPi / 12, kPi / 24, kPi / 36}) {
    const Shape wedge = intersect(intersect(plane({std::sin(half), std::cos(half), 0.0}, std::sin(half)),
                                            plane({std::sin(half), -std::cos(half), 0.0}, std::sin(half))),
                                  box({2.0, 1.0, 0.5}));
    const Sharp s = sharpened(rotate(wedge, {0.2, 0.3, 0.1}), 1.0 / 20);
    for (const double z : {-0.4, 0.0, 0.4}) {
      double nearest = kInfinity;
      const glm::dvec3 p = moved({0.2, 0.3, 0.1}, {1.0, 0.0, z});
      for (const auto& [a, b] : s.mesh.creases) {
        const glm::dvec3 u(s.mesh.positions[a]), v(s.mesh.positions[b]);
        const double t = std::clamp(glm::dot(p - u, v - u) / glm::dot(v - u, v - u), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(p, u + t * (v - u)));
      }
      EXPECT_LE(nearest, 1e-5) << half << ' ' << z;
    }
  }
}

// What two balls share; between two planes of samples, so that the last ones inside are up to four voxels
// from its rim, around which both sides bend.
TEST(Sharpen, FindsTheRimsOfThinLenses) {
  const double h = 1.0 / 100, apart = 0.978;  // the faces meet at 24 degrees
  const double rim = std::sqrt(1.0 - apart * apart);
  const Shape lens = translate(sphere(1.0), {apart, 0.0, 0.0}) & translate(sphere(1.0), {-apart, 0.0, 0.0});
  const Sharp s = sharpened(translate(lens, {0.5 * h, 0.0, 0.0}), h);
  EXPECT_TRUE(s.stats.watertight && s.stats.manifold);
  EXPECT_EQ(s.stats.eulerCharacteristic, 2);
  EXPECT_GT(s.mesh.creases.size(), 2.0 * kPi * rim / (2.0 * h));
  for (const auto& [a, b] : s.mesh.creases)
    for (const std::uint32_t v : {a, b}) {
      const glm::dvec3 p(s.mesh.positions[v]);
      EXPECT_NEAR(p.x, 0.5 * h, 1e-5);
      EXPECT_NEAR(std::hypot(p.y, p.z), rim, 1e-5);
    }
  // The chord of two voxels.
  EXPECT_LE(s.stats.maxDistance, h * h / (2.0 * rim));
}

TEST(Sharpen, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return sharpened(boredBox(), 1.0 / 16).mesh;
  };
  const FeatureMesh one = run(1), many = run(4);
  EXPECT_EQ(one.positions, many.positions);
  EXPECT_EQ(one.triangles, many.triangles);
  EXPECT_EQ(one.creases, many.creases);
}

TEST(SplitAtCreases, GivesEachFaceOfABoxItsOwnNormal) {
  Progress progress;
  const Mesh mesh =
      meshShape(rotate(box({1.0, 0.6, 0.8}), {0.3, 0.2, 0.1}), "box", {.voxelSize = 0.05}, progress)
          .value()
          .mesh;
  // Coordinates are rounded to float, and so are the gradients.
  const double exact = 1.0 - 64.0 * kRoundoff;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    for (int k = 1; k < 3; ++k)
      ASSERT_GE(glm::dot(mesh.normals[t[0]], mesh.normals[t[k]]), exact) << a.x << ' ' << a.y << ' ' << a.z;
  }
}

}  // namespace sharpen_test
}  // namespace sdf::test
