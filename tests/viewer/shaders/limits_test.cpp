// What a scene of very many parts is told where lists of them have no room.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <memory>

#include "sdf/script/script.h"
#include "viewer/gpu/texels.h"
#include "viewer/headless_test.h"
#include "viewer/render/renderer.h"

namespace sdf::viewer {
namespace limits_test {

constexpr std::size_t kMostTexels = std::size_t{1} << 24;  // that floats tell apart
constexpr const char* kParts = SDF_SOURCE_DIR "/samples/bench/v_parts.lua";

class Limits : public HeadlessTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HeadlessTest::SetUp());
    room();  // epoxy looks a function up when it is first called
    real = glGetIntegerv;
  }
  void TearDown() override {
    if (real) glGetIntegerv = real;
  }
  static std::size_t room() {
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::size_t>(texels);
  }
  /// Lets the driver say that it has no more room than this.
  void limit(GLint texels) {
    said = texels;
    glGetIntegerv = [](GLenum name, GLint* value) {
      real(name, value);
      if (name == GL_MAX_TEXTURE_BUFFER_SIZE) *value = said;
    };
  }

  static inline decltype(epoxy_glGetIntegerv) real = nullptr;
  static inline GLint said = 0;
};

// The texels are never looked at, and so take no memory.
TEST_F(Limits, ARowOfMoreTexelsThanThereIsRoomForIsRefused) {
  const auto texels = std::make_unique_for_overwrite<glm::vec4[]>(kMostTexels + 1);
  const auto filled = [&](std::size_t count) {
    TexelRow row;
    return row.fill({texels.get(), count});
  };
  const std::size_t most = std::min(room(), kMostTexels);
  const Status refused = filled(most + 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::Limits);
  EXPECT_EQ(refused.error().message, "the scene's parts take " + std::to_string(most + 1) +
                                         " texels, and there is room for " + std::to_string(most) +
                                         "; draw it with --no-culling, or give it fewer parts");
  limit(1 << 30);  // of a driver that has room for more than floats tell apart
  const Status many = filled(kMostTexels + 1);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().message.find("room for 16777216;"), std::string::npos) << many.error().message;
}

// And what it is told to do helps.
TEST_F(Limits, AScenesPictureSaysSoAndIsDrawnWithoutLists) {
  const Scene scene = loadScene(kParts).value();
  const Target target = Target::create(32, 24, {PixelFormat::Rgba8}).value();
  const Frame frame = frameOf(LookFunction(scene));
  ShaderOptions options;
  Renderer listed = Renderer::make(scene, options).value();
  ASSERT_TRUE(listed.shaders().plan.cells);
  ASSERT_TRUE(listed.draw(frame, target));
  constexpr GLint kRoom = 4096;
  limit(kRoom);
  Renderer refused = Renderer::make(scene, options).value();
  const Status status = refused.draw(frame, target);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Limits);
  EXPECT_NE(status.error().message.find("room for 4096; draw it with --no-culling"), std::string::npos)
      << status.error().message;
  options.culling = false;
  Renderer plain = Renderer::make(scene, options).value();
  EXPECT_TRUE(plain.draw(frame, target));
}

}  // namespace limits_test
}  // namespace sdf::viewer
