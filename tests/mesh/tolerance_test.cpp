#include "sdf/mesh/mesher.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "mesh/scenes.h"
#include "sdf/mesh/surface/surface_paint.h"
#include "sdf/shape/catalog.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/solids/flats.h"
#include "support/evaluate.h"

namespace sdf::test {
namespace tolerance_test {

// Triangles of the lattice are smaller than what is a needle beside such tolerances.
TEST(MeshTolerance, TolerancesOfManyVoxelsLeaveFewTriangles) {
  for (const double tolerance : {0.1, 0.3, 2.0})
    EXPECT_LE(meshed(sphere(1.0), 0.04, tolerance).mesh.triangles.size(), 60u) << tolerance;
}

// A ball that waves rise from: where one ends an edge fades out.
TEST(MeshTolerance, EdgesThatFadeOutAreNotSplitIntoNeedles) {
  const Vec3E p = position();
  const Expr waves = sin(4.0 * p.x + 1.0) * sin(4.0 * p.y) * sin(4.0 * p.z + 2.0) +
                     0.5 * sin(9.0 * p.y + p.x) * sin(8.0 * p.z);
  const Shape planet = sphere(1.0) | displace(sphere(1.0), waves * -0.12);
  for (const double tolerance : {2e-3, 4e-3, 8e-3}) {
    const MeshedShape m = meshed(planet, 0.03, tolerance);
    // Three times what a ball needs for each octave.
    EXPECT_LE(static_cast<double>(m.mesh.triangles.size()), 12.0 / tolerance) << tolerance;
  }
}

// A rim about as thin as the tolerance, and letters through the wall that stand out by less.
TEST(MeshTolerance, StepsAndRimsBelowTheToleranceDoNotCross) {
  const Shape cup = subtract(
      {round(cylinder(0.72, 0.8), 0.06), translate(round(cylinder(0.7, 0.8), 0.04), {0.0, 0.12, 0.0})},
      Blend::quadratic(0.05));
  const Shape letter = box({0.3, 0.03, 1.0}) | rotate(box({0.03, 0.3, 1.0}), {0.0, 0.0, 0.2});
  const Shape standing = subtract({letter & cylinder(0.815, 0.5), cylinder(0.74, 2.0)});
  for (const double tolerance : {4e-3})
    EXPECT_LE(meshed(cup | standing, 0.0125, tolerance).mesh.triangles.size(), 4000u) << tolerance;
}

// Two of a board's sides need a thousand triangles for a pattern, and none for their shape.
TEST(MeshTolerance, HoldsForTheColoursOfWhatIsFlat) {
  const Vec3E p = position();
  const Shape board =
      round(box({2.0, 0.05, 1.5}), 0.05)
          .paint({.color = {0.5 + 0.3 * sin(9.0 * p.z + 0.6 * sin(2.0 * p.x)), Expr(0.4), Expr(0.2)}});
  const MeshedShape m = meshed(board, 0.0, 2.5e-3);
  EXPECT_LE(m.mesh.triangles.size(), 3000u);
  for (const glm::uvec3& t : m.mesh.triangles) {
    const auto mean = [&](const std::vector<glm::vec3>& of) { return (of[t.x] + of[t.y] + of[t.z]) / 3.0f; };
    const glm::vec3 middle = mean(m.mesh.positions), shown = mean(m.mesh.colors);
    const float own = 0.5f + 0.3f * std::sin(9.0f * middle.z + 0.6f * std::sin(2.0f * middle.x));
    // Between samples by some more.
    ASSERT_LE(std::abs(perceived(shown.x) - perceived(own)), 1.5f * kColorTolerance);
  }
}

// Where a crescent's horns run out to nothing no tolerance can be kept. Elsewhere it is.
TEST(MeshTolerance, WhatCannotBeKeptIsLeftAsItIsWhereThatIsAllowed) {
  const Shape crescent = subtract({sphere(0.5), translate(sphere(0.5), {0.05, 0.0, 0.0})});
  constexpr double kVoxel = 0.02, kTolerance = 1e-3;
  const auto meshed = [&](bool strict) {
    Progress progress;
    return meshShape(crescent, "part", {.voxelSize = kVoxel, .tolerance = kTolerance, .strict = strict},
                     progress);
  };
  const Result<MeshedShape> refused = meshed(true), best = meshed(false);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::Limits);
  ASSERT_TRUE(best.ok()) << best.error().message;
  EXPECT_TRUE(best->stats.watertight && best->stats.manifold);
  EXPECT_EQ(best->stats.crossings, 0u);
  EXPECT_GT(best->stats.maxDistance, kTolerance);
  // The horn's faces meet at 2 asin(0.05), so that it is a voxel thick ten voxels before its end.
  EXPECT_LE(best->stats.maxDistance, best->stats.voxelSize / (2.0 * std::asin(0.05)));
  const Evaluator field(crescent.distance);
  const double horns = std::sqrt(0.25 - 0.025 * 0.025);
  for (const glm::vec3& p : best->mesh.positions) {
    const double along = std::hypot(p.x - 0.025, std::hypot(p.y, p.z) - horns);
    if (along > 8.0 * kVoxel) {
      EXPECT_LE(std::abs(field(glm::dvec3(p))), 1.01 * kTolerance);
    }
  }
  Progress progress;
  const Result<MeshedShape> uniform =
      meshShape(crescent, "part", {.voxelSize = best->stats.voxelSize}, progress);
  ASSERT_TRUE(uniform.ok());
  EXPECT_LT(2 * best->mesh.triangles.size(), uniform->mesh.triangles.size());
}

// Blends a few tolerances wide, whose bends are about as sharp as that: what simplifying to the tolerance
// misses there by little is held to less of it.
TEST(MeshTolerance, KeepsAToleranceAtBendsAsSharpAsIt) {
  const auto blended = [](double k, double away) {
    return unite(
        {sphere(1.0), translate(sphere(0.3), {away, 0.0, 0.0}), translate(sphere(0.4), {0.0, 1.2, 0.2})},
        Blend::quadratic(k));
  };
  for (const auto& [k, away] : {std::pair(0.05, 1.1), {0.1, 1.1}, {0.1, 1.25}})
    EXPECT_LE(meshed(blended(k, away), 0.05, 0.01).mesh.triangles.size(), 1200u) << k << " " << away;
}

TEST(MeshTolerance, MeshesThatAreTornOpenAreRefused) {
  const Shape ball = field((length(position()) - 1.0) * 2.0, Box{glm::dvec3(-1.0), glm::dvec3(1.0)}, 1.0);
  Progress progress;
  const Result<MeshedShape> mesh = meshShape(ball, "part", {.tolerance = 1e-3}, progress);
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().message.find("torn open"), std::string::npos) << mesh.error().message;
}

