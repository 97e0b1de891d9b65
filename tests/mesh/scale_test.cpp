// The same solid at other sizes gives the same mesh.
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <tuple>

#include "mesh/scenes.h"
#include "sdf/eval/promise.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/deform.h"

namespace sdf::test {
namespace scale_test {

struct Solid {
  const char* name;
  std::function<Shape(double)> at;  ///< at a scale
};

Shape scaledPair(double s) {
  return unite(translate(sphere(0.5 * s), {-0.3 * s, 0.0, 0.0}),
               translate(box(Vec3E(0.31 * s)), {0.3 * s, 0.1 * s, 0.0}), Blend::quadratic(0.2 * s));
}

const std::vector<Solid>& solids() {
  static const std::vector<Solid> all{
      {"sphere", [](double s) { return sphere(0.7 * s); }},
      {"box", [](double s) { return box(Vec3E(0.5 * s, 0.313 * s, 0.217 * s)); }},
      {"blended union", scaledPair},
      {"twisted box", [](double s) { return twist(box(Vec3E(0.3 * s, 0.6 * s, 0.2 * s)), 1.3 / s); }}};
  return all;
}

MeshedShape meshedAt(const Solid& solid, double scale, double voxelSize) {
  Progress progress;
  return meshShape(solid.at(scale), solid.name, {.voxelSize = voxelSize}, progress).value();
}

/// All that is reported of a mesh and has no unit.
auto figures(const MeshStats& s) {
  return std::tuple(s.voxels, s.vertices, s.triangles, s.watertight, s.manifold, s.components,
                    s.eulerCharacteristic, s.unresolved, s.notNumbers);
}

// Scaling by a power of two rounds nothing, so that no length but the scene's own may have a part in a mesh.
TEST(Scale, APowerOfTwoChangesNoBit) {
  constexpr double kDefault = 0.0;
  for (const Solid& solid : solids()) {
    const MeshedShape one = meshedAt(solid, 1.0, kDefault);
    for (const double scale : {0x1p-20, 0x1p20}) {
      SCOPED_TRACE(std::string(solid.name) + " times " + std::to_string(scale));
      MeshedShape other = meshedAt(solid, scale, kDefault);
      EXPECT_EQ(figures(other.stats), figures(one.stats));
      // The squares of the least distances are below what floats hold.
      EXPECT_FLOAT_EQ(other.stats.rmsDistance / scale, one.stats.rmsDistance);
      EXPECT_EQ(other.stats.maxDistance, scale * one.stats.maxDistance);
      for (glm::vec3& p : other.mesh.positions) p /= static_cast<float>(scale);
      EXPECT_TRUE(other.mesh.positions == one.mesh.positions);
      EXPECT_TRUE(other.mesh.normals == one.mesh.normals);
      EXPECT_TRUE(other.mesh.triangles == one.mesh.triangles);
    }
  }
}

// Other scales round every number anew, which moves vertices by no more than distances are promised to. The
// voxels fit into no side, so that no sample lies on the surface but for its rounding.
TEST(Scale, AnyOtherRoundsPositionsOnly) {
  constexpr double kVoxel = 0.0231;
  for (const Solid& solid : solids()) {
    const MeshedShape one = meshedAt(solid, 1.0, kVoxel);
    EXPECT_TRUE(one.stats.watertight);
    const double size = solid.at(1.0).bounds.longestSide();
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
      SCOPED_TRACE(std::string(solid.name) + " times " + std::to_string(scale));
      const MeshedShape other = meshedAt(solid, scale, scale * kVoxel);
      EXPECT_NEAR(other.stats.maxDistance / scale, one.stats.maxDistance, distanceRounding({}, size));
      // Where the blend takes the box's edges up they fade out: rounding decides which angle is the last to
      // be one of a crease, at the ends of up to twelve edges.
      if (std::string(solid.name) == "blended union") {
        ASSERT_NEAR(static_cast<double>(other.stats.vertices), static_cast<double>(one.stats.vertices), 24.0);
        continue;
      }
      ASSERT_EQ(figures(other.stats), figures(one.stats));
      // Rounding decides between diagonals of one length, and the vertices' balance depends on them.
      std::set<std::uint32_t> otherwise;
      for (std::size_t t = 0; t < one.mesh.triangles.size(); ++t)
        for (const glm::uvec3& v : {one.mesh.triangles[t], other.mesh.triangles[t]})
          if (one.mesh.triangles[t] != other.mesh.triangles[t]) otherwise.insert({v.x, v.y, v.z});
      EXPECT_LE(otherwise.size(), one.mesh.positions.size() / 100);
      double worst = 0.0;  // in what distances are promised to
      for (std::uint32_t i = 0; i < one.mesh.positions.size(); ++i) {
        if (otherwise.contains(i)) continue;
        const glm::dvec3 p(one.mesh.positions[i]), q = glm::dvec3(other.mesh.positions[i]) / scale;
        worst = std::max(worst, glm::distance(p, q) / distanceRounding(p, size));
      }
      EXPECT_LE(worst, 1.0);
    }
  }
}

// Nothing is known of a field but its formula, so its bounds are looked for.
TEST(Scale, AFieldsBoundsAreFoundAtAnySize) {
  const auto ballAt = [](double s) {
    const Vec3E p = position() * Expr(1.0 / s) - Vec3E(0.0, 3.0, 0.0);
    return field(max(abs(p.x) - 0.5, dot(p, p) - 1.0));
  };
  const Box one = findBounds(ballAt(1.0));
  ASSERT_TRUE(one.finite());
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Box other = findBounds(ballAt(scale));
    EXPECT_EQ(other.min, scale * one.min) << scale;
    EXPECT_EQ(other.max, scale * one.max) << scale;
  }
}

}  // namespace scale_test
}  // namespace sdf::test
