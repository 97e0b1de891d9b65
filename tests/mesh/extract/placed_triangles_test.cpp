// Meshes from files that are only moved keep their triangles, and extruded polygons their sides.
#include "sdf/mesh/extract/placed_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "outline/curves.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/triangle_solid.h"
#include "support/polygons.h"
#include "support/triangle_meshes.h"

namespace sdf::test {
namespace placed_triangles_test {

Shape meshOf(TriangleMesh mesh) { return triangleSolid(MeshField::make(std::move(mesh), 64).value()); }

const glm::vec3 kHalf(0.5f, 0.25f, 0.75f);
Shape boxOfTriangles() { return meshOf(apart(boxOf(-kHalf, kHalf))); }

Shape placed(const Shape& shape) {
  return translate(rotate(scale(shape, 2.0), Vec3E(0.3, 0.5, 0.1)), Vec3E(1.0, -2.0, 3.0));
}

Result<MeshedShape> meshed(const Shape& shape, MeshOptions options) {
  Progress progress;
  return meshShape(shape, "mesh", options, progress);
}

TEST(PlacedTriangles, AreTheFilesWithItsEdges) {
  const Shape shape = placed(boxOfTriangles());
  const auto mesh = placedTriangles(shape, {}, 1e-3);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh->mesh.positions.size(), 8u);
  EXPECT_EQ(mesh->mesh.creases.size(), 12u) << "not those within its sides";
  const TapePtr distance = Function(shape.distance).at();
  for (const glm::vec3& p : mesh->mesh.positions) EXPECT_NEAR(evaluate(*distance, p), 0.0, 1e-6);
  for (const glm::uvec3& t : mesh->mesh.triangles) {
    const glm::dvec3 a(mesh->mesh.positions[t.x]), b(mesh->mesh.positions[t.y]), c(mesh->mesh.positions[t.z]);
    const glm::dvec3 out = 1e-3 * glm::normalize(glm::cross(b - a, c - a));
    EXPECT_NEAR(evaluate(*distance, (a + b + c) / 3.0 + out), 1e-3, 1e-5) << "they face outwards";
  }
}

TEST(PlacedTriangles, FollowInputs) {
  const Expr turn = Expr::parameter({"turn", 0.0, -1.0, 1.0});
  const Shape shape = translate(rotate(boxOfTriangles(), Vec3E(0.0, turn, 0.0)), Vec3E(turn, 0.0, 0.0));
  const Values values{{"turn", 0.7}};
  const auto mesh = placedTriangles(shape, values, 1e-3);
  ASSERT_TRUE(mesh);
  const TapePtr distance = Function(shape.distance).at(values);
  for (const glm::vec3& p : mesh->mesh.positions) EXPECT_NEAR(evaluate(*distance, p), 0.0, 1e-6);
}

TEST(PlacedTriangles, OfCurvesHaveNoEdges) {
  const auto mesh = placedTriangles(meshOf(bumpyTorus(48)), {}, 1e-3);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->mesh.triangles.size(), 2u * 48 * 48);
  EXPECT_TRUE(mesh->mesh.creases.empty());
}

// The sides of an extruded polygon, and its lids, wherever it is, and of a height by a slider.
TEST(PlacedTriangles, AreThoseOfAPrism) {
  const Expr height = Expr::parameter({"height", 0.5, 0.1, 1.0});
  const Values values{{"height", 0.7}};
  const Shape prism = extrude(polygon(starCorners(100, 0.75)), height);
  for (const Shape& shape : {prism, placed(prism), scale(prism, 3.0), translate(prism, Vec3E(3.0)),
                             extrude(scale(polygon(starCorners(100, 0.75)), 2.0), height)}) {
    const auto mesh = placedTriangles(shape, values, 1e-3);
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->mesh.positions.size(), 400u);
    EXPECT_EQ(mesh->mesh.triangles.size(), 2u * 198 + 2u * 200);
    EXPECT_EQ(mesh->mesh.creases.size(), 3u * 200);
    const TapePtr distance = Function(shape.distance).at(values);
    for (const glm::vec3& p : mesh->mesh.positions) EXPECT_NEAR(evaluate(*distance, p), 0.0, 1e-4);
    EXPECT_TRUE(std::ranges::is_sorted(mesh->mesh.creases));
    const auto result =
        meshed(shape, {.tolerance = 0.01, .strict = false, .keepsFiles = true, .values = values});
    ASSERT_TRUE(result.ok()) << result.error().message;
    const MeshedShape& made = *result;
    EXPECT_TRUE(made.stats.watertight && made.stats.manifold);
    EXPECT_EQ(made.stats.crossings, 0u);
    EXPECT_EQ(made.stats.triangles, 796u);
    EXPECT_LE(made.stats.maxDistance, 1e-4);
  }
  EXPECT_FALSE(placedTriangles(round(prism, 0.1), values, 1e-3));
  EXPECT_FALSE(placedTriangles(revolve(polygon(starCorners(100, 0.75)), 3.0), values, 1e-3));
  EXPECT_FALSE(placedTriangles(subtract({prism, sphere(0.2)}), values, 1e-3));
  EXPECT_FALSE(placedTriangles(twist(prism, 0.5), values, 1e-3));
}

