// What is thinner than a voxel: seen by the samples, or reported; and films of no thickness, which are
// neither.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "mesh/scenes.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/deform.h"

namespace sdf {
namespace unresolved_test {

constexpr double kVoxel = 1.0 / 16;

MeshStats meshed(const Shape& s, double voxel = kVoxel) {
  Progress progress;
  const auto result = meshShape(s, "test", {.voxelSize = voxel}, progress);
  if (!result) throw std::runtime_error(result.error().message);
  return result->stats;
}

// A ball, so that there is a mesh, and something beside it.
Shape besideABall(const Shape& s) { return sphere(0.5) | translate(s, {1.5, 0, 0}); }

TEST(Unresolved, IsNothingWhereAllIsThickerThanAVoxel) {
  for (const Shape& s : {sphere(1.0), torus(1.0, 0.3), box(Vec3E(1.0)), cone(0.5, 1.0), test::boredBox(),
                         roundBox(Vec3E(1.0), 0.2), rotate(box(Vec3E(1.0)), {0.4, 0.5, 0.6}),
                         rotate(octahedron(1.0), {0.1, 0.2, 0.3})}) {
    const MeshStats stats = meshed(s);
    EXPECT_EQ(stats.unresolved, 0u) << "near " << stats.firstUnresolved.x << ", " << stats.firstUnresolved.y
                                    << ", " << stats.firstUnresolved.z;
  }
}

TEST(Unresolved, ReportsASheetAtEveryOffsetAtWhichItIsMissed) {
  int missed = 0;
  for (int i = 0; i < 16; ++i) {
    const Shape sheet = box(Vec3E(0.25 * kVoxel, 0.4, 0.4));
    const MeshStats stats = meshed(besideABall(translate(sheet, {i * kVoxel / 16, 0.01, 0.01})));
    if (stats.components == 2) continue;
    ++missed;
    EXPECT_GT(stats.unresolved, 0u) << "offset " << i << " sixteenths";
    EXPECT_NEAR(stats.firstUnresolved.x, 1.5 + i * kVoxel / 16, kVoxel);
  }
  EXPECT_GE(missed, 4) << "half a voxel thick, it is missed at half of the offsets";
}

TEST(Unresolved, ReportsHolesInATurnedSheetThatIsSeenInPart) {
  const MeshStats stats = meshed(rotate(box(Vec3E(0.4 * kVoxel, 1.0, 1.0)), {0.0, 0.03, 0.05}));
  EXPECT_NE(stats.eulerCharacteristic, 2) << "a sheet without holes would leave nothing to report";
  EXPECT_GT(stats.unresolved, 0u);
}

TEST(Unresolved, ReportsSpecksAndRodsThatFallBetweenTheSamples) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> offset(0.0, kVoxel);
  for (int i = 0; i < 40; ++i) {
    const Vec3E at{offset(random), offset(random), offset(random)};
    for (const Shape& s : {sphere(0.3 * kVoxel), capsule({0, -0.3, 0}, {0, 0.3, 0}, 0.2 * kVoxel)}) {
      const MeshStats stats = meshed(besideABall(translate(s, at)));
      EXPECT_TRUE(stats.components == 2 || stats.unresolved > 0) << "seed " << kSeed << ", trial " << i;
    }
  }
}

TEST(Unresolved, ReportsAGapThatIsMissed) {
  const Shape half = box(Vec3E(0.5, 0.5, 0.5));
  const double gap = 0.4 * kVoxel, middle = 0.5 * kVoxel;
  const Shape both =
      translate(half, {middle - 0.5 - gap / 2, 0, 0}) | translate(half, {middle + 0.5 + gap / 2, 0, 0});
  const MeshStats stats = meshed(both);
  ASSERT_EQ(stats.components, 1) << "the gap lies between two planes of the lattice";
  EXPECT_GT(stats.unresolved, 0u);
}

// All that is missed in the tests above is seen at the voxel that is named.
TEST(Unresolved, NamesAVoxelThatWouldDo) {
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> offset(0.0, kVoxel);
  std::vector<std::pair<Shape, int>> cases{
      {rotate(box(Vec3E(0.4 * kVoxel, 1.0, 1.0)), {0.0, 0.03, 0.05}), 1}};
  const auto add = [&](const Shape& s) {
    for (int i = 0; i < 8; ++i)
      cases.emplace_back(besideABall(translate(s, {offset(random), offset(random), offset(random)})), 2);
  };
  add(box(Vec3E(0.25 * kVoxel, 0.4, 0.4)));
  add(rotate(box(Vec3E(0.1 * kVoxel, 0.4, 0.4)), {0.3, 0.4, 0.5}));
  add(sphere(0.3 * kVoxel));
  add(capsule({0, -0.3, 0}, {0, 0.3, 0}, 0.2 * kVoxel));
  add(rotate(capsule({0, -0.3, 0}, {0, 0.3, 0}, 0.3 * kVoxel), {0.3, 0.4, 0.5}));
  const Shape half = box(Vec3E(0.5));
  const double gap = 0.4 * kVoxel, middle = 0.5 * kVoxel;
  cases.emplace_back(
      translate(half, {middle - 0.5 - gap / 2, 0, 0}) | translate(half, {middle + 0.5 + gap / 2, 0, 0}), 2);
  int missed = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [shape, components] = cases[i];
    const MeshStats stats = meshed(shape);
    if (stats.unresolved == 0) continue;
    ++missed;
    ASSERT_GT(stats.resolvingVoxel, 0.0) << "case " << i << ", seed " << kSeed;
    const MeshStats fine = meshed(shape, stats.resolvingVoxel);
    EXPECT_EQ(fine.unresolved, 0u) << "case " << i << " at " << stats.resolvingVoxel / kVoxel << " voxels";
    EXPECT_EQ(fine.components, components) << "case " << i << ", seed " << kSeed;
    EXPECT_GT(stats.resolvingVoxel, 0.05 * kVoxel) << "case " << i << ": no smaller than it must be";
  }
  EXPECT_GE(missed, 20);
}

