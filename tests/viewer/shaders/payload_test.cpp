// Pictures of shapes whose distance is given by data, in shaders and on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "sdf/expr/gradient.h"
#include "sdf/outline/biarcs.h"
#include "sdf/outline/boundary.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/polygon_field.h"
#include "sdf/shape/solids/solids.h"
#include "sdf/shape/solids/triangle_solid.h"
#include "support/payloads.h"
#include "support/triangle_meshes.h"
#include "viewer/gpu/context.h"
#include "viewer/reference/cpu_render.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/shaders/glsl_probe.h"

namespace sdf::test {
namespace payload_test {

Scene lit(const Shape& shape) {
  Scene scene;
  scene.add("data", shape);
  scene.camera.from = Vec3E(Expr(0.5), Expr(1.5), Expr(4.0));
  scene.lights.push_back({});
  scene.shadow.kind = Shadow::Kind::Hard;
  return scene;
}

// picture_test.cpp says why the bar is that.
void expectTheCpusPicture(const Scene& scene) {
  constexpr double kBar = 40.0;
  GpuRenderOptions options;
  options.epsilon = 1e-5;
  options.threshold = 0.0;
  options.maxSteps = 5000;
  options.filter = false;
  const Picture cpu = renderOnCpu(scene, {});
  EXPECT_GT(std::count(cpu.status.begin(), cpu.status.end(), RayStatus::Hit), 500);
  EXPECT_GE(psnr(encode(cpu.color, scene.gamma), colors(renderOnGpu(scene, options))), kBar);
}

TEST(PayloadPicture, OfAGridIsTheCpus) {
  const auto grid = sampledBall(9);
  expectTheCpusPicture(lit(field(payloadHere(grid), Box::centred(glm::dvec3(1.0)), grid->lipschitz())));
}

TEST(PayloadPicture, OfAUnionIsTheCpus) {
  const auto grid = sampledBall(5);
  const Shape balls = field(payloadHere(fourPoints()), Box::centred(glm::dvec3(1.25)), 1.0);
  const Shape cut = field(payloadHere(grid), Box::centred(glm::dvec3(1.0)), grid->lipschitz());
  expectTheCpusPicture(lit(unite({rotate(cut, {0.3, 0.5, 0.0}), translate(balls, Vec3E(1.2)), sphere(0.4)})));
}

// Within the samples' error: of a torus of 20,000 triangles, so that a voxel sees its facets.
TEST(PayloadPicture, OfAMeshIsTheCpus) {
  const auto field = MeshField::make(bumpyTorus(100));
  ASSERT_TRUE(field.ok());
  expectTheCpusPicture(lit(triangleSolid(*field)));
}

TEST(PayloadPicture, OfAMeshAmongOthersIsTheCpus) {
  const auto field = MeshField::make(bumpyTorus(100));
  const auto box = MeshField::make(boxOf(glm::vec3(-0.5f), glm::vec3(0.5f)), 64);
  ASSERT_TRUE(field.ok() && box.ok());
  expectTheCpusPicture(lit(unite({rotate(subtract(triangleSolid(*field), sphere(0.9)), {0.6, 0.0, 0.0}),
                                  translate(triangleSolid(*box), Vec3E(Expr(0.0), Expr(-1.0), Expr(0.0)))})));
}

// What a shader reads lies within the samples' error of the distance near the surface, and is hardly too
// large elsewhere.
TEST(MeshSamples, AreAsGoodAsTheySay) {
  const auto context = viewer::Context::headless();
  ASSERT_TRUE(context.ok() && (*context)->makeCurrent().ok());
  const auto made = MeshField::make(bumpyTorus(100), 96);
  ASSERT_TRUE(made.ok());
  const MeshField& field = **made;
  const Bricks& bricks = field.bricks();
  EXPECT_LE(bricks.worst, 0.1 * bricks.voxel);
  const Vec3E p = position();
  const Expr f = Expr::payload({*made}, {p.x, p.y, p.z});
  std::mt19937 random(1);
  std::vector<Place> points;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 at = randomIn(random, 2.5);
    points.push_back({glm::vec3(at), glm::vec3(0.0f)});
    const TriangleDistance::Read read = field.distance().read(at);
    points.push_back({glm::vec3(at - (read.distance - 0.5 * bricks.voxel * std::sin(i)) * read.gradient),
                      glm::vec3(0.0f)});
  }
  const auto read = readByShader({&f, 1}, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = field.value(points[i].p), size = std::abs(truth);
    const double side = 4.0 * bricks.voxel,
                 over = 0.375 * side * side / std::max(size - std::sqrt(3.0) * side, side);
    EXPECT_LE(std::abs(read[i][0]), size + std::max(over, 1.5 * bricks.worst) + 1e-5) << i;
    EXPECT_GE(std::abs(read[i][0]), 0.5 * size - 1.5 * bricks.worst - 1e-5) << i;
    if (size < bricks.voxel) {
      EXPECT_NEAR(read[i][0], truth, 1.5 * bricks.worst + 1e-5) << i;
    }
  }
}

/// A point near an edge of a triangle.
glm::dvec3 besideAnEdge(const TriangleMesh& mesh, double off, std::mt19937& random) {
  const glm::uvec3& t = mesh.triangles[random() % mesh.triangles.size()];
  const auto k = static_cast<int>(random() % 3);
  const double along = std::uniform_real_distribution<double>()(random);
  return glm::mix(glm::dvec3(mesh.positions[t[k]]), glm::dvec3(mesh.positions[t[(k + 1) % 3]]), along) +
         randomIn(random, off);
}

TriangleMesh turned(TriangleMesh mesh) {
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(0.3, 1.0, 0.2)));
  for (glm::vec3& p : mesh.positions) p = glm::vec3(turn * glm::dvec3(p));
  return mesh;
}

