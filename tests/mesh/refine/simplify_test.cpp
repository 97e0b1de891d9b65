#include "sdf/mesh/refine/simplify.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "mesh/lattice_mesh.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/refine/ring.h"
#include "sdf/shape/operators/deform.h"

namespace sdf::test {
namespace simplify_test {

using Fine = LatticeMesh;

// Nothing is too far, as far as anybody else has seen.
std::vector<glm::vec3> nothing(const FeatureMesh&) { return {}; }

FeatureMesh simplified(const Fine& fine, double tolerance) {
  Progress progress;
  FeatureMesh mesh = fine.mesh;
  simplify(mesh, fine.field, tolerance, {}, nothing, false, progress);
  return mesh;
}

// The largest |distance(p)| of 16 random points of each triangle.
template <class Distance>
double farthest(const FeatureMesh& mesh, const Distance& distance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double most = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 16; ++k) {
      double u = share(random), v = share(random);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      most = std::max(most, std::abs(distance(a + u * (b - a) + v * (c - a))));
    }
  return most;
}

// Along an edge that sticks out of a rounding all points of the surface are near the triangles beside it.
TEST(Simplify, WhatSticksOutOfARoundingIsSplit) {
  constexpr double kTolerance = 4e-3;
  for (const double radius : {0.01, 0.014, 0.02, 0.03}) {
    const Shape shape = round(cylinder(0.5, 0.3), radius);
    const Fine fine(shape, 0.01);
    FeatureMesh mesh = fine.mesh;
    Progress progress;
    EXPECT_TRUE(simplify(mesh, fine.field, kTolerance, {}, nothing, false, progress));
    const TapePtr tape = tapeOf(shape);
    const double off = farthest(mesh, [&](const glm::dvec3& p) { return evaluate(*tape, p); });
    EXPECT_LE(off, 1.02 * kTolerance) << radius;
  }
}

// Of a ball equilateral triangles whose corners lie E outside and whose middles lie E inside are the fewest,
// 0.1925 * 4 pi / E (Nadler 1986).
TEST(Simplify, ABallTakesLittleMoreThanTheLeastNumberOfTriangles) {
  const Fine fine(sphere(1.0), 0.04);
  for (const double tolerance : {1e-2, 3e-3, 1e-3}) {
    SCOPED_TRACE(tolerance);
    const FeatureMesh mesh = simplified(fine, tolerance);
    EXPECT_LT(static_cast<double>(mesh.triangles.size()), 1.45 * 0.1925 * 4.0 * kPi / tolerance);
    // Between the places that were looked at it is off by a few percent more.
    EXPECT_LE(farthest(mesh, [](const glm::dvec3& p) { return glm::length(p) - 1.0; }), 1.03 * tolerance);
    expectTopology(mesh, 1, 2);
  }
}

TEST(Simplify, ATorusKeepsItsHandle) {
  const Fine fine(torus(1.0, 0.4), 0.05);
  const FeatureMesh mesh = simplified(fine, 2e-3);
  expectTopology(mesh, 1, 0);
  const auto distance = [](const glm::dvec3& p) { return std::hypot(std::hypot(p.x, p.z) - 1.0, p.y) - 0.4; };
  EXPECT_LE(farthest(mesh, distance), 1.03 * 2e-3);
  EXPECT_LT(mesh.triangles.size(), fine.mesh.triangles.size() / 4);
}

TEST(Simplify, ABoxIsTwelveTriangles) {
  for (const double angle : {0.0, 0.3}) {
    SCOPED_TRACE(angle);
    const Shape turned = rotate(box({1.0, 0.6, 0.8}), {angle, 0.5 * angle, 0.2 * angle});
    const FeatureMesh mesh = simplified(Fine(turned, 0.11), 1e-3);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.creases.size(), 12u);
    expectTopology(mesh, 1, 2);
  }
}

// The wall of a cylinder is one ring of strips, and its rims are as far outside as inside: with corners on
// the circle chords of the angle a are 1 - cos(a / 2) off, with twice that balanced.
TEST(Simplify, ACylindersWallIsOneRing) {
  const double tolerance = 2e-3;
  const FeatureMesh mesh = simplified(Fine(cylinder(1.0, 0.5), 0.06), tolerance);
  const double least = kPi / std::acos(1.0 - 2.0 * tolerance);
  std::size_t onRims = 0;
  for (const glm::vec3& p : mesh.positions) onRims += std::abs(std::abs(p.y) - 0.5f) < 1e-5f;
  EXPECT_EQ(onRims, mesh.positions.size());
  EXPECT_LT(static_cast<double>(onRims), 2.0 * 1.35 * least);
  expectTopology(mesh, 1, 2);
}

// What the lattice is too coarse for is read from the field, and split.
TEST(Simplify, AMeshThatIsTooCoarseIsRefined) {
  const Fine fine(sphere(1.0), 0.25);
  const double tolerance = 3e-3;
  const auto distance = [](const glm::dvec3& p) { return glm::length(p) - 1.0; };
  ASSERT_GT(farthest(fine.mesh, distance), 2.0 * tolerance);
  const FeatureMesh mesh = simplified(fine, tolerance);
  EXPECT_LE(farthest(mesh, distance), 1.03 * tolerance);
  expectTopology(mesh, 1, 2);
}

// Triangles are held to 60 degrees from those around and from samples, whose normals differ from the
// surface's in their middles.
TEST(Simplify, NoTriangleIsTurned) {
  const Shape shape = melt();
  const FeatureMesh mesh = simplified(Fine(shape, 0.04), 3e-3);
  const TapePtr tape = tapeOf(shape)->firstOutputOnly();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const auto g = evaluateGradient(*tape, (a + b + c) / 3.0);
    ASSERT_GT(glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(g.gradient)), 0.3);
  }
}

