#include "sdf/mesh/refine/balance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "mesh/scenes.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/measure/distance.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/project.h"

namespace sdf::test {
namespace balance_test {

struct Balanced {
  FeatureMesh before, after;
  std::vector<glm::vec3> normals;
  MeshStats onSurface, balanced;
};

Balanced balanced(const Shape& shape, double voxel) {
  Progress progress;
  NarrowBand band = bandOf(shape, findBounds(shape), voxel);
  const BandField field(band, wholeTapes(tapeOf(shape)));
  RawSurface raw = band.extract();
  const std::vector<glm::vec3> extracted = raw.points;
  Balanced b;
  refineVertices(raw.points, b.normals, field, progress);
  b.before =
      sharpen(std::move(raw.points), b.normals, std::move(raw.triangles), extracted, field, progress).mesh;
  b.after = b.before;
  balanceVertices(b.after, b.normals);
  measureDistance(b.before.positions, b.before.triangles, field, progress, b.onSurface);
  measureDistance(b.after.positions, b.after.triangles, field, progress, b.balanced);
  return b;
}

// Mean of the signed distances of a mesh's triangles to a sphere, weighted by their areas: the mean over a
// triangle of a function of second order is that at the middles of its sides.
double meanDistance(const FeatureMesh& mesh, double radius) {
  double sum = 0.0, areas = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const double area = glm::length(glm::cross(b - a, c - a));
    for (const glm::dvec3& p : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
      sum += area * (glm::length(p) - radius) / 3.0;
    areas += area;
  }
  return sum / areas;
}

TEST(Balance, LeavesHalfOfTheErrorOfWhatIsSmoothAtMost) {
  for (const Shape& shape : {sphere(1.0), torus(1.0, 0.4), melt()}) {
    const Balanced b = balanced(shape, 1.0 / 40);
    // A quarter of regular triangles on a sphere; those of a lattice differ in size, and saddles err to both
    // sides as they are. Nothing derives how much that leaves: 0.47 was measured of the sphere, 0.37 and less
    // of the others.
    EXPECT_LE(b.balanced.rmsDistance, 0.5 * b.onSurface.rmsDistance);
    EXPECT_LT(b.balanced.maxDistance, b.onSurface.maxDistance);
  }
}

TEST(Balance, LeavesNoErrorInTheMean) {
  const Balanced b = balanced(sphere(1.0), 1.0 / 40);
  const double mean = meanDistance(b.before, 1.0);
  EXPECT_LT(mean, 0.0);
  EXPECT_LE(std::abs(meanDistance(b.after, 1.0)), 0.01 * std::abs(mean));
}

TEST(Balance, LeavesFlatFacesAndTheirEdgesWhereTheyAre) {
  // Of coordinates up to 2: moves are what roundings of positions amount to.
  constexpr double kRounding = 16.0 * 2.0 * kRoundoff;
  const Balanced b = balanced(rotate(box({1.0, 0.6, 0.8}), {0.3, 0.5, 0.7}), 1.0 / 20);
  for (std::size_t i = 0; i < b.before.positions.size(); ++i)
    ASSERT_LE(glm::distance(b.before.positions[i], b.after.positions[i]), kRounding);
}

// A chord of length l is off by l^2 / (8 r) at most and by two thirds of it in the mean.
TEST(Balance, MovesCurvedCreasesAlongTheirFaces) {
  const double h = 1.0 / 32;
  const Balanced b = balanced(cylinder(0.8, 0.5), h);
  ASSERT_FALSE(b.after.creases.empty());
  double before = 0.0, after = 0.0;
  for (const auto& crease : b.after.creases) {
    const auto off = [&](const FeatureMesh& mesh) {
      const glm::dvec3 from(mesh.positions[crease[0]]), to(mesh.positions[crease[1]]);
      double most = 0.0;
      for (const glm::dvec3& p : {0.5 * (from + to), from}) {
        EXPECT_NEAR(std::abs(p.y), 0.5, 1e-6);
        most = std::max(most, std::abs(std::hypot(p.x, p.z) - 0.8));
      }
      return most;
    };
    before = std::max(before, off(b.before)), after = std::max(after, off(b.after));
  }
  EXPECT_LE(after, 0.8 * before);
}

TEST(Balance, TurnsNoTriangle) {
  for (const Shape& shape : {boredBox(), melt(), strewn(60, 0.2)})
    for (const double voxel : {1.0 / 16, 1.0 / 32}) {
      const Balanced b = balanced(shape, voxel);
      for (std::size_t i = 0; i < b.before.triangles.size(); ++i) {
        const auto normal = [&](const FeatureMesh& mesh) {
          const glm::uvec3& t = mesh.triangles[i];
          const glm::dvec3 p(mesh.positions[t.x]);
          return glm::cross(glm::dvec3(mesh.positions[t.y]) - p, glm::dvec3(mesh.positions[t.z]) - p);
        };
        const glm::dvec3 u = normal(b.before), v = normal(b.after);
        // Of a slope, but for what floats make of needles' areas.
        ASSERT_GE(glm::dot(u, v),
                  std::cos(std::atan(std::sqrt(0.125))) * glm::length(u) * glm::length(v) - 1e-12)
            << i;
      }
      EXPECT_LT(b.balanced.rmsDistance, b.onSurface.rmsDistance);
    }
}

TEST(Balance, DoesNotDependOnTheNumberOfThreads) {
  const Balanced b = balanced(boredBox(), 1.0 / 64);
  const auto run = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    FeatureMesh mesh = b.before;
    balanceVertices(mesh, b.normals);
    return mesh.positions;
  };
  EXPECT_EQ(run(1), run(4));
}

// Normals that turn by 90 degrees along an edge may as well be those of a crease that was not found.
TEST(Balance, DoesNotMoveWhatNormalsSayNothingOf) {
  FeatureMesh mesh;
  for (int i = 0; i < 6; ++i) {
    mesh.positions.emplace_back(0.0f);
    mesh.positions.back()[i % 3] = i < 3 ? 1.0f : -1.0f;
  }
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}, {0, 2, 4}, {3, 4, 2}, {0, 5, 1}, {3, 1, 5}, {0, 4, 5}, {3, 5, 4}};
  const std::vector<glm::vec3> corners = mesh.positions;
  balanceVertices(mesh, corners);
  EXPECT_EQ(mesh.positions, corners);
}

}  // namespace balance_test
}  // namespace sdf::test