// Within a voxel of the surface a tenth of one, where distances have kinks, too: at edges of a right angle,
// at a tip, in the middle of a strip that is thinner than a voxel, and along folds of any angle.
TEST(MeshSamples, KeepATenthOfAVoxelBesideSharpEdges) {
  const auto context = viewer::Context::headless();
  ASSERT_TRUE(context.ok() && (*context)->makeCurrent().ok());
  TriangleMesh spike;
  spike.positions = {{0.0f, 3.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, {-0.1f, 0.0f, 0.1f}, {-0.1f, 0.0f, -0.1f}};
  spike.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const TriangleMesh meshes[] = {boxOf({-1.0f, -0.7f, -0.8f}, {1.0f, 0.7f, 0.8f}),
                                 turned(boxOf({-1.0f, -0.7f, -0.8f}, {1.0f, 0.7f, 0.8f})),
                                 turned(boxOf({-1.0f, -0.007f, -0.03f}, {1.0f, 0.007f, 0.03f})),
                                 spike,
                                 turned(spike),
                                 bumpyTorus(9, 0.2)};
  for (std::size_t i = 0; i < std::size(meshes); ++i) {
    const auto made = MeshField::make(meshes[i], 64);
    ASSERT_TRUE(made.ok());
    const double voxel = (*made)->bricks().voxel;
    EXPECT_LE((*made)->bricks().worst, 0.1 * voxel) << i;
    const Vec3E p = position();
    const Expr f = Expr::payload({*made}, {p.x, p.y, p.z});
    std::mt19937 random(2);
    std::vector<Place> points;
    while (points.size() < 30000) {
      const glm::vec3 at(besideAnEdge(meshes[i], 1.5 * voxel, random));
      if (std::abs((*made)->value(at)) <= voxel) points.push_back({at, glm::vec3(0.0f)});
    }
    const auto read = readByShader({&f, 1}, points);
    double worst = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
      worst = std::max(worst, std::abs(read[k][0] - (*made)->value(points[k].p)));
    EXPECT_LE(worst, 0.1 * voxel) << i;
  }
}

// What is rounded or blended reaches out of the mesh's box: there, too, distances are such, not less. Those
// to a box are convex, so that interpolation makes them larger, if anything.
TEST(MeshSamples, AreDistancesAroundTheBox) {
  const auto context = viewer::Context::headless();
  ASSERT_TRUE(context.ok() && (*context)->makeCurrent().ok());
  const auto made = MeshField::make(boxOf({-1.0f, -0.7f, -0.8f}, {1.0f, 0.7f, 0.8f}), 64);
  ASSERT_TRUE(made.ok());
  const double voxel = (*made)->bricks().voxel, side = 4.0 * voxel;
  const Vec3E p = position();
  const Expr f = Expr::payload({*made}, {p.x, p.y, p.z});
  std::mt19937 random(3);
  std::vector<Place> points;
  while (points.size() < 10000) {
    const glm::vec3 at(randomIn(random, 1.5));
    if (glm::any(glm::greaterThan(glm::abs(at), glm::vec3(1.49f, 1.19f, 1.29f)))) continue;
    if ((*made)->value(at) > voxel) points.push_back({at, glm::vec3(0.0f)});
  }
  const auto read = readByShader({&f, 1}, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = (*made)->value(points[i].p);
    EXPECT_GE(read[i][0], truth - 0.01 * voxel) << i;
    EXPECT_LE(read[i][0], truth + 0.375 * side * side / std::max(truth - std::sqrt(3.0) * side, side)) << i;
  }
}

// Where there are edges everywhere not all of them get finer bricks, and that is told.
TEST(MeshSamples, OfTooManyEdgesSayThatTheyAreWorse) {
  TriangleMesh boxes;
  for (int i = 0; i < 512; ++i) {
    const glm::vec3 at(i % 8, i / 8 % 8, i / 64);
    boxes = together(boxes, boxOf(at, at + glm::vec3(0.47f)));
  }
  const auto made = MeshField::make(boxes, 32);
  ASSERT_TRUE(made.ok());
  const Bricks& bricks = (*made)->bricks();
  EXPECT_GT(bricks.worst, 0.1 * bricks.voxel);
  EXPECT_LE(bricks.count,
            2 * static_cast<std::size_t>(bricks.cells.x * bricks.cells.y * bricks.cells.z) + 16384);
}

/// A circle with waves, as a coast has them; some corners are convex, some are not.
std::vector<glm::dvec2> coast(int n) {
  std::vector<glm::dvec2> corners;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n,
                 r = 1.0 + 0.15 * std::sin(9.0 * a) + 0.03 * std::sin(71.0 * a);
    corners.push_back(r * glm::dvec2(std::cos(a), std::sin(a)));
  }
  return corners;
}

