// Pictures of shapes whose distance is given by data, in shaders and on the CPU.
#include <gtest/gtest.h>

#include <algorithm>

#include "sdf/shape/booleans.h"
#include "sdf/shape/place.h"
#include "sdf/shape/solids.h"
#include "support/payloads.h"
#include "viewer/cpu_render.h"
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

}  // namespace
}  // namespace sdf::test