TEST(Films, TwoBoxesThatShareAFaceAreOneSolid) {
  for (const double rounding : {-1e-7, 0.0, 1e-7}) {
    const Shape half = box(Vec3E(0.5, 0.5, 0.5));
    const MeshStats stats = meshed(translate(half, {-0.5 - rounding, 0, 0}) | translate(half, {0.5, 0, 0}));
    EXPECT_EQ(stats.components, 1) << rounding;
    EXPECT_EQ(stats.eulerCharacteristic, 2) << rounding;
  }
}

TEST(Films, ACutThatEndsInAFaceLeavesNone) {
  for (const double rounding : {-1e-7, 0.0, 1e-7}) {
    // Opens the box's top; its own top lies in the same plane.
    const Shape cut = translate(box(Vec3E(0.25, 0.5, 0.25)), {0, 0.5 + rounding, 0});
    const MeshStats stats = meshed(box(Vec3E(0.5, 1.0, 0.5)) - cut);
    EXPECT_EQ(stats.components, 1) << rounding;
    EXPECT_EQ(stats.eulerCharacteristic, 2) << rounding << ": a film over the cut would close it to a void";
  }
}

TEST(Films, ThoseThatCrossLeaveNothingWhereTheyMeet) {
  const Shape plates = box(Vec3E(1e-30, 0.25, 0.25)) | box(Vec3E(0.25, 0.25, 1e-30));
  for (const Shape& s : {besideABall(plates), box(Vec3E(0.5)) - plates}) {
    const MeshStats stats = meshed(s);
    EXPECT_EQ(stats.components, 1);
    EXPECT_EQ(stats.eulerCharacteristic, 2);
  }
}

TEST(Films, SolidsThatTouchInAPointOfTheLatticeStayTwo) {
  const MeshStats stats = meshed(translate(sphere(0.5), {-0.5, 0, 0}) | translate(sphere(0.5), {0.5, 0, 0}));
  EXPECT_EQ(stats.components, 2);
  EXPECT_EQ(stats.eulerCharacteristic, 4);
}

// The bounds' own distance, a unit or so, is what is left of a formula whose value is in thousands; and its
// slope is ten thousand times as much at their corners.
TEST(Films, AreNotSeenWhereAFormulaIsOnlySteeperElsewhere) {
  const Vec3E p = position(), squares{square(p.x), square(p.y), square(p.z)};
  const Expr quartic = dot(squares, squares) - 0.25;
  for (const double scale : {1.0, 1e4, 1e6}) {
    const double voxel = 0.15;
    Progress progress;
    const auto made = meshShape(field(scale * quartic, Box::centred(glm::dvec3(2.0))), "cube",
                                {.voxelSize = voxel}, progress);
    ASSERT_TRUE(made.ok()) << made.error().message;
    EXPECT_LT(made->stats.maxDistance, 0.1 * voxel) << scale;
    EXPECT_EQ(made->stats.components, 1) << scale;
    EXPECT_EQ(made->stats.eulerCharacteristic, 2) << scale;
  }
}

// Shells of shells touch: the distance is 0 on spheres in the midst of what is solid, where no surface is.
TEST(Films, BetweenShellsHoldNoPartOfTheMesh) {
  for (const double voxel : {0.02, 0.0202, 0.0187}) {
    Shape s = sphere(1.0);
    for (int i = 1; i <= 3; ++i) {
      s = shell(s, 0.02);
      if (i == 1) continue;  // a voxel thin, and without a film
      Progress progress;
      const auto made = meshShape(s, "test", {.voxelSize = voxel}, progress);
      ASSERT_TRUE(made);
      EXPECT_LE(made->stats.maxDistance, 1e-4) << voxel << ", " << i;
      EXPECT_EQ(made->stats.components, 2) << voxel << ", " << i;
      for (const glm::vec3& p : made->mesh.positions)
        ASSERT_NEAR(std::abs(glm::length(p) - 1.0), 0.01 * i, 1e-4) << voxel << ", " << i;
    }
  }
}

}  // namespace unresolved_test
}  // namespace sdf