TEST(PayloadPicture, OfAPolygonOfManySidesIsTheCpus) {
  expectTheCpusPicture(lit(extrude(polygon(coast(700)), 0.3)));
}

TEST(PayloadPicture, OfPolygonsAmongOthersIsTheCpus) {
  const Shape plate = extrude(polygon(coast(300)), 0.2);
  const Shape hole = extrude(scale(polygon(coast(400)), 0.6), 0.5);
  expectTheCpusPicture(lit(unite({rotate(subtract({plate, hole}), {0.4, 0.3, 0.0}), sphere(0.3)})));
}

/// Waves of both kinds of curves about a hole.
Outline curvedCoast(int n) {
  Contour coast{{1.0, 0.0}}, hole{{0.4, 0.0}};
  for (int i = 0; i < n; ++i) {
    const auto at = [&](double k, double r) {
      const double a = 2.0 * std::numbers::pi * (i + k) / n;
      return r * glm::dvec2(std::cos(a), std::sin(a));
    };
    const glm::dvec2 to = i + 1 == n ? coast.from : at(1.0, 1.0);
    if (i % 3 == 0)
      coast.curves.push_back({0, {}, to});
    else if (i % 3 == 1)
      coast.curves.push_back({1, {at(0.5, 1.3)}, to});
    else
      coast.curves.push_back({2, {at(0.3, 1.2), at(0.7, 0.7)}, to});
    hole.curves.push_back({1, {at(0.5, 0.5)}, i + 1 == n ? hole.from : at(1.0, 0.4)});
  }
  return {{coast, hole}, FillRule::EvenOdd};
}

TEST(PayloadPicture, OfAnOutlineOfCurvesIsTheCpus) {
  expectTheCpusPicture(lit(extrude(outline(curvedCoast(12), {1e-6, 1e-4}), 0.3)));
}

// Near the polygon shaders read the distance but for floats; elsewhere but for what patches are off; and
// beyond the cells it is too small.
TEST(PolygonCellsInShaders, AreAsGoodAsTheySay) {
  const auto context = viewer::Context::headless();
  ASSERT_TRUE(context.ok() && (*context)->makeCurrent().ok());
  const auto curves = boundaryOf(arcContours(curvedCoast(40), 1e-6), FillRule::EvenOdd);
  for (const auto& field :
       {PolygonField::of(coast(50)), PolygonField::of(coast(2000)), PolygonField::of(*curves)}) {
    const Vec3E p = position();
    const Expr f = Expr::payload({field}, {p.x, p.y, p.z});
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-3.0, 3.0), near(-3e-4, 3e-4);
    std::vector<Place> points;
    for (int i = 0; i < 5000; ++i) {
      const PolygonSide& side = field->distance().sides()[random() % field->distance().sides().size()];
      points.push_back({glm::vec3(any(random), any(random), any(random)), glm::vec3(0.0f)});
      points.push_back({0.2f * points.back().p, glm::vec3(0.0f)});
      points.push_back({glm::vec3(side.from + glm::dvec2(near(random), near(random)), 1.0), glm::vec3(0.0f)});
    }
    const auto read = readByShader({&f, 1}, points);
    constexpr double kLongest = 2.4, kFloats = 1e-6;
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 at(points[i].p);
      const double truth = field->value(at), off = read[i][0] - truth;
      EXPECT_LE(off, 2.0 * PolygonCells::kPatchError * kLongest) << i;
      if (glm::any(glm::greaterThan(glm::abs(glm::dvec2(at)), glm::dvec2(2.2)))) continue;
      EXPECT_GE(off, -2.0 * PolygonCells::kPatchError * kLongest) << i;
      if (i % 3 == 2) worst = std::max(worst, std::abs(off));
    }
    EXPECT_LE(worst, kFloats) << field->distance().sides().size();
  }
}

// Patches round the kinks off that the distance has where two sides are as far.
TEST(PolygonCellsInShaders, HaveItsGradients) {
  const auto context = viewer::Context::headless();
  ASSERT_TRUE(context.ok() && (*context)->makeCurrent().ok());
  const auto field = PolygonField::of(coast(1000));
  const Vec3E p = position(), g = gradientOf(Expr::payload({field}, {p.x, p.y, p.z}));
  std::mt19937 random(5);
  std::vector<Place> points;
  for (int i = 0; i < 5000; ++i) points.push_back({glm::vec3(randomIn(random, 1.5)), glm::vec3(0.0f)});
  const auto read = readByShader(std::array{g.x, g.y, g.z}, points);
  int off = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 expected = field->gradient(glm::dvec3(points[i].p)).gradient;
    off += glm::distance(expected, glm::dvec3(read[i][0], read[i][1], read[i][2])) > 0.05;
  }
  EXPECT_LE(off, 300);
}

}  // namespace payload_test
}  // namespace sdf::test