// Two rings, one in the other, and a drop with a corner: chords keep the tolerance, and are few.
TEST(PlacedTriangles, AreThoseOfAnOutlineWithHoles) {
  const auto ring = [](double radius, bool counterClockwise) {
    return roundContour({0.2, -0.1}, radius, counterClockwise);
  };
  const Contour drop{{2.0, 0.0}, {{2, {{2.6, 0.8}, {1.4, 0.8}}, {2.0, 0.0}}}};
  const Outline curves{{ring(1.0, true), ring(0.8, false), ring(0.6, true), ring(0.3, false), drop}};
  const Shape prism = extrude(outline(curves, {1e-6, 1e-4}), 0.25);
  for (const double tolerance : {3e-2, 1e-3, 1e-4})
    for (const Shape& shape : {prism, placed(prism), scale(prism, -0.5),
                               extrude(scale(outline(curves, {1e-6, 1e-4}), 2.0), 0.3)}) {
      const auto made = meshed(shape, {.tolerance = tolerance});
      ASSERT_TRUE(made.ok()) << made.error().message;
      EXPECT_TRUE(made->stats.watertight && made->stats.manifold);
      EXPECT_EQ(made->stats.crossings, 0u);
      EXPECT_LE(made->stats.maxDistance, tolerance);
      EXPECT_GE(made->stats.maxDistance, 0.3 * tolerance);
      // A chord of a circle is the root of eight times the tolerance long, in radii.
      const double chords =
          2.0 * std::numbers::pi * (1.0 + 0.8 + 0.6 + 0.3 + 0.4) / std::sqrt(8.0 * tolerance);
      EXPECT_LE(made->stats.triangles, 4.0 * 3.0 * chords + 100.0);
    }
}

// Only the drop's corner is an edge along the walls.
TEST(PlacedTriangles, OfAnOutlineHaveEdgesAtItsCornersAlone) {
  const Contour drop{{2.0, 0.0}, {{2, {{2.6, 0.8}, {1.4, 0.8}}, {2.0, 0.0}}}};
  const auto made =
      placedTriangles(extrude(outline({{drop, roundContour({}, 1.0)}}, {1e-6, 1e-4}), 0.25), {}, 1e-3);
  ASSERT_TRUE(made);
  int upright = 0;
  for (const auto& [a, b] : made->mesh.creases)
    upright += made->mesh.positions[a].z != made->mesh.positions[b].z;
  EXPECT_EQ(upright, 1);
}

TEST(PlacedTriangles, AreOfNothingElse) {
  const TriangleMesh one = boxOf(-kHalf, kHalf), other = boxOf(glm::vec3(0.0f), glm::vec3(1.0f));
  EXPECT_FALSE(placedTriangles(meshOf(together(one, other)), {}, 1e-3)) << "they cross";
  EXPECT_FALSE(placedTriangles(round(boxOfTriangles(), 0.1), {}, 1e-3));
  EXPECT_FALSE(placedTriangles(subtract({boxOfTriangles(), sphere(0.1)}), {}, 1e-3));
  EXPECT_FALSE(placedTriangles(twist(boxOfTriangles(), 0.5), {}, 1e-3));
  EXPECT_FALSE(placedTriangles(sphere(1.0), {}, 1e-3));
}