// Each sheet may be off by more than the gap between them.
TEST(Simplify, NothingCrossesWhereSheetsAreClose) {
  const double tolerance = 0.05, gap = 0.06;
  const Shape ring = torus(0.5, 0.15);
  const Shape links = unite(ring, translate(rotate(ring, {90.0, 0.0, 0.0}), {1.0 - 0.3 - gap, 0.0, 0.0}));
  expectTopology(simplified(Fine(links, 0.02), tolerance), 2, 0);
  const Shape hollow = subtract(sphere(0.5), sphere(0.5 - gap));
  expectTopology(simplified(Fine(hollow, 0.02), tolerance), 2, 4);
}

// Two sheets, closer than both may be off, of so many triangles that blocks of them are changed at once.
TEST(Simplify, DoesNotDependOnThreadsAndCrossesNothingWhereBlocksAreChangedAtOnce) {
  const Fine fine(shell(sphere(1.0), 0.03), 0.03);
  ASSERT_GT(fine.mesh.positions.size(), 25'000u);
  FeatureMesh first;
  for (const int threads : {1, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const FeatureMesh mesh = simplified(fine, 0.012);
    expectTopology(mesh, 2, 4);
    if (threads == 1) first = mesh;
    EXPECT_TRUE(mesh.positions == first.positions && mesh.triangles == first.triangles) << threads;
  }
  EXPECT_LT(first.triangles.size(), 1500u);
}

// A rounding of a few tolerances has few facets, which are turned by up to 90 degrees from one another.
TEST(Simplify, SmallRoundingsAreKept) {
  const Shape frame = round(subtract(box({1.96, 0.16, 1.96}), box({1.5, 1.0, 1.5})), 0.04);
  const double tolerance = 3e-3;
  const TapePtr tape = tapeOf(frame)->firstOutputOnly();
  const FeatureMesh mesh = simplified(Fine(frame, 0.022), tolerance);
  EXPECT_LE(farthest(mesh, [&](const glm::dvec3& p) { return evaluate(*tape, p); }), 1.03 * tolerance);
  EXPECT_LT(mesh.triangles.size(), 400u);
  expectTopology(mesh, 1, 0);
}

// What others see to be too far is looked at again; what does not change for it is left.
TEST(Simplify, LooksAgainAtWhatExceedsUntilThatChangesNothing) {
  const Fine fine(sphere(1.0), 0.1);
  Progress progress;
  int asked = 0;
  const auto alwaysThere = [&](const FeatureMesh&) {
    ++asked;
    return std::vector<glm::vec3>{{0.0f, 0.0f, 1.1f}};
  };
  FeatureMesh mesh = fine.mesh;
  EXPECT_FALSE(simplify(mesh, fine.field, 1e-2, {}, alwaysThere, false, progress));
  EXPECT_TRUE(asked == 1 || asked == 2) << asked;
  EXPECT_TRUE(simplify(mesh, fine.field, 1e-2, {}, nothing, false, progress));
  expectTopology(mesh, 1, 2);
}

TEST(Simplify, DoesNotChangeAMeshOnceItIsStopped) {
  const Fine fine(sphere(1.0), 0.1);
  Progress progress;
  progress.stop();
  FeatureMesh mesh = fine.mesh;
  simplify(mesh, fine.field, 1e-2, {}, nothing, false, progress);
  EXPECT_EQ(mesh.triangles.size(), fine.mesh.triangles.size());
  expectTopology(mesh, 1, 2);
}

// Changes hand each sample on to one of the triangles around.
TEST(SampledMesh, KeepsEachSampleInOneList) {
  const Fine fine(cylinder(0.5, 0.5), 0.1);
  Progress progress;
  SampledMesh sampled(fine.mesh, fine.field, HUGE_VALF, progress);
  const auto count = [&] {
    std::size_t all = 0;
    for (std::uint32_t t = 0; t < sampled.onTriangle.count(); ++t)
      for (auto w = sampled.onTriangle.first(t); w != Lists::kNone; w = sampled.onTriangle.after(w)) ++all;
    for (std::uint32_t e = 0; e < sampled.onCrease.count(); ++e)
      for (auto w = sampled.onCrease.first(e); w != Lists::kNone; w = sampled.onCrease.after(w)) ++all;
    return all;
  };
  const std::size_t before = count();
  EXPECT_EQ(before, sampled.samples.size());
  Ring ring(sampled, 1.0f);
  int made = 0;
  for (std::uint32_t h = 0; h < sampled.mesh.halfEdges() && made < 200; h += 7) {
    if (!sampled.mesh.alive(h)) continue;
    const glm::vec3 middle =
        0.5f * (sampled.mesh.positions[sampled.mesh.from(h)] + sampled.mesh.positions[sampled.mesh.to(h)]);
    if (made % 2 == 0) {
      ring.setSplit(h);
      if (!ring.cut(middle) || !ring.place(middle)) continue;
      sampled.split(h, middle);
    } else {
      const glm::vec3 at = sampled.mesh.positions[sampled.mesh.to(h)];
      if (!sampled.mesh.canCollapse(h)) continue;
      ring.setCollapsed(h);
      if (!ring.cut(at) || !ring.place(at)) continue;
    }
    ring.assign(0.0f);  // a limit that drops none
    if (made % 2 == 1) sampled.collapse(h, sampled.mesh.positions[sampled.mesh.to(h)]);
    ++made;
    ASSERT_EQ(count(), before) << made;
  }
  EXPECT_EQ(made, 200);
}

}  // namespace simplify_test
}  // namespace sdf::test
