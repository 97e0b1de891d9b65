#include "sdf/mesh/refine/remesh.h"
#include "sdf/mesh/refine/coarsen.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>
#include <tuple>

#include "mesh/feature_meshes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/refine/remesh_changes.h"
#include "sdf/mesh/refine/remesh_fans.h"
#include "sdf/mesh/refine/remesh_measure.h"
#include "sdf/mesh/refine/remesh_paint.h"
#include "sdf/mesh/surface/project.h"
#ifdef SDF_REFERENCE
#include "reference/reference.h"
#endif

namespace sdf::test {
namespace remesh_test {

struct Meshed {
  FeatureMesh mesh;
  RemeshResult result;
  MeshStats stats;
};

Meshed remeshed(FeatureMesh mesh, const LocalField& field, const RemeshOptions& options) {
  Progress progress;
  Meshed m{std::move(mesh), {}, {}};
  coarsen(m.mesh, field, {0.7 * options.tolerance, options.painted}, progress);
  m.result = remesh(m.mesh, field, options, progress);
  measureTopology(m.mesh.triangles, m.mesh.positions.size(), m.stats);
  return m;
}

// The mesh of a smooth shape as it comes from the band.
struct Fine {
  Fine(const Shape& shape, double voxel)
      : band(bandOf(shape, shape.bounds, voxel)), field(band, wholeTapes(tapeOf(shape))) {
    RawSurface raw = band.extract();
    std::vector<glm::vec3> normals;
    Progress progress;
    refineVertices(raw.points, normals, field, progress);
    mesh = {std::move(raw.points), std::move(raw.triangles), {}};
    measureTopology(mesh.triangles, mesh.positions.size(), stats);
  }
  NarrowBand band;
  BandField field;
  FeatureMesh mesh;
  MeshStats stats;
};

void expectNothingCrosses(const FeatureMesh& mesh) {
#ifdef SDF_REFERENCE
  accuracy::TriangleMesh all;
  for (const glm::vec3& p : mesh.positions) all.points.emplace_back(p);
  for (const glm::uvec3& t : mesh.triangles) all.triangles.emplace_back(t);
  EXPECT_EQ(accuracy::crossings(all), 0u);
#else
  static_cast<void>(mesh);
#endif
}

// Calls take(point) for 16 random points of each triangle.
template <class Take>
void strewOver(const FeatureMesh& mesh, const Take& take) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 16; ++k) {
      double u = share(random), v = share(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      take(a + u * (b - a) + v * (c - a));
    }
}

void expectTopologyOf(const Meshed& m, int components, int euler) {
  EXPECT_TRUE(m.stats.watertight);
  EXPECT_TRUE(m.stats.manifold);
  EXPECT_EQ(m.stats.components, components);
  EXPECT_EQ(m.stats.eulerCharacteristic, euler);
  expectNothingCrosses(m.mesh);
}

// 0.1925 * integral of sqrt|K| dA / E, for a ball of radius 1: the least that equilateral triangles whose
// corners lie E outside and whose centroids lie E inside can do (Nadler 1986).
double leastForBall(double tolerance) { return 0.1925 * 4.0 * kPi / tolerance; }

// Where triangles have no area, what is proposed may be no number.
TEST(Remesh, AFanWhoseCentreIsNoNumberIsNotSound) {
  const Fine fine(sphere(1.0), 0.25);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Fans fans;
  for (const float x : {1.0f, nan}) fans.all.push_back({.centre = {x, 0, 0}, .first = 0, .count = 3});
  for (const int k : {0, 1, 2}) {
    const float turn = 2.0f * static_cast<float>(kPi) * static_cast<float>(k) / 3.0f;
    fans.rim.push_back({{0.995f, 0.1f * std::cos(turn), 0.1f * std::sin(turn)}, 0, false, 0});
  }
  Progress progress;
  std::vector<FanError> errors;
  evaluateFans(fans, 0.1f, Sampling::All, fine.field, progress, errors);
  EXPECT_TRUE(errors[0].sound);
  EXPECT_FALSE(errors[1].sound);
}

TEST(Remesh, ABallTakesLittleMoreThanTheLeastNumberOfTriangles) {
  const Fine fine(sphere(1.0), 0.04);
  for (const double tolerance : {1e-2, 3e-3, 1e-3}) {
    SCOPED_TRACE(tolerance);
    const Meshed m = remeshed(fine.mesh, fine.field, {tolerance});
    EXPECT_TRUE(m.result.kept);
    EXPECT_LE(m.result.maxDistance, tolerance);
    EXPECT_LT(static_cast<double>(m.mesh.triangles.size()), 1.32 * leastForBall(tolerance));
    expectTopologyOf(m, 1, 2);
    double nearest = 2.0, farthest = 0.0;
    strewOver(m.mesh, [&](const glm::dvec3& p) {
      nearest = std::min(nearest, glm::length(p));
      farthest = std::max(farthest, glm::length(p));
    });
    EXPECT_GE(nearest, 1.0 - tolerance);
    EXPECT_LE(farthest, 1.0 + tolerance);
    // Vertices outside, middles inside: the error stands on both sides.
    EXPECT_LT(nearest, 1.0 - 0.5 * tolerance);
    EXPECT_GT(farthest, 1.0 + 0.5 * tolerance);
  }
}

TEST(Remesh, ACoarserMeshIsRefined) {
  const Fine fine(sphere(1.0), 0.3);
  ASSERT_LT(fine.mesh.triangles.size(), 1000u);
  const Meshed m = remeshed(fine.mesh, fine.field, {1e-3});
  EXPECT_TRUE(m.result.kept);
  EXPECT_LT(static_cast<double>(m.mesh.triangles.size()), 1.35 * leastForBall(1e-3));
  expectTopologyOf(m, 1, 2);
}

TEST(Remesh, ATorusKeepsItsHandleAndItsTolerance) {
  const Fine fine(torus(1.0, 0.4), 0.04);
  const Meshed m = remeshed(fine.mesh, fine.field, {2e-3});
  EXPECT_TRUE(m.result.kept);
  expectTopologyOf(m, 1, 0);
  strewOver(m.mesh, [&](const glm::dvec3& p) {
    const double d = std::hypot(std::hypot(p.x, p.z) - 1.0, p.y) - 0.4;
    ASSERT_LE(std::abs(d), 2e-3);
  });
}

TEST(Remesh, BlendedBallsKeepTheirPartsAndNoTriangleIsTurned) {
  const Shape shape = melt();
  const Fine fine(shape, 0.04);
  const double tolerance = 3e-3;
  const Meshed m = remeshed(fine.mesh, fine.field, {tolerance});
  EXPECT_TRUE(m.result.kept);
  expectTopologyOf(m, fine.stats.components, fine.stats.eulerCharacteristic);
  EXPECT_LT(m.mesh.triangles.size(), fine.mesh.triangles.size() / 4);
  const TapePtr tape = tapeOf(shape)->firstOutputOnly();
  for (const glm::uvec3& t : m.mesh.triangles) {
    const glm::dvec3 a(m.mesh.positions[t.x]), b(m.mesh.positions[t.y]), c(m.mesh.positions[t.z]);
    const auto g = evaluateGradient(*tape, (a + b + c) / 3.0);
    const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    // 60 degrees, and what the normal turns by as positions are rounded to float.
    ASSERT_GT(glm::dot(normal, glm::normalize(g.gradient)), 0.49);
  }
}

TEST(Remesh, VerticesThatSplitsBroughtTogetherAreMerged) {
  const Fine fine(sphere(1.0), 0.1);
  HalfEdgeMesh mesh(fine.mesh);
  const std::size_t before = mesh.liveTriangles();
  Progress progress;
  RemeshChanges changes(mesh, fine.field, 1e-2, false, progress);
  EXPECT_EQ(changes.collapseShortest(), 0u);
  for (const std::uint32_t h : {0u, 300u, 600u}) {
    const glm::vec3 end = mesh.positions[mesh.from(h)];
    mesh.split(h, end + 5e-3f * 1e-2f * glm::vec3(1, 0, 0));  // half of what is next to nothing
    mesh.split(h, end);
  }
  RemeshChanges after(mesh, fine.field, 1e-2, false, progress);
  EXPECT_EQ(after.collapseShortest(), 6u);
  EXPECT_EQ(mesh.liveTriangles(), before);
}

TEST(Remesh, ACubeIsTwelveTrianglesWithTheCornersWhereTheyWere) {
  const WholeField field(box(Vec3E(1.0)), 0.1);
  for (const int n : {1, 2, 7, 24}) {
    SCOPED_TRACE(n);
    const Meshed m = remeshed(griddedCube(n), field, {1e-3});
    EXPECT_TRUE(m.result.kept);
    EXPECT_EQ(m.mesh.triangles.size(), 12u);
    EXPECT_EQ(m.mesh.creases.size(), 12u);
    expectTopologyOf(m, 1, 2);
    for (const glm::vec3& p : m.mesh.positions) EXPECT_EQ(glm::abs(p), glm::vec3(1.0f));
    EXPECT_EQ(m.result.maxDistance, 0.0);
  }
}

TEST(Remesh, ACylindersWallIsOneRingOfStrips) {
  const WholeField field(cylinder(1.0, 1.0), 0.05);
  const double tolerance = 1e-3;
  const Meshed m = remeshed(griddedCylinder(200, 20), field, {tolerance});
  EXPECT_TRUE(m.result.kept);
  expectTopologyOf(m, 1, 2);
  for (const glm::vec3& p : m.mesh.positions) {
    EXPECT_NEAR(std::abs(p.y), 1.0, tolerance);
    EXPECT_NEAR(std::hypot(p.x, p.z), 1.0, tolerance);
  }
  // All vertices lie on the two rims; a polygon whose corners lie E outside the circle and whose middles lie
  // E inside has pi / acos((1 - E) / (1 + E)) corners.
  EXPECT_EQ(m.mesh.creases.size(), m.mesh.positions.size());
  const double least = kPi / std::acos((1.0 - tolerance) / (1.0 + tolerance));
  EXPECT_LT(static_cast<double>(m.mesh.positions.size()), 1.3 * 2.0 * least);
}

TEST(Remesh, TheNumberOfThreadsChangesNothing) {
  const Fine fine(torus(1.0, 0.4), 0.06);
  const auto by = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return remeshed(fine.mesh, fine.field, {3e-3}).mesh;
  };
  const FeatureMesh one = by(1), two = by(2), many = by(8);
  EXPECT_EQ(one.positions, two.positions);
  EXPECT_EQ(one.triangles, two.triangles);
  EXPECT_EQ(one.positions, many.positions);
  EXPECT_EQ(one.triangles, many.triangles);
}

