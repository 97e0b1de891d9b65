// Meshes held to solids written by hand, and those solids to CGAL.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "accuracy/meshes/mesh_cases.h"
#include "accuracy/operators/operator_meshes.h"
#include "accuracy/solids/meshes.h"
#include "bench/shapes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace meshes_test {

constexpr unsigned kSeed = 3;
// What distances to a solid written by hand are good for.
constexpr double kFoot = 1e-9;

glm::dvec3 around(double reach, PointMaker::Random& random) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

TEST(PiecewiseSolid, HasTheDistanceOfABoxThatCgalFinds) {
  const glm::dvec3 half(1.0, 0.5, 0.25);
  const PiecewiseSolid solid = boxSolid(half);
  const Reference reference(boxMesh(half));
  PointMaker::Random random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p = around(1.5, random);
    EXPECT_NEAR(solid.distance(p), reference.distance(p), kFoot);
  }
}

// The drilled box S2 cut out of meshes. Each differs from its surface by its chord at most; along an edge
// where two of them meet at 60 degrees or more, which all do here, by twice that.
TEST(PiecewiseSolid, HasTheDistanceOfADrilledBoxThatCgalCutsOut) {
  const Tessellation ball = sphereSurface(1.3, 4);
  TriangleMesh mesh = corefine(boxMesh(glm::dvec3(1.0)), ball.mesh, Boolean::Intersection);
  double chord = ball.chord;
  for (int axis = 0; axis < 3; ++axis) {
    // Each is turned by another angle: CGAL 5.5 falls over faces that lie in one plane.
    const double start = 0.1 + 0.03 * axis;
    Outline circle;
    circle.arc({0, 0}, 0.5, start, start + 2.0 * kPi, 60);
    const Tessellation bore = prism(circle, 2.0, [axis](const glm::dvec3& p) {
      return axis == 0 ? glm::dvec3(p.z, p.x, p.y) : axis == 1 ? glm::dvec3(p.y, p.z, p.x) : p;
    });
    mesh = corefine(mesh, bore.mesh, Boolean::Difference);
    chord = std::max(chord, bore.chord);
  }
  const Reference reference(mesh);
  const PiecewiseSolid solid = meshCases()[1].make().solid;
  const double allowed = 2.0 * chord + kFoot;
  EXPECT_LT(allowed, 0.02) << "less than what a wrong foot is off by";
  PointMaker::Random random(kSeed);
  for (const glm::dvec3& on : solid.surfacePoints(1000, kSeed)) {
    EXPECT_LE(reference.distance(on), allowed);
    const glm::dvec3 p = on + around(0.1, random);
    EXPECT_NEAR(solid.distance(p), reference.distance(p), allowed) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(PiecewiseSolid, SpreadsPointsEvenlyOverItsSurface) {
  const glm::dvec3 half(1.0, 0.5, 0.25);
  constexpr int kCount = 20000;
  glm::dvec3 found(0.0);
  for (const glm::dvec3& p : boxSolid(half).surfacePoints(kCount, kSeed))
    for (int axis = 0; axis < 3; ++axis) found[axis] += std::abs(std::abs(p[axis]) - half[axis]) < kFoot;
  const glm::dvec3 area(half.y * half.z, half.z * half.x, half.x * half.y);
  for (int axis = 0; axis < 3; ++axis) {
    const double share = area[axis] / (area.x + area.y + area.z);
    // Two points of one line are not independent: at most twice the variance. Four standard deviations.
    EXPECT_NEAR(found[axis], share * kCount, 4.0 * std::sqrt(2.0 * share * (1.0 - share) * kCount));
  }
}

// The same surface, by the library's own reading of the shape.
TEST(MeshCases, AreTheMeasuringShapes) {
  for (const NamedMeshCase& named : meshCases()) {
    SCOPED_TRACE(named.name);
    const MeshCase c = named.make();
    const Tape tape(c.shape.distance);
    PointMaker::Random random(kSeed);
    for (const glm::dvec3& on : c.solid.surfacePoints(500, kSeed)) {
      EXPECT_NEAR(evaluate(tape, on), 0.0, kFoot);
      const glm::dvec3 p = around(bench::kRegion, random);
      EXPECT_EQ(evaluate(tape, p) < 0.0, c.solid.value(p) < 0.0);
    }
  }
}

MeshedShape meshOf(const Shape& shape, const MeshOptions& options) {
  Progress progress;
  return meshShape(shape, "case", options, progress).value();
}

struct Found {
  MeshStats reported;
  Spread toSurface, toMesh;
};
Found found(const Shape& shape, const PiecewiseSolid& solid, double voxel) {
  constexpr std::size_t kPoints = 20000;
  const MeshedShape m = meshOf(shape, {.voxelSize = voxel});
  const TriangleMesh mesh = weldedMesh(m.mesh);
  return {m.stats, toSurface(mesh, solid, kPoints, kSeed), toMesh(solid.surfacePoints(kPoints, kSeed), mesh)};
}

// The root of the mean square of n distances varies by sqrt((k - 1) / n) / 2 of itself, k being their
// kurtosis: by 1 % for 20,000 of k = 9, where the sags of triangles are as unlike as if two thirds of them
// were flat. Three of these. Over a triangle of side s distances to a surface of radius r are quadratic but
// for a share of (s / r)^2, 1 % here.
constexpr double kChance = 0.03;

void expectAgreement(const Found& f) {
  EXPECT_NEAR(f.reported.rmsDistance, f.toSurface.rms, kChance * f.toSurface.rms);
  EXPECT_NEAR(f.reported.rmsDistance, f.toMesh.rms, kChance * f.toMesh.rms);
}

TEST(MeshDistances, OfABallAreWhatIsReported) {
  const Found f = found(sphere(1.0), meshCases()[0].make().solid, 1.0 / 16);
  expectAgreement(f);
  EXPECT_NEAR(f.toSurface.max, f.reported.maxDistance, kChance * f.reported.maxDistance);
  EXPECT_LE(f.toMesh.max, (1.0 + kChance) * f.reported.maxDistance);
}
TEST(MeshDistances, OfADrilledBoxAreWhatIsReported) {
  const MeshCase c = meshCases()[1].make();
  expectAgreement(found(c.shape, c.solid, 1.0 / 32));
}

TEST(MeshDistances, OfATurnedBoxAreRounding) {
  // Corners are rounded to floats below 2, by half a step of 2^-23 along each axis, and what makes them of
  // tangent planes a few steps more.
  constexpr double kRounding = 8 * 0x1p-23;
  const glm::dvec3 half(1.0, 0.5, 0.25), axis(1, 2, 3);
  const MeshedShape m =
      meshOf(rotateAbout(box(Vec3E(half.x, half.y, half.z)), Vec3E(1, 2, 3), 0.7), {.voxelSize = 1.0 / 32});
  EXPECT_LE(m.stats.maxDistance, kRounding);
  const glm::dmat3 back = glm::transpose(turn(axis, 0.7));
  const PiecewiseSolid solid = boxSolid(half);
  const TriangleMesh mesh = turned(weldedMesh(m.mesh), back);
  EXPECT_LE(toSurface(mesh, solid, 20000, kSeed).max, kRounding);
  EXPECT_LE(toMesh(solid.surfacePoints(20000, kSeed), mesh).max, kRounding);
}

TEST(MeshDistances, SeeWhatIsMissing) {
  // Of two balls the mesh has one: from the mesh all is well.
  PiecewiseSolid two = meshCases()[0].make().solid;
  two.pieces.push_back([](const glm::dvec3& p) { return glm::distance(p, glm::dvec3(3, 0, 0)) - 0.5; });
  two.united = true, two.radius = 3.5;
  const TriangleMesh mesh = weldedMesh(meshOf(sphere(1.0), {.voxelSize = 1.0 / 16}).mesh);
  EXPECT_LT(toSurface(mesh, two, 1000, kSeed).max, 1e-3);
  // The farthest point of the missing one is 3.5 from the other's centre. A fifth of the points lie on it,
  // and none of 200 in the twentieth of it that is within 0.05 of there with a chance of 3e-5.
  const double missing = toMesh(two.surfacePoints(1000, kSeed), mesh).max;
  EXPECT_GT(missing, 2.5 - 0.05);
  EXPECT_LT(missing, 2.5 + 1e-3) << "the mesh's chords are shorter than that";
}

TEST(MeshRow, IsRefutedBeyondWhatIsProven) {
  MeshRow row;
  row.toMesh.max = 2e-3;
  EXPECT_FALSE(row.refuted()) << "nothing is proven";
  row.stats.provenDistance = 1e-3;
  EXPECT_TRUE(row.refuted());
  row.stats.provenDistance = 2e-3;
  EXPECT_FALSE(row.refuted());
}

}  // namespace meshes_test
}  // namespace sdf::accuracy
