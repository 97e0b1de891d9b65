#include "sdf/mesh/measure/to_mesh.h"

#include <tbb/global_control.h>

#include "mesh/scenes.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/solids/flats.h"

namespace sdf::test {
namespace to_mesh_test {

const std::vector<glm::uvec3> kSides{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

std::vector<glm::vec3> corners(const glm::vec3& half) {
  std::vector<glm::vec3> all;
  for (int i = 0; i < 8; ++i)
    all.push_back(half * glm::vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f));
  return all;
}

SurfaceDistance toBox(const Shape& shape, const glm::vec3& half) {
  Progress progress;
  return distanceToMesh(surfacePoints(Model(shape).at(), findBounds(shape), progress), corners(half), kSides,
                        progress);
}

TEST(DistanceToMesh, IsNoneOfABoxFromItself) {
  const SurfaceDistance d = toBox(box({1.0, 0.5, 0.25}), {1.0f, 0.5f, 0.25f});
  EXPECT_EQ(d.max, 0.0);
  EXPECT_GE(d.points, 1000u);
}

// Of a piece among many, still all over it.
TEST(SurfacePoints, AreFewerInFewerCells) {
  Progress progress;
  const Shape shape = sphere(1.0);
  const ModelTapes model = Model(shape).at();
  const std::vector<glm::vec3> all = surfacePoints(model, shape.bounds, progress),
                               few = surfacePoints(model, shape.bounds, progress, kFewestSurfaceCells);
  EXPECT_LT(few.size(), all.size() / 3);
  EXPECT_GT(few.size(), kFewestSurfaceCells);
  for (const glm::vec3& p : all)
    EXPECT_LT(glm::distance(p, *std::ranges::min_element(
                                   few, {}, [&](const glm::vec3& q) { return glm::distance(p, q); })),
              0.35f);
}

// Those that are nearer than the farthest before them are not looked at closely; the result is the same.
TEST(DistanceToMesh, IsThatOfEveryPointByItself) {
  Progress progress;
  const Shape shape = torus(1.0, 0.4);
  const MeshedShape m = meshed(shape, 0.1);
  const std::vector<glm::vec3> points = surfacePoints(Model(shape).at(), shape.bounds, progress);
  const std::vector<NearestPoint> nearest =
      nearestTriangles(points, m.mesh.positions, m.mesh.triangles, progress);
  const auto largest = std::ranges::max_element(nearest, {}, &NearestPoint::squared);
  const double max = std::sqrt(largest->squared), limit = 0.5 * max;
  const SurfaceDistance d = distanceToMesh(points, m.mesh.positions, m.mesh.triangles, progress, limit);
  EXPECT_EQ(d.max, max);
  EXPECT_EQ(d.farthest, points[largest - nearest.begin()]);
  EXPECT_EQ(d.points, points.size());
  const auto isBeyond = [&](const NearestPoint& n) { return std::sqrt(n.squared) > limit; };
  EXPECT_EQ(d.beyond, static_cast<std::uint64_t>(std::ranges::count_if(nearest, isBeyond)));
}

// Each of these meshes lies on the surface, or within 0.04 of it. Points are half a cell from the farthest
// corner, and the door's 2048 cells are 0.04 long; the sheet's rim is met by lines along the sheet.
TEST(DistanceToMesh, IsThatOfWhatTheMeshLacks) {
  EXPECT_NEAR(toBox(box({0.5, 1.0, 0.04}), {0.25f, 0.67f, 0.04f}).max, std::hypot(0.25, 0.33), 0.02);
  const SurfaceDistance rim = toBox(box({100.0, 0.0175, 80.0}), {99.5f, 0.0175f, 79.5f});
  EXPECT_NEAR(rim.max, 0.5, 0.02);
  EXPECT_NEAR(std::max(std::abs(rim.farthest.x) - 99.5, std::abs(rim.farthest.z) - 79.5), 0.5, 0.02);
}

// A plate a twentieth of a thousandth as thick as it is long is passed by most pairs of readings. Points are
// a cell's diagonal from its corner, 0.06: 2048 cells of the plate's 2 by 1.6.
TEST(DistanceToMesh, SeesWhatIsThinnerThanReadingsAreApart) {
  const Shape plate = rotateAbout(box({1.0, 0.8, 5e-5}), {0.6, 0.8, 0.0}, 0.5);
  const glm::vec3 half(0.02f);
  const SurfaceDistance d = toBox(plate, half);
  EXPECT_GE(d.points, 2000u);
  EXPECT_NEAR(d.max, std::hypot(1.0, 0.8), 0.06);
}

// A ball of a hundredth of the box's side is one of the operands that points are spaced by.
TEST(DistanceToMesh, SeesASmallOperandOfAUnion) {
  const Shape both = box({1.0, 1.0, 1.0}) | translate(sphere(0.01), {1.5, 0.7, -0.3});
  const SurfaceDistance d = toBox(both, glm::vec3(1.0f));
  EXPECT_NEAR(d.max, 0.51, 1e-3);
}

// Of a formula it is not known that it has such a ball: cells far from the rest of the surface are halved
// until it is met.
TEST(DistanceToMesh, SeesASmallPieceOfAFormula) {
  const Vec3E p = position();
  for (const double r : {0.1, 0.03, 0.01, 0.003})
    for (const double x : {1.5, 1.53, 1.6187}) {
      const Vec3E q = p - Vec3E(x, 0.011, -0.024);
      const Shape both = field(min(dot(p, p) - 1.0, dot(q, q) - r * r), region(1.8));
      Progress progress;
      const std::vector<glm::vec3> points = surfacePoints(Model(both).at(), both.bounds, progress);
      int onBall = 0;
      for (const glm::vec3& at : points)
        if (at.x > 1.2f) ++onBall;
      EXPECT_GE(onBall, 1) << r << ", " << x;
    }
}

// The plane of which two boxes share a face is inside of both, to a rounding.
TEST(DistanceToMesh, SeesNoFilmWhereSolidsTouch) {
  for (const double at : {0.1, 0.3, 0.7, 1.1}) {
    const Shape both = translate(box({1.0, at, 1.0}), {0.0, at, 0.0}) |
                       translate(box({1.0, 0.2, 1.0}), {0.0, 2.0 * at + 0.2, 0.0});
    Progress progress;
    for (const glm::vec3& p : surfacePoints(Model(both).at(), findBounds(both), progress))
      EXPECT_GE(std::max({std::abs(p.x), std::abs(p.z), p.y < 0.5 * at ? 1.0f : 0.0f,
                          p.y > 2.0 * at + 0.3 ? 1.0f : 0.0f}),
                0.9999f)
          << at << ": " << p.y;
  }
}

// The distance of a profile with a side on the axis is 0 there, inside of the solid.
TEST(DistanceToMesh, SeesNoFilmOnAnAxis) {
  const glm::dvec2 profile[] = {{0.0, 0.0}, {0.7, 0.0}, {0.3, 0.5}, {0.4, 1.1}, {0.0, 1.3}};
  const Shape top = revolve(polygon(profile));
  Progress progress;
  for (const glm::vec3& p : surfacePoints(Model(top).at(), findBounds(top), progress))
    EXPECT_TRUE(std::hypot(p.x, p.z) > 0.01f || p.y < 0.01f || p.y > 1.29f)
        << p.x << " " << p.y << " " << p.z;
}

// More points than are read at a time.
TEST(DistanceToMesh, IsTheLargestOfKnownPoints) {
  std::vector<glm::vec3> points(1000, {1.0f, 0.25f, -0.5f});
  points[777] = {1.0f, 2.0f, 0.5f};
  Progress progress;
  const SurfaceDistance d = distanceToMesh(points, corners({1.0f, 0.5f, 1.0f}), kSides, progress);
  EXPECT_EQ(d.points, 1000u);
  EXPECT_EQ(d.max, 1.5);
  EXPECT_EQ(d.farthest, points[777]);
  EXPECT_EQ(distanceToMesh({}, corners(glm::vec3(1.0f)), kSides, progress).points, 0u);
}

// A corner of a box is cut off, and an edge: points in cells of 0.04 miss what is farthest.
TEST(FarthestOfSurface, IsClimbedTo) {
  const glm::vec3 half(1.0f, 0.5f, 0.25f);
  const Shape shape = box(Vec3E(glm::dvec3(half)));
  const double voxel = 0.02;
  const NarrowBand band = bandOf(shape, shape.bounds, voxel);
  const BandField field(band, wholeTapes(tapeOf(shape)));
  for (const std::vector<int>& moved : {std::vector{7}, std::vector{3, 7}, std::vector{0}}) {
    std::vector<glm::vec3> positions = corners(half);
    for (const int k : moved) positions[k] -= 0.02f * glm::sign(positions[k]) * glm::vec3(0.0f, 1.0f, 1.0f);
    Progress progress;
    const double truth = distanceToMesh({corners(half)[moved[0]]}, positions, kSides, progress).max;
    const std::vector<glm::vec3> points = surfacePoints(Model(shape).at(), shape.bounds, progress);
    const SurfaceDistance d = farthestOf(farthestOfSurface(points, field, 2.0, positions, kSides, progress));
    EXPECT_NEAR(d.max, truth, 0.01 * truth) << moved.size();
    // What is reached lies on the surface.
    const glm::vec3 away = glm::abs(glm::abs(d.farthest) - half);
    EXPECT_LE(std::min({away.x, away.y, away.z}), 1e-6f);
  }
}

// Three discs are drawn out by a twist: what voxels as coarse as these cut off of their rims, points in cells
// do not see.
TEST(FarthestOfSurface, OfATwistedRimIsWhatTheMeshLacks) {
  const Shape disc = cylinder(1.0, 0.0642);
  const Shape row = repeatGrid(disc, {0.0, 0.639, 0.499}, glm::ivec3(1, 3, 1));
  const Shape shape = twist(round(row, 0.425), -86.6 * kPi / 180.0) & box(Vec3E(4.0));
  Progress progress;
  const auto made = meshShape(shape, "row", {.voxelSize = findBounds(shape).longestSide() / 18.0}, progress);
  ASSERT_TRUE(made.ok()) << made.error().message;
  // Points alone say 0.017.
  EXPECT_NEAR(made->stats.maxDistance, 0.0191, 2e-4);
}

TEST(DistanceToMesh, DoesNotDependOnTheNumberOfThreads) {
  const auto run = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return toBox(melt(), glm::vec3(1.0f));
  };
  const SurfaceDistance one = run(1), two = run(2);
  EXPECT_EQ(one.max, two.max);
  EXPECT_EQ(one.farthest, two.farthest);
  EXPECT_EQ(one.points, two.points);
}

// Voxels that no sample of which meets a piece are too coarse for it, and that is said. From the larger ball,
// whose mesh may be a voxel's sagitta off, 0.005, the smaller one's points are 0.5 away, but for its radius
// of 0.01.
TEST(DistanceToMesh, OfAPieceThatVoxelsPassCountsAsUnresolved) {
  const Vec3E p = position(), q = p - Vec3E(1.5, 0.0, 0.0);
  const Shape both = field(min(dot(p, p) - 1.0, dot(q, q) - 1e-4), {{-1.2, -1.2, -1.2}, {1.8, 1.2, 1.2}});
  for (const double voxel : {0.2, 0.16, 0.07}) {
    Progress progress;
    const auto meshed = meshShape(both, "both", {.voxelSize = voxel}, progress);
    ASSERT_TRUE(meshed.ok()) << meshed.error().message;
    EXPECT_EQ(meshed->stats.components, 1) << voxel;
    EXPECT_NEAR(meshed->stats.maxDistance, 0.5, 0.02) << voxel;
    EXPECT_GT(meshed->stats.unresolved, 0u) << voxel;
  }
}

// A thin solid in a scene whose voxels are too coarse for it keeps the tolerance, or it is said that it does
// not.
TEST(DistanceToMesh, IsPartOfWhatIsReported) {
  const Shape door = box({0.5, 1.0, 0.04});
  for (const double voxel : {0.05, 0.1, 0.26}) {
    Progress progress;
    const auto meshed =
        meshShape(door, "door", {.voxelSize = voxel, .tolerance = 0.052, .strict = false}, progress);
    ASSERT_TRUE(meshed.ok()) << meshed.error().message;
    glm::vec3 reach(0.0f);
    for (const glm::vec3& p : meshed->mesh.positions) reach = glm::max(reach, glm::abs(p));
    EXPECT_GT(meshed->stats.surfacePoints, 1000u);
    EXPECT_LE(0.5 - reach.x, meshed->stats.maxDistance + 1e-6) << voxel;
    EXPECT_LE(1.0 - reach.y, meshed->stats.maxDistance + 1e-6) << voxel;
    EXPECT_LE(meshed->stats.maxDistance, 0.052) << voxel;
  }
}

}  // namespace to_mesh_test
}  // namespace sdf::test