#ifdef SDF_REFERENCE
TEST(Remesh, CrossingTrianglesWouldBeSeen) {
  accuracy::TriangleMesh two;
  for (const double at : {0.0, 0.1}) {
    const int first = static_cast<int>(two.points.size());
    for (const glm::dvec3 p : {glm::dvec3(0.0), {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}})
      two.points.push_back(p + at);
    for (const glm::ivec3 t : {glm::ivec3(0, 2, 1), {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      two.triangles.push_back(t + first);
  }
  EXPECT_GT(accuracy::crossings(two), 0u);
}
#endif

TEST(Remesh, MeasuringAgainReadsWhatHasMoved) {
  const Shape ball = sphere(1.0).paint({.color = {0.5 + 0.5 * sin(9.0 * position().x), 0.5, 0.5}});
  const Fine fine(ball, 1.0 / 16);
  HalfEdgeMesh mesh(fine.mesh);
  std::vector<TriangleDistances> distances;
  std::vector<TriangleColors> colors;
  Progress progress;
  const double before = measureDensely(mesh, fine.field, 0.01, distances, progress).largest;
  measureColors(mesh, 0.01f, fine.field, colors, progress);
  for (std::uint32_t v = 0; v < mesh.vertices(); v += 97) mesh.positions[v] *= 1.1f;
  const DenseDistances again = measureDensely(mesh, fine.field, 0.01, distances, progress);
  const ColorErrors colorsAgain = measureColors(mesh, 0.01f, fine.field, colors, progress);
  std::vector<TriangleDistances> nothing;
  std::vector<TriangleColors> none;
  const DenseDistances afresh = measureDensely(mesh, fine.field, 0.01, nothing, progress);
  const ColorErrors colorsAfresh = measureColors(mesh, 0.01f, fine.field, none, progress);
  EXPECT_LT(before, 0.01);
  // Vertices lie on the ball to some roundings of floats near 1, and have been moved by a tenth.
  EXPECT_NEAR(again.largest, 0.1, 16 * 0x1p-24);
  EXPECT_EQ(again.largest, afresh.largest);
  EXPECT_EQ(again.exceeding, afresh.exceeding);
  EXPECT_EQ(again.vertices, afresh.vertices);
  EXPECT_EQ(colorsAgain.largest, colorsAfresh.largest);
  EXPECT_EQ(colorsAgain.exceeding, colorsAfresh.exceeding);
  EXPECT_FALSE(again.exceeding.empty());
  EXPECT_GT(colorsAgain.largest, 0.0);
}

TEST(Remesh, LeavesWhatIsHeld) {
  Fine fine(sphere(1.0), 0.1);
  FeatureMesh& mesh = fine.mesh;
  const auto isHeld = [](const glm::vec3& p) { return p.x > 0.3f; };
  for (const glm::vec3& p : mesh.positions) mesh.held.push_back(isHeld(p) ? Hold::Fixed : Hold::Free);
  const auto order = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  const auto heldOf = [&](const FeatureMesh& m) {
    std::vector<glm::vec3> held;
    for (const glm::vec3& p : m.positions)
      if (isHeld(p)) held.push_back(p);
    std::ranges::sort(held, order);
    return held;
  };
  const Meshed m = remeshed(mesh, fine.field, {1e-2});
  EXPECT_TRUE(m.result.kept);
  EXPECT_TRUE(m.stats.watertight && m.stats.manifold);
  EXPECT_LT(m.mesh.triangles.size(), mesh.triangles.size() * 6 / 10) << "the rest is thinned";
  std::size_t marked = 0;
  for (std::size_t v = 0; v < m.mesh.positions.size(); ++v) {
    if (m.mesh.heldAt(static_cast<std::uint32_t>(v)) == Hold::Free) continue;
    ++marked;
    EXPECT_TRUE(isHeld(m.mesh.positions[v]));
  }
  const std::vector<glm::vec3> before = heldOf(mesh), after = heldOf(m.mesh);
  EXPECT_EQ(marked, before.size());
  EXPECT_TRUE(std::ranges::includes(after, before, order));
}

TEST(Remesh, StoppedItLeavesAClosedMesh) {
  struct Impatient : Progress {
    void update(double done) override {
      if (done >= 0.1) stop();
    }
  };
  const Fine fine(sphere(1.0), 0.1);
  Impatient progress;
  FeatureMesh mesh = fine.mesh;
  const RemeshResult result = remesh(mesh, fine.field, {1e-2}, progress);
  EXPECT_FALSE(result.kept);
  MeshStats stats;
  measureTopology(mesh.triangles, mesh.positions.size(), stats);
  EXPECT_TRUE(stats.watertight);
  EXPECT_TRUE(stats.manifold);
  EXPECT_EQ(stats.eulerCharacteristic, 2);
}

}  // namespace remesh_test
}  // namespace sdf::test
