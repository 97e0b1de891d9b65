#include "sdf/mesh/refine/tints.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "mesh/lattice_mesh.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/refine/ring.h"
#include "sdf/mesh/refine/simplify.h"

namespace sdf::test {
namespace tints_test {

Paint grey(float v) { return {glm::vec3(v), glm::vec3(v), 0}; }

TEST(Tints, HoldOnlyChannelsThatChange) {
  EXPECT_FALSE(Tints({grey(0.3f), grey(0.3f)}, 0.1f).any());
  // Red changes, and the ambient light with it; blue's ambient light by itself.
  const std::vector<Paint> paint{{{0.1f, 0.5f, 0.7f}, {0.1f, 0.5f, 0.7f}, 0},
                                 {{0.9f, 0.5f, 0.7f}, {0.9f, 0.5f, 1.3f}, 0}};
  const Tints tints(paint, 0.1f);
  EXPECT_EQ(tints.channels(), 2u);
  for (const Paint& p : paint) {
    const CornerColor c = tints.colorOf(tints.of(p));
    EXPECT_EQ(c.color, p.color);
    EXPECT_EQ(c.ambient, p.ambient);
  }
}

TEST(Tints, ADifferenceCountsAsADistance) {
  Tints tints({grey(0.0f), grey(1.0f)}, 0.1f);
  const Paint seen = grey(0.25f);
  tints.addSample(&seen), tints.addSample(nullptr);
  const Paint shown = grey(0.2501f);
  EXPECT_NEAR(tints.distance(0u, tints.of(shown)), tints.distance(colorDifference(seen, shown)), 1e-6);
  EXPECT_EQ(tints.distance(1u, tints.of(shown)), 0.0f) << "nothing is known of it";
  // What is allowed of the colours is somewhat more than what samples are held to as the tolerance.
  EXPECT_GT(tints.distance(kColorTolerance), 0.1f);
  EXPECT_LT(tints.distance(kColorTolerance), 0.12f);
}

// Of one matrix with an eigenvalue of either sign, turned by all angles.
TEST(Ring, AbsoluteFormsHaveTheSizesOfTheirEigenvalues) {
  for (double angle = 0.0; angle < 3.2; angle += 0.1) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [&](double first, double second) {
      return glm::dvec3(first * c * c + second * s * s, (first - second) * c * s,
                        first * s * s + second * c * c);
    };
    EXPECT_LT(glm::distance(absolute(turned(2.0, -0.5)), turned(2.0, 0.5)), 1e-12) << angle;
    EXPECT_LT(glm::distance(absolute(turned(-1.0, -3.0)), turned(1.0, 3.0)), 1e-12) << angle;
  }
  EXPECT_EQ(absolute(glm::dvec3(-2.0, 0.0, -2.0)), glm::dvec3(2.0, 0.0, 2.0));
}

// The largest difference from the shape's own colour, at random points of each triangle that are so far from
// its sides.
template <class Color>
float farthestColor(const FeatureMesh& mesh, const Color& colorAt) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(0.2f, 0.8f);
  float most = 0.0f;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 8; ++i) {
      const float u = share(random), v = share(random) * (1.0f - u);
      const auto mix = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        return (1.0f - u - v) * a + u * b + v * c;
      };
      const glm::uvec3& c = mesh.triangles[t];
      const auto& corners = mesh.colors[t];
      const Paint shown{mix(corners[0].color, corners[1].color, corners[2].color),
                        mix(corners[0].ambient, corners[1].ambient, corners[2].ambient)};
      const glm::vec3 p = mix(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z]);
      const glm::vec3 own = colorAt(p);
      most = std::max(most, colorDifference({own, own}, shown));
    }
  return most;
}

void expectSound(const FeatureMesh& mesh) {
  MeshStats stats;
  measureTopology(mesh.triangles, mesh.positions.size(), stats);
  EXPECT_TRUE(stats.watertight && stats.manifold);
  EXPECT_TRUE(crossingTriangles(mesh.positions, mesh.triangles).empty());
  ASSERT_EQ(mesh.colors.size(), mesh.triangles.size());
}

