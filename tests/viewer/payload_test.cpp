// Pictures of shapes whose distance is given by data, in shaders and on the CPU.
#include <gtest/gtest.h>

#include <algorithm>

#include "sdf/shape/booleans.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"
#include "sdf/shape/triangle_solid.h"
#include "support/payloads.h"
#include "support/triangle_meshes.h"
#include "viewer/cpu_render.h"
#include "viewer/glsl_probe.h"
#include "viewer/gpu/context.h"
#include "viewer/gpu_render.h"
#include "viewer/psnr.h"

namespace sdf::test {
namespace {

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

}  // namespace
}  // namespace sdf::test
