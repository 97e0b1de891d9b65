// Meshes of what lies far from the origin, where floats are some hundredths of a unit apart.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/scenes.h"

namespace sdf::test {
namespace far_test {

// The largest distance of points of the mesh to the unit ball's surface.
double fromBall(const Mesh& mesh, const glm::dvec3& centre) {
  constexpr int kAlong = 8;
  double most = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i <= kAlong; ++i)
      for (int k = 0; i + k <= kAlong; ++k) {
        const double u = double(i) / kAlong, v = double(k) / kAlong;
        const glm::dvec3 p = (1.0 - u - v) * glm::dvec3(mesh.positions[t.x]) +
                             u * glm::dvec3(mesh.positions[t.y]) + v * glm::dvec3(mesh.positions[t.z]);
        most = std::max(most, std::abs(glm::distance(p, centre) - 1.0));
      }
  return most;
}

// What is measured is what is so, and no more than what is proven.
TEST(Far, WhatIsMeasuredIsTrue) {
  const struct {
    glm::dvec3 centre;
    double voxel;
  } cases[] = {{{1e6, 1.0, 2.0}, 0.5}, {{3e5, -1.0, 2.0}, 0.15}, {{0.1, 5e5 + 0.1, 7.0}, 0.25}};
  for (const auto& [centre, voxel] : cases)
    for (const double tolerance : {0.0, 0.2}) {
      Progress progress;
      const auto meshed =
          meshShape(translate(sphere(1.0), Vec3E(centre)), "ball",
                    {.voxelSize = voxel, .tolerance = tolerance, .strict = false, .certify = true}, progress);
      ASSERT_TRUE(meshed.ok()) << meshed.error().message;
      const MeshStats& stats = meshed->stats;
      const double truth = fromBall(meshed->mesh, centre);
      EXPECT_LE(stats.maxDistance, stats.provenDistance) << centre.x;
      // Between samples it may be larger; points of the surface are as far from triangles as these from it.
      EXPECT_GE(stats.maxDistance, 0.8 * truth) << centre.x;
      EXPECT_LE(stats.maxDistance, 1.1 * truth) << centre.x;
      EXPECT_NEAR(stats.farthest.x, centre.x, 1.2) << "places are those of the scene";
    }
}

// A part is as good at any place but for the rounding of its vertices, colours and clipping box included.
TEST(Far, MeshesAreThoseAtTheOriginButForRounding) {
  const Vec3E p = position();
  const Shape near = subtract({box({1.0, 0.5, 1.0}), translate(sphere(0.7), {0.0, 0.6, 0.0})})
                         .paint({.color = {0.5 + 0.4 * sin(3.0 * p.x), Expr(0.5), Expr(0.25)}});
  const glm::dvec3 far(65536.0, 2048.0, -32768.0);
  const auto meshAt = [&](const glm::dvec3& at) {
    Progress progress;
    const Box clip{at - glm::dvec3(0.75, 2.0, 2.0), at + glm::dvec3(0.75, 2.0, 2.0)};
    auto meshed =
        meshShape(translate(near, Vec3E(at)), "thing", {.voxelSize = 0.0625, .bounds = clip}, progress);
    EXPECT_TRUE(meshed.ok()) << meshed.error().message;
    return std::move(*meshed);
  };
  const MeshedShape here = meshAt(glm::dvec3(0.0)), there = meshAt(far);
  ASSERT_EQ(here.mesh.triangles.size(), there.mesh.triangles.size());
  const double apart = 0x1p-7;  // of floats at 65536
  for (std::size_t v = 0; v < here.mesh.positions.size(); ++v) {
    const glm::dvec3 d =
        glm::abs(glm::dvec3(there.mesh.positions[v]) - far - glm::dvec3(here.mesh.positions[v]));
    EXPECT_LE(std::max({d.x, d.y, d.z}), 0.51 * apart);
    EXPECT_NEAR(there.mesh.colors[v].x, here.mesh.colors[v].x, 0.02);
  }
  EXPECT_LE(there.stats.maxDistance, here.stats.maxDistance + 0.5 * std::sqrt(3.0) * apart);
}

}  // namespace far_test
}  // namespace sdf::test