// The share of a mesh's area whose interpolated normals are more than 15 degrees from the gradient under it.
double wrongShare(const Mesh& mesh, const Shape& shape) {
  const Evaluator field(shape.distance);
  double wrong = 0.0, all = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    constexpr int kParts = 4;
    const double area = glm::length(glm::cross(b - a, c - a)) / 2.0 / (kParts * kParts);
    for (int i = 0; i < kParts; ++i)
      for (int k = 0; i + k < kParts; ++k) {
        const double v = (i + 1.0 / 3.0) / kParts, w = (k + 1.0 / 3.0) / kParts, u = 1.0 - v - w;
        const glm::dvec3 p = u * a + v * b + w * c;
        const glm::dvec3 n =
            glm::normalize(u * glm::dvec3(mesh.normals[t.x]) + v * glm::dvec3(mesh.normals[t.y]) +
                           w * glm::dvec3(mesh.normals[t.z]));
        all += area;
        if (glm::dot(n, glm::normalize(field.gradient(p, 1e-5))) < std::cos(15.0 * kPi / 180.0))
          wrong += area;
      }
  }
  return wrong / all;
}

// Long triangles run down from the rim, whose rounding is as high as two edges: they are not to be tilted
// with it. A fifteenth of the area is the roundings'.
TEST(MeshTolerance, NormalsOfLargeTrianglesAreRightAllOverThem) {
  const Shape drum = round(cylinder(0.95, 0.65), 0.05);
  EXPECT_LT(wrongShare(meshed(drum, 0.02, 3e-3).mesh, drum), 0.04);
}