// Whatever way the file's triangles run, they have the solid behind them, and none lies in it.
TEST(PlacedTriangles, AreTheSolidsSurface) {
  TriangleMesh inverted = boxOf(-kHalf, kHalf);
  for (glm::uvec3& t : inverted.triangles) std::swap(t.y, t.z);
  const auto turned = placedTriangles(meshOf(inverted), {}, 1e-3),
             right = placedTriangles(boxOfTriangles(), {}, 1e-3);
  ASSERT_TRUE(turned && right);
  EXPECT_EQ(turned->mesh.triangles.size(), 12u);
  const auto volume = [](const FeatureMesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
      sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
  };
  EXPECT_NEAR(volume(turned->mesh), volume(right->mesh), 1e-6);
  EXPECT_GT(volume(turned->mesh), 0.0);
  const auto nested =
      placedTriangles(meshOf(together(boxOf(-kHalf, kHalf), boxOf(-0.5f * kHalf, 0.5f * kHalf))), {}, 1e-3);
  ASSERT_TRUE(nested);
  EXPECT_EQ(nested->mesh.triangles.size(), 12u);
  EXPECT_EQ(nested->mesh.positions.size(), 8u);
}

// Wedges on one edge took minutes as voxels.
TEST(PlacedTriangles, MayShareAnEdge) {
  constexpr std::uint32_t kWedges = 40;
  const auto mesh =
      meshed(meshOf(wedgesOnAnEdge(kWedges)), {.tolerance = 1e-3, .strict = false, .keepsFiles = true});
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->stats.triangles, 8u * kWedges);
  EXPECT_TRUE(mesh->stats.watertight);
  EXPECT_FALSE(mesh->stats.manifold);
  EXPECT_EQ(mesh->stats.crossings, 0u);
  EXPECT_LT(mesh->stats.maxDistance, 1e-6);
}

TEST(PlacedTriangles, LeaveAsTheyCame) {
  const auto box = meshed(placed(boxOfTriangles()), {.tolerance = 1e-3, .strict = false, .keepsFiles = true});
  ASSERT_TRUE(box.ok()) << box.error().message;
  EXPECT_EQ(box->stats.triangles, 12u);
  EXPECT_EQ(box->mesh.positions.size(), 24u) << "each side has normals of its own";
  EXPECT_LT(box->stats.maxDistance, 1e-6);
  EXPECT_GT(box->stats.surfacePoints, 0u);
  EXPECT_TRUE(box->stats.watertight);
  const auto torus = meshed(meshOf(bumpyTorus(48)), {.tolerance = 0.05, .strict = false, .keepsFiles = true});
  ASSERT_TRUE(torus.ok()) << torus.error().message;
  EXPECT_EQ(torus->stats.triangles, 2u * 48 * 48) << "whatever the tolerance";
  EXPECT_EQ(torus->mesh.positions.size(), 48u * 48);
}

// What is off is the rounding of places, which is coarse far from the origin.
TEST(PlacedTriangles, AreMeasuredByTheirRounding) {
  const Shape far = translate(placed(boxOfTriangles()), Vec3E(1e4, 0.0, 0.0));
  const auto box = meshed(far, {.tolerance = 0.05, .strict = false, .keepsFiles = true});
  ASSERT_TRUE(box.ok()) << box.error().message;
  EXPECT_GT(box->stats.maxDistance, 1e-5);
  EXPECT_LT(box->stats.maxDistance, 5e-4) << "half of what floats are apart";
  EXPECT_LE(box->stats.rmsDistance, box->stats.maxDistance);
  const TapePtr distance = Function(far.distance).at();
  double most = 0.0;
  for (const glm::vec3& p : box->mesh.positions) most = std::max(most, std::abs(evaluate(*distance, p)));
  EXPECT_LE(most, box->stats.maxDistance + 1e-6);
  EXPECT_GT(most, 0.1 * box->stats.maxDistance);
}

TEST(PlacedTriangles, AreTakenForAToleranceWhereOthersAreNoFewer) {
  const auto box = meshed(placed(boxOfTriangles()), {.tolerance = 0.02});
  ASSERT_TRUE(box.ok()) << box.error().message;
  EXPECT_EQ(box->stats.triangles, 12u);
  const auto torus = meshed(meshOf(bumpyTorus(24)), {.tolerance = 0.1});
  ASSERT_TRUE(torus.ok()) << torus.error().message;
  EXPECT_LT(torus->stats.triangles, 1000u);
  EXPECT_LE(torus->stats.maxDistance, 0.1);
  EXPECT_GT(torus->stats.maxDistance, 0.005);
}

}  // namespace placed_triangles_test
}  // namespace sdf::test
