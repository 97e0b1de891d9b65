#include "sdf/mesh/creases/borders.h"

#include <gtest/gtest.h>

#include <map>

#include "mesh/feature_meshes.h"
#include "sdf/mesh/measure/topology.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/project.h"
#include "sdf/model/model.h"

namespace sdf::test {
namespace borders_test {

constexpr double kVoxel = 1.0 / 16;

// A ball's mesh at the voxels' resolution, cut at the borders of its paint.
struct Cut {
  explicit Cut(const Shape& shape, const std::vector<std::array<std::uint32_t, 2>>& creases = {}) {
    Progress progress;
    const ModelTapes model = Model(shape).at();
    NarrowBand band = sampleNarrowBand(model, {kVoxel, findBounds(shape), kInfinity}, progress).value();
    const BandField field(band, {model.whole(), model.whole()->firstOutputOnly()});
    RawSurface raw = band.extract();
    std::vector<glm::vec3> normals;
    refineVertices(raw.points, normals, field, progress);
    mesh.positions = std::move(raw.points);
    mesh.triangles = std::move(raw.triangles);
    vertices = mesh.positions.size();
    mesh.creases = creases;
    borders = cutAtBorders(mesh, field, progress);
    measureTopology(mesh.triangles, mesh.positions.size(), stats);
  }
  FeatureMesh mesh;
  std::size_t vertices;  // before
  std::vector<glm::vec3> borders;
  MeshStats stats;
};

Shape ball(const Expr& red) {
  return rotate(sphere(0.5), {0.3, 0.5, 0.7}).paint({.color = Vec3E(red, 0.5, 0.5)});
}

TEST(Borders, OfOneColourThereAreNone) {
  const Cut cut(ball(0.25));
  EXPECT_EQ(cut.mesh.positions.size(), cut.vertices);
  EXPECT_TRUE(cut.mesh.creases.empty());
  EXPECT_EQ(cut.mesh.materials.size(), cut.mesh.triangles.size());
}

TEST(Borders, AreNotCreasesOfOneColour) {
  const glm::uvec3 t = Cut(ball(0.25)).mesh.triangles[0];
  const std::array<std::uint32_t, 2> crease{std::min(t.x, t.y), std::max(t.x, t.y)};
  const Cut cut(ball(0.25), {crease});
  EXPECT_EQ(cut.mesh.creases, std::vector{crease});
  EXPECT_TRUE(cut.borders.empty());
}

TEST(Borders, OfColoursThatChangeSlowlyThereAreNone) {
  const Cut cut(ball(0.5 + position().x));
  EXPECT_EQ(cut.mesh.positions.size(), cut.vertices);
  EXPECT_TRUE(cut.mesh.creases.empty());
}

// The creases are one closed line, along which the border runs to within what halving leaves of an edge,
// which is no longer than the diagonal of a voxel, and no triangle is on both sides.
TEST(Borders, AJumpOfTheColourIsALineOfCreases) {
  const double at = 0.0137, edge = std::sqrt(3.0) * kVoxel, off = edge / 64 + edge * edge / (8.0 * 0.5);
  const Cut cut(ball(select(less(position().x, at), 0.25, 0.75)));
  EXPECT_TRUE(cut.stats.watertight && cut.stats.manifold);
  EXPECT_EQ(cut.stats.eulerCharacteristic, 2);
  std::map<std::uint32_t, int> ends;
  for (const auto& crease : cut.mesh.creases)
    for (const std::uint32_t v : crease) {
      ++ends[v];
      EXPECT_NEAR(cut.mesh.positions[v].x, at, off);
    }
  EXPECT_GT(ends.size(), 40u);
  EXPECT_EQ(cut.borders.size(), ends.size());
  for (const glm::vec3& p : cut.borders) EXPECT_NEAR(p.x, at, off);
  for (const auto& [v, count] : ends) EXPECT_EQ(count, 2) << "vertex " << v;
  for (const glm::uvec3& t : cut.mesh.triangles) {
    double low = 1.0, high = -1.0;
    for (int k = 0; k < 3; ++k) {
      low = std::min(low, cut.mesh.positions[t[k]].x - at);
      high = std::max(high, cut.mesh.positions[t[k]].x - at);
    }
    EXPECT_LT(std::min(-low, high), off);
  }
}

// A border is straight where surface and paint are: to what halving leaves, whichever way it crosses edges.
TEST(Borders, AreStraightOnFlatSides) {
  for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
    const double c = std::cos(angle), s = std::sin(angle), at = 0.0137;
    const Cut cut(
        box({0.5, 0.5, 0.5})
            .paint({.color =
                        Vec3E(select(less(c * position().x + s * position().y, at), 0.25, 0.75), 0.5, 0.5)}));
    int points = 0;
    double farthest = 0.0;
    for (const auto& crease : cut.mesh.creases)
      for (const std::uint32_t v : crease) {
        const glm::dvec3 p(cut.mesh.positions[v]);
        if (std::abs(std::abs(p.z) - 0.5) > 1e-5 || std::max(std::abs(p.x), std::abs(p.y)) > 0.4) continue;
        farthest = std::max(farthest, std::abs(c * p.x + s * p.y - at));
        ++points;
      }
    EXPECT_GT(points, 40) << angle;
    EXPECT_LT(farthest, kVoxel / 64) << angle;
  }
}

// Half a ball and two quarters.
TEST(Borders, OfThreeColoursMeetInTwoPoints) {
  const Vec3E p = position();
  const Expr third = select(less(p.y, 0.021), 0.9, 0.5);
  const Cut cut(ball(select(less(p.x, 0.0137), 0.1, third)));
  EXPECT_TRUE(cut.stats.watertight && cut.stats.manifold);
  EXPECT_EQ(cut.stats.eulerCharacteristic, 2);
  std::map<std::uint32_t, int> ends;
  for (const auto& crease : cut.mesh.creases)
    for (const std::uint32_t v : crease) ++ends[v];
  int points = 0;
  for (const auto& [v, count] : ends) points += count == 3;
  EXPECT_EQ(points, 2);
}

// Between its ends a crease is as near to one of the lines as half of a sixteenth of an edge, which is what
// is cut straight, and the chord of an edge on the ball.
TEST(Borders, OfFourSquaresMeetInTheirCorners) {
  const double edge = std::sqrt(3.0) * kVoxel, off = edge / 32 + edge * edge / (8.0 * 0.5);
  const Vec3E p = position();
  const double x = 0.0137, y = 0.0211;
  const Cut cut(ball(select(less((p.x - x) * (p.y - y), 0.0), 0.1, 0.9)));
  EXPECT_TRUE(cut.stats.watertight && cut.stats.manifold);
  EXPECT_EQ(cut.stats.eulerCharacteristic, 2);
  EXPECT_GT(cut.mesh.creases.size(), 80u);
  for (const auto& [a, b] : cut.mesh.creases) {
    const glm::dvec3 middle = 0.5f * (cut.mesh.positions[a] + cut.mesh.positions[b]);
    EXPECT_LT(std::min(std::abs(middle.x - x), std::abs(middle.y - y)), off);
  }
}

// Squares of 1, of which four of the box's sides lie in borders: there it shows what lies behind.
TEST(Borders, AFaceInABorderIsOfOneColourByWhatLiesBehind) {
  const Vec3E p = position();
  const Expr odd = less(sin(kPi * p.x) * sin(kPi * p.z), 0.0);
  const Shape board = box({2.0, 0.3, 3.0}).paint({.color = Vec3E(select(odd, 0.25, 0.75), 0.5, 0.5)});
  Progress progress;
  const Mesh mesh = meshShape(board, "board", {.tolerance = 2e-3}, progress).value().mesh;
  EXPECT_LE(mesh.triangles.size(), 250u) << "24 squares on either side, 20 beside them";
  for (const glm::uvec3& t : mesh.triangles) {
    glm::vec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    middle = glm::clamp(middle, glm::vec3(-1.99f, -1.0f, -2.99f), glm::vec3(1.99f, 1.0f, 2.99f));
    const float own = std::sin(3.14159265f * middle.x) * std::sin(3.14159265f * middle.z);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mesh.colors[t[k]].x, own < 0.0f ? 0.25f : 0.75f, 1e-5f);
  }
}

// Normals of a vertex and its copies at a border are those of one smooth surface.
TEST(Borders, OnASmoothSurfaceNormalsAreOne) {
  Progress progress;
  const Shape shape = ball(select(less(position().x, 0.0137), 0.25, 0.75));
  const Mesh mesh = meshShape(shape, "ball", {.voxelSize = kVoxel, .tolerance = 2e-3}, progress).value().mesh;
  ASSERT_FALSE(mesh.copyOf.empty());
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i)
    EXPECT_EQ(mesh.normals[mesh.welded + i], mesh.normals[mesh.copyOf[i]]);
}

}  // namespace borders_test
}  // namespace sdf::test
