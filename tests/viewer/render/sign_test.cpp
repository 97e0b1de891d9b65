// The sample of letters, a drawing and strokes.
#include <gtest/gtest.h>

#include "sdf/script/script.h"
#include "viewer/reference/cpu_render.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/renderers.h"

namespace sdf::test {
namespace sign_test {

// Outlines are read from textures of cells, with arcs of a larger tolerance than the CPU's; a picture shows
// as little of that as of rounding (PictureOf.IsTheCpusWhereBothHitAtTheSameDistance).
TEST(Sign, IsDrawnAsTheCpuDrawsIt) {
  const auto scene = loadScene(SDF_SOURCE_DIR "/samples/drawings/sign.lua");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_TRUE(scene->notes.empty());
  EXPECT_EQ(scene->files.size(), 1u) << "the drawing";
  CpuRenderOptions onCpu;
  GpuRenderOptions onGpu;
  onGpu.width = onCpu.width = 160;
  onGpu.height = onCpu.height = 90;
  onGpu.filter = false;
  onGpu.epsilon = 1e-5;
  onGpu.threshold = 0.0;
  onGpu.maxSteps = 5000;
  const std::vector<glm::dvec3> truth = encode(renderOnCpu(*scene, onCpu).color, scene->gamma);
  EXPECT_GE(psnr(truth, colors(renderOnGpu(*scene, onGpu))), 40.0);
}

}  // namespace sign_test
}  // namespace sdf::test
