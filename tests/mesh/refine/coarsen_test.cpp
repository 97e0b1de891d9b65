#include "sdf/mesh/refine/coarsen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "mesh/lattice_mesh.h"
#include "sdf/mesh/edit/crossings.h"
#include "sdf/mesh/measure/to_mesh.h"
#include "sdf/mesh/mesh.h"
#include "sdf/shape/operators/operators.h"

namespace sdf::test {
namespace coarsen_test {

FeatureMesh coarsened(const LatticeMesh& fine, double off, bool painted = false) {
  Progress progress;
  FeatureMesh mesh = fine.mesh;
  coarsen(mesh, fine.field, {off, painted}, progress);
  return mesh;
}

double farthestVertex(const LatticeMesh& fine, const FeatureMesh& mesh) {
  Progress progress;
  return distanceToMesh(fine.mesh.positions, mesh.positions, mesh.triangles, progress, HUGE_VAL).max;
}

using Place = std::array<float, 3>;
std::set<Place> placesOf(const FeatureMesh& mesh) {
  std::set<Place> places;
  for (const glm::vec3& p : mesh.positions) places.insert({p.x, p.y, p.z});
  return places;
}

TEST(Coarsen, LeavesVerticesOfTheLatticeAndStaysNearTheOthers) {
  const std::pair<Shape, int> subjects[] = {
      {sphere(1.0), 2}, {torus(1.0, 0.4), 0}, {twist(box({0.4, 1.0, 0.4}), 1.0), 2}};
  for (const auto& [shape, euler] : subjects) {
    const LatticeMesh fine(shape, 0.02);
    std::size_t fewer = fine.mesh.triangles.size() / 4;
    for (const double off : {1e-3, 4e-3}) {
      const FeatureMesh mesh = coarsened(fine, off);
      expectTopology(mesh, 1, euler);
      EXPECT_LE(mesh.triangles.size(), fewer) << off;
      fewer = mesh.triangles.size() / 2;
      EXPECT_TRUE(std::ranges::includes(placesOf(fine.mesh), placesOf(mesh)));
      EXPECT_LE(farthestVertex(fine, mesh), 2.0 * off);
    }
  }
}

TEST(Coarsen, KeepsCreasesAndWhatIsHeld) {
  const LatticeMesh fine(rotateAbout(box({1.0, 0.7, 0.5}), glm::normalize(glm::dvec3(1, 2, 3)), 0.5), 0.05);
  const FeatureMesh mesh = coarsened(fine, 1e-3);
  expectTopology(mesh, 1, 2);
  EXPECT_LE(mesh.triangles.size(), fine.mesh.triangles.size() / 10);
  double before = 0.0, after = 0.0;
  for (const auto& [a, b] : fine.mesh.creases)
    before += glm::distance(fine.mesh.positions[a], fine.mesh.positions[b]);
  for (const auto& [a, b] : mesh.creases) after += glm::distance(mesh.positions[a], mesh.positions[b]);
  EXPECT_NEAR(after, before, 1e-3 * before);
}

// Circles around a tip are as sharply bent however small they are.
TEST(Coarsen, LeavesTipsAllTheirTrianglesAround) {
  LatticeMesh fine(cone(0.5, 0.8), 0.02);
  const auto top = std::ranges::max_element(fine.mesh.positions, {}, &glm::vec3::y);
  const auto tip = static_cast<std::size_t>(top - fine.mesh.positions.begin());
  fine.mesh.tips.assign(fine.mesh.positions.size(), 0);
  fine.mesh.tips[tip] = 1;
  const auto around = [&](const FeatureMesh& mesh) {
    return std::ranges::count_if(mesh.triangles, [&](const glm::uvec3& t) {
      return std::ranges::any_of(std::array{t.x, t.y, t.z},
                                 [&](auto v) { return mesh.positions[v] == fine.mesh.positions[tip]; });
    });
  };
  EXPECT_EQ(around(coarsened(fine, 0.01)), around(fine.mesh));
}

// Walls that are thinner than triangles may be off stay as fine as they are.
TEST(Coarsen, KeepsSheetsApart) {
  for (const double wall : {0.03, 0.06}) {
    const LatticeMesh fine(shell(sphere(1.0), wall), 0.02);
    const FeatureMesh mesh = coarsened(fine, 0.02);
    expectTopology(mesh, 2, 4);
    EXPECT_EQ(mesh.triangles.size(), fine.mesh.triangles.size()) << wall;
  }
}

// As a lattice has them at the ground of a crevice that it does not resolve.
// Crevices between balls end in wedges as slim as any.
TEST(Coarsen, LetsNoSheetsCross) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    std::vector<Shape> balls;
    for (int k = 0; k < 30; ++k) {
      const Vec3E at(place(random), place(random), place(random));
      balls.push_back(translate(sphere(0.25), at));
    }
    const LatticeMesh fine(unite(balls), 0.03);
    const auto crossings = [](const FeatureMesh& mesh) {
      return crossingTriangles(mesh.positions, mesh.triangles).size();
    };
    if (crossings(fine.mesh) > 0) continue;
    EXPECT_EQ(crossings(coarsened(fine, 2e-3)), 0u) << i;
  }
}

TEST(Coarsen, KeepsWhatIsOffTheSurfaceAndAllAround) {
  LatticeMesh fine(box({1.0, 1.0, 1.0}), 0.05);
  const auto distanceTo = [](const glm::vec3& p) { return glm::distance(p, glm::vec3(0.0f, 1.0f, 0.0f)); };
  const auto around = [&](const FeatureMesh& mesh) {
    return std::ranges::count_if(mesh.positions, [&](const glm::vec3& p) { return distanceTo(p) < 0.08f; });
  };
  EXPECT_EQ(around(coarsened(fine, 2e-3)), 0);
  glm::vec3& off = *std::ranges::min_element(fine.mesh.positions, {}, distanceTo);
  off.y -= 0.003f;
  EXPECT_EQ(around(coarsened(fine, 2e-3)), around(fine.mesh));
}

TEST(Coarsen, HoldsColoursAtTheVerticesThatGo) {
  const auto count = [](double waves) {
    const Shape ball =
        sphere(1.0).paint({.color = {0.5 + 0.4 * sin(waves * position().x), Expr(0.5), Expr(0.5)}});
    const LatticeMesh fine(ball, 0.03);
    EXPECT_EQ(coarsened(fine, 0.01).triangles.size(),
              coarsened(LatticeMesh(sphere(1.0), 0.03), 0.01).triangles.size());
    return coarsened(fine, 0.01, true).triangles.size();
  };
  const std::size_t slow = count(1.0), fast = count(12.0);
  EXPECT_LT(2 * slow, fast);
}

}  // namespace coarsen_test
}  // namespace sdf::test
