// Wherever rays start, they meet the same.
#include <gtest/gtest.h>

#include <filesystem>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "support/samples.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/scene_file.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace start_test {

using viewer::Start;
using viewer::View;

// Scenes of many parts have so many edges that hits beside the surface would decide too many pixels.
std::vector<glm::dvec3> drawn(const Scene& scene, Start start, View view = View::Normals,
                              const Values& parameters = {}) {
  GpuRenderOptions options;
  options.width = 320;
  options.height = 180;
  options.shader.view = view;
  options.shader.start = start;
  if (viewer::planOf(scene, options.shader)->cells) options.threshold = 0.0;
  options.parameters = parameters;
  return colors(renderOnGpu(scene, options));
}

// Where a ray that starts elsewhere hits is another place by a share of a pixel's cone at most: at an edge,
// and where a pattern changes, that now and then decides a pixel.
void expectTheSame(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  EXPECT_LE(shareApart(a, b, 0.03), 2e-4);
  std::vector<glm::dvec3> rest = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (shareApart({a[i]}, {b[i]}, 0.03) > 0.0) rest[i] = b[i];
  EXPECT_GE(psnr(rest, b), 70.0);
}

class Starts : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Starts, ShowOneSample) {
  const auto scene = viewer::SceneFile(GetParam()).load({});
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const auto byCones = drawn(*scene, Start::Cone), byHull = drawn(*scene, Start::Raster);
  if (viewer::planOf(*scene, {.view = View::Normals})
          ->grouped) {  // one start for each group; see groups_test
    EXPECT_EQ(byCones, byHull);
    return;
  }
  const auto plain = drawn(*scene, Start::Plain);
  expectTheSame(plain, byHull);
  expectTheSame(plain, byCones);
}

INSTANTIATE_TEST_SUITE_P(Viewer, Starts, testing::ValuesIn(samples()), stemOf);

GpuRenderOptions byHull() {
  GpuRenderOptions options;
  options.shader.start = Start::Raster;
  return options;
}

Scene hollowBall() {
  Scene scene = darkScene();
  scene.add("", subtract(sphere(1.0), sphere(0.8)) | translate(sphere(0.2), Vec3E(0.1, 0.2, 0.0)));
  return scene;
}

// Within the hull, between its walls, in the solid, and with all of it behind.
TEST(HullStarts, SeeTheSameFromWithin) {
  for (const double z : {1.02, 0.75, 0.0, 0.9, -3.0}) {
    Scene scene = hollowBall();
    scene.camera.from = Vec3E(0.05, 0.02, z);
    scene.camera.to = Vec3E(0.05, 0.1, z - 1.0);
    SCOPED_TRACE(z);
    expectTheSame(drawn(scene, Start::Plain), drawn(scene, Start::Raster));
  }
}

TEST(HullStarts, FollowParameters) {
  Scene scene = darkScene();
  const Expr x = Expr::parameter({"x", 0.0, -2.0, 2.0});
  scene.add("", translate(sphere(0.5), Vec3E(x, 0.0, 0.0)));
  const auto still = drawn(scene, Start::Raster),
             moved = drawn(scene, Start::Raster, View::Normals, {{"x", 1.0}});
  EXPECT_GT(shareApart(still, moved, 0.1), 0.02);
  expectTheSame(moved, drawn(scene, Start::Plain, View::Normals, {{"x", 1.0}}));
}

TEST(HullStarts, ArePlannedWhereBoundsAreFinite) {
  Scene scene = hollowBall();
  EXPECT_TRUE(viewer::planOf(scene, byHull().shader)->hull);
  scene.add("", plane(Vec3E(0.0, 1.0, 0.0), -1.0));
  EXPECT_TRUE(viewer::planOf(scene, byHull().shader)->hull) << "planes are met by division";
  Scene endless = darkScene();
  endless.add("", unite({plane(Vec3E(0.0, 1.0, 0.0), -1.0), sphere(1.0)}, Blend::quadratic(0.5)));
  EXPECT_FALSE(viewer::planOf(endless, byHull().shader)->hull);
  expectTheSame(drawn(endless, Start::Plain), drawn(endless, Start::Raster));
}

}  // namespace start_test
}  // namespace sdf::test