// Three edges meet in each inner corner of the letter, where sharpening leaves a gap of a voxel.
TEST(MeshTolerance, GapsInEdgesDoNotGrow) {
  const Shape t =
      translate(box({0.06, 0.3, 0.5}), {0.3, 0.0, 0.9}) | translate(box({0.25, 0.06, 0.5}), {0.3, 0.24, 0.9});
  const Shape letter = t & subtract(cylinder(1.09, 0.6), cylinder(0.98, 0.8));
  const MeshedShape m = meshed(letter, 0.0107, 3e-3);
  EXPECT_LT(wrongShare(m.mesh, letter), 0.02);
  EXPECT_LE(m.mesh.triangles.size(), 80u);
}

// Where a displaced rim bulges it is rounded, as small as the tolerance: the edge that is left there has two
// sides, which creases do not tell of. A ball has none, however coarse.
TEST(MeshTolerance, SmallRoundingsAreShadedAsEdges) {
  const Shape board = displace(box({1.1, 0.7, 0.12}), -0.05 * sin(4.0 * position().x));
  EXPECT_LT(wrongShare(meshed(board, 0.011, 3e-3).mesh, board), 0.03);
  EXPECT_TRUE(meshed(sphere(1.0), 0.04, 0.1).mesh.copyOf.empty());
}

// Near a rim that is thinner than the tolerance a point of the mesh is nearer to the other side.
TEST(MeshTolerance, RimsThinnerThanTheToleranceAreShadedBySides) {
  const glm::dvec3 off(0.25, 0.1, 0.0);
  const Mesh mesh = meshed(subtract(sphere(0.6), translate(sphere(0.6), Vec3E(off))), 0.006, 3.3e-3).mesh;
  double wrong = 0.0, all = 0.0;  // areas, by corners
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::dvec3 area = glm::cross(b - a, c - a), facet = glm::normalize(area);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = mesh.positions[t[k]], out = glm::normalize(p), in = glm::normalize(off - p);
      const glm::dvec3& side = glm::dot(facet, out) > glm::dot(facet, in) ? out : in;
      all += glm::length(area);
      if (glm::dot(glm::dvec3(mesh.normals[t[k]]), side) < std::cos(20.0 * kPi / 180.0))
        wrong += glm::length(area);
    }
  }
  EXPECT_LE(wrong, 1e-3 * all);  // where the rim has a gap
}

// Each triangle at a tip has the normal of its own side there. The lemon is curved along its sides, too.
TEST(MeshTolerance, TipsStayAndAreShadedAllAround) {
  for (const double turn : {0.0, 0.7}) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.3, 0.5));
    for (const auto& [shape, tip] : {std::pair{cone(0.5, 0.8), 0.8}, std::pair{cone(0.5, 0.4), 0.4},
                                     std::pair{revolve(translate(circle(1.0), {-0.6, 0.0, 0.0})), 0.8}}) {
      const Shape turned = rotateAbout(shape, axis, turn);
      const MeshedShape m = meshed(turned, 0.01, 1.2e-3);
      EXPECT_LT(wrongShare(m.mesh, turned), 0.02);
      EXPECT_LE(m.mesh.triangles.size(), 1300u);
      EXPECT_LE(nearestVertex(m.mesh.positions, glm::angleAxis(turn, axis) * glm::dvec3(0.0, tip, 0.0)),
                1e-5);
    }
  }
}

}  // namespace tolerance_test
}  // namespace sdf::test