// Waves of two a side.
Shape wavy(const Shape& shape) {
  const auto wave = [](const auto& x) { return 0.5 + 0.4 * sin(3.0 * x); };
  const Vec3E p = position();
  return shape.paint({.color = {wave(p.x), Expr(0.5), wave(p.y)}});
}

void expectWaves(const FeatureMesh& mesh) {
  const auto colorAt = [](const glm::vec3& at) {
    return glm::vec3(0.5f + 0.4f * std::sin(3.0f * at.x), 0.5f, 0.5f + 0.4f * std::sin(3.0f * at.y));
  };
  // Between samples by some more.
  EXPECT_LE(farthestColor(mesh, colorAt), 1.5f * kColorTolerance);
}

// Without colours a box is twelve triangles.
TEST(SimplifyUnresolved, HoldsColoursOnWhatIsFlat) {
  const LatticeMesh fine(wavy(box(Vec3E(1.0))), 0.05);
  FeatureMesh mesh = fine.mesh;
  Progress progress;
  simplifyUnresolved(mesh, fine.field, 0.01, true, progress);
  expectSound(mesh);
  expectWaves(mesh);
  EXPECT_LE(mesh.triangles.size(), fine.mesh.triangles.size() / 10);
}

TEST(Simplify, HoldsColoursAndTheTolerance) {
  const LatticeMesh fine(wavy(sphere(1.0)), 0.05);
  FeatureMesh mesh = fine.mesh;
  Progress progress;
  const auto nothing = [](const FeatureMesh&) { return std::vector<glm::vec3>(); };
  EXPECT_TRUE(simplify(mesh, fine.field, 4e-3, {}, nothing, true, progress));
  expectSound(mesh);
  expectWaves(mesh);
  MeshStats stats;
  measureDistance(mesh.positions, mesh.triangles, fine.field, progress, stats);
  EXPECT_LE(stats.maxDistance, 1.01 * 4e-3);
  EXPECT_LE(mesh.triangles.size(), fine.mesh.triangles.size() / 6);
}

TEST(SimplifyUnresolved, KeepsColoursOnTheirSideOfABorder) {
  const Vec3E p = position();
  const Expr side = less(p.x, 0.1);
  const Shape shape = sphere(1.0).paint({.color = {select(side, 0.9, 0.1), Expr(0.5), Expr(0.2)}});
  const LatticeMesh fine(shape, 0.08);
  FeatureMesh mesh = fine.mesh;
  Progress progress;
  simplifyUnresolved(mesh, fine.field, 4e-3, true, progress);
  expectSound(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3& v = mesh.triangles[t];
    const float x = (mesh.positions[v.x].x + mesh.positions[v.y].x + mesh.positions[v.z].x) / 3.0f;
    if (std::abs(x - 0.1f) < 0.02f) continue;
    for (const CornerColor& c : mesh.colors[t]) EXPECT_NEAR(c.color.x, x < 0.1f ? 0.9f : 0.1f, 0.02f) << x;
  }
}

// Two balls that nearly touch, in voxels that do not see the gap.
TEST(SimplifyUnresolved, LeavesWhatIsTooFarAndSimplifiesTheRest) {
  const Shape balls = sphere(1.0) | translate(sphere(1.0), {2.02, 0.0, 0.0});
  const LatticeMesh fine(balls, 0.1);
  FeatureMesh mesh = fine.mesh;
  Progress progress;
  simplifyUnresolved(mesh, fine.field, 5e-3, false, progress);
  EXPECT_TRUE(mesh.colors.empty());
  MeshStats before, after;
  measureTopology(fine.mesh.triangles, fine.mesh.positions.size(), before);
  measureTopology(mesh.triangles, mesh.positions.size(), after);
  EXPECT_TRUE(after.watertight && after.manifold);
  EXPECT_EQ(after.components, before.components);
  EXPECT_EQ(after.eulerCharacteristic, before.eulerCharacteristic);
  EXPECT_LE(mesh.triangles.size(), fine.mesh.triangles.size() / 4);
}

}  // namespace tints_test
}  // namespace sdf::test
