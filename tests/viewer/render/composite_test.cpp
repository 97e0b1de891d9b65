// The sample of meshes among marched shapes.
#include <gtest/gtest.h>

#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/scene_file.h"

namespace sdf::test {
namespace composite_test {

// Drawn or marched, the creature is the same one: they differ by its colours, which the field has the mean
// of, and by less than a voxel.
TEST(Composite, ShowsTheMeshWhereItsFieldIs) {
  const viewer::SceneFile file(SDF_SOURCE_DIR "/samples/meshes/composite.lua");
  const auto scene = file.load({});
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  ASSERT_EQ(scene->notes.size(), 1u);
  GpuRenderOptions options;
  options.width = 320;
  options.height = 180;
  options.shader.view = viewer::View::Normals;
  EXPECT_EQ(viewer::planOf(*scene, options.shader)->drawn.size(), 1u);
  const auto drawn = renderOnGpu(*scene, options);
  options.shader.drawing = false;
  const auto marched = renderOnGpu(*scene, options);
  EXPECT_GE(psnr(colors(drawn), colors(marched)), 30.0);
  EXPECT_LE(shareApart(colors(drawn), colors(marched), 0.3), 0.005);
}

}  // namespace composite_test
}  // namespace sdf::test
