// The viewer's ground: contexts, shaders, targets and PNG files, on whatever OpenGL there is.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "support/folder.h"
#include "viewer/gpu/context.h"
#include "viewer/gpu/picture.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/read_png.h"
#include "viewer/gpu/target.h"
#include "viewer/headless_test.h"

namespace sdf::viewer {
namespace gpu_test {

using ProgramTest = HeadlessTest;
using TargetTest = HeadlessTest;
using CheckTest = HeadlessTest;

Program overScreen(const std::string& body) {
  auto program = Program::overScreen("#version 330 core\n" + body);
  if (!program) throw std::runtime_error(program.error().message);
  return std::move(*program);
}

Target target(int width, int height, const std::vector<PixelFormat>& layers = {PixelFormat::Rgba32f},
              bool depth = false) {
  auto made = Target::create(width, height, layers, depth);
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(*made);
}

/// What a program draws into one pixel of floats.
glm::vec4 drawn(const Program& program) {
  const Target pixel = target(1, 1);
  pixel.bind();
  program.draw();
  const auto pixels = pixel.pixels();
  if (!pixels) throw std::runtime_error(pixels.error().message);
  return pixels->front();
}

/// Says on stderr why there is no context, and ends; for a process without OpenGL.
[[noreturn]] void tellWhy() {
  ::unsetenv("DISPLAY");
  const auto context = Context::headless();
  if (context) std::_Exit(0);
  std::fprintf(stderr, "%s\n", context.error().message.c_str());
  std::_Exit(static_cast<int>(context.error().kind));
}

/// The process that EXPECT_EXIT starts from scratch reads the environment as it is set here.
class WithoutOpenGl : public testing::Test {
 protected:
  WithoutOpenGl() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  ~WithoutOpenGl() override {
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    ::unsetenv("LD_LIBRARY_PATH");
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
  }
  /// Puts a file that is no library in the place of one.
  void breakLibrary(const char* name) {
    std::ofstream(folder / name) << "no library";
    ::setenv("LD_LIBRARY_PATH", folder.path().c_str(), 1);
  }
  static constexpr auto kGraphics = static_cast<int>(ErrorKind::Graphics);
  const Folder folder;
};

TEST_F(WithoutOpenGl, EveryWaySaysWhyItFailsAndWhatToInstall) {
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/no/such/driver.json", 1);
  EXPECT_EXIT(
      tellWhy(), testing::ExitedWithCode(kGraphics),
      "^there is no OpenGL 3.3 to draw with \\(EGL surfaceless: no driver has [A-Za-z_]*; "
      "EGL device: no driver has [A-Za-z_]*; hidden window: .*DISPLAY.*\\); install a driver, e.g. on "
      "Debian: apt-get install libegl1 libgl1-mesa-dri\n$");
}

TEST_F(WithoutOpenGl, AMissingEglIsNamed) {
  breakLibrary("libEGL.so.1");
  EXPECT_EXIT(tellWhy(), testing::ExitedWithCode(kGraphics),
              "EGL surfaceless: libEGL.so.1 cannot be loaded; ");
}

TEST_F(WithoutOpenGl, AMissingGlIsNamed) {
  breakLibrary("libGL.so.1");
  breakLibrary("libOpenGL.so.0");
  EXPECT_EXIT(tellWhy(), testing::ExitedWithCode(kGraphics),
              "EGL surfaceless: neither libGL.so.1 nor libOpenGL.so.0 can be loaded; ");
}

TEST_F(WithoutOpenGl, ADriverThatIsTooOldIsTold) {
  // Only Mesa can be made to look old.
  constexpr const char* kMesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
  if (!std::filesystem::exists(kMesa)) GTEST_SKIP() << "no " << kMesa;
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", kMesa, 1);
  ::setenv("MESA_GL_VERSION_OVERRIDE", "3.2", 1);
  EXPECT_EXIT(tellWhy(), testing::ExitedWithCode(kGraphics),
              "EGL surfaceless: eglCreateContext has no such version; ");
}

TEST(ContextTest, ComesUpWithoutADisplay) {
  ::unsetenv("DISPLAY");
  const auto context = Context::headless();
  ASSERT_TRUE(context) << context.error().message;
  EXPECT_GE((*context)->driver().version, 33);
  EXPECT_GE((*context)->driver().mostWidth, 1024);  // the least that OpenGL 3.3 allows
  EXPECT_EQ((*context)->description().find((*context)->driver().renderer + ", OpenGL "), 0u);
}

TEST(ContextTest, SurfacelessAndDeviceEachSuffice) {
  for (const Way way : {Way::Surfaceless, Way::Device}) {
    const auto context = Context::open(way);
    ASSERT_TRUE(context) << context.error().message;
    EXPECT_EQ((*context)->way(), way);
    EXPECT_EQ(drawn(overScreen("out vec4 c; void main() { c = vec4(1, 2, 3, 4); }")), glm::vec4(1, 2, 3, 4));
  }
}

TEST(ContextTest, OutlivesTheEndOfAnother) {
  const auto first = Context::headless();
  ASSERT_TRUE(first);
  const Program program = overScreen("out vec4 c; void main() { c = vec4(0.5); }");
  ASSERT_TRUE(Context::headless());  // current, and gone again
  ASSERT_TRUE((*first)->makeCurrent());
  EXPECT_EQ(drawn(program), glm::vec4(0.5f));
}

TEST_F(CheckTest, ReportsAMistakeOnceAndWithWhatWasDone) {
  EXPECT_TRUE(check("draw"));
  glEnable(GL_RGBA);
  glViewport(0, 0, -1, -1);
  const Status status = check("draw");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Graphics);
  EXPECT_EQ(status.error().message, "cannot draw: OpenGL reports GL_INVALID_ENUM");
  EXPECT_TRUE(check("draw again"));
}

TEST(StatusOf, KnowsWhatNoTestCanBringAbout) {
  EXPECT_EQ(statusOf(GL_CONTEXT_LOST, "draw").error().kind, ErrorKind::Graphics);
  EXPECT_EQ(statusOf(GL_CONTEXT_LOST, "draw").error().message,
            "cannot draw: the driver was reset and the context is lost; start again");
  EXPECT_EQ(statusOf(GL_OUT_OF_MEMORY, "draw").error().kind, ErrorKind::Limits);
  EXPECT_EQ(statusOf(GL_INVALID_FRAMEBUFFER_OPERATION, "draw").error().message,
            "cannot draw: OpenGL reports error 1286");
}

TEST_F(ProgramTest, SetsEveryKindOfUniform) {
  const Program program = overScreen(R"(
uniform int i; uniform float f; uniform vec2 v2; uniform vec3 v3; uniform vec4 vs[2];
out vec4 c;
void main() { c = vec4(float(i) + f, v2.y, v3.z, vs[0].x + 10.0 * vs[1].w); }
)");
  const std::vector<glm::vec4> vectors{{1, 2, 3, 4}, {5, 6, 7, 8}};
  program.set("i", 7);
  program.set("f", 0.5f);
  program.set("v2", glm::vec2(0, 100));
  program.set("v3", glm::vec3(0, 0, 3));
  program.set("vs", vectors);
  EXPECT_EQ(drawn(program), glm::vec4(7.5f, 100, 3, 81));
  EXPECT_TRUE(check("set uniforms"));
}

TEST_F(ProgramTest, LetsAnUnknownUniformBeSet) {
  const Program program = overScreen("out vec4 c; void main() { c = vec4(1); }");
  program.set("absent", 1.0f);
  EXPECT_TRUE(check("set a uniform"));
}

TEST_F(ProgramTest, ABadShadersMessageNamesTheLineAndQuotesIt) {
  const auto program = Program::overScreen(
      "#version 330 core\nout vec4 c;\nvoid main() {\n  c = vec4(1) + missing(2.0);  // part 'ball'\n}\n");
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().kind, ErrorKind::Graphics);
  const std::string& message = program.error().message;
  EXPECT_EQ(message.find("the driver rejects the fragment shader: line 4: "), 0u) << message;
  EXPECT_NE(message.find("missing"), std::string::npos) << message;
  EXPECT_NE(message.find(" in 'c = vec4(1) + missing(2.0);  // part 'ball''"), std::string::npos) << message;
  EXPECT_EQ(message.find_first_of(std::string("\n\0", 2)), std::string::npos) << message;
}

TEST_F(ProgramTest, AVertexShaderIsRejectedAsOne) {
  const auto program = Program::create("#version 330 core\nvoid main() { nonsense }",
                                       "#version 330 core\nout vec4 c; void main() { c = vec4(1); }");
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().message.find("the driver rejects the vertex shader: line 2: "), 0u);
}

TEST_F(ProgramTest, ShadersThatDoNotFitEachOtherAreRejected) {
  const auto program = Program::create(
      "#version 330 core\nout vec2 handed; void main() { handed = vec2(0); gl_Position = vec4(0); }",
      "#version 330 core\nin vec3 handed; out vec4 c; void main() { c = vec4(handed, 1); }");
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().message.find("the driver rejects the linked shaders: "), 0u);
  EXPECT_NE(program.error().message.find("handed"), std::string::npos);
}

TEST(ShaderLog, ReadsThePlacesOfEveryDriver) {
  for (const char* const log :
       {"0:2(13): error: what is it", "0(2) : error: what is it", "ERROR: 0:2: error: what is it"})
    EXPECT_EQ(complaintsOf(log, "one\n  two\nthree"), "line 2: error: what is it in 'two'") << log;
}

TEST(ShaderLog, KeepsWhatHasNoPlaceAndLeavesWarningsOut) {
  EXPECT_EQ(complaintsOf("0:1(1): warning: unused\n\nout of registers\n0:9(1): error: beyond\n", "one"),
            "out of registers; line 9: error: beyond");
}

TEST(ShaderLog, QuotesOnlyTheFirstFew) {
  EXPECT_EQ(complaintsOf("a\nb\nc\nd\ne", ""), "a; b; c; and 2 more");
  EXPECT_EQ(complaintsOf("", ""), "");
}

TEST_F(TargetTest, AGradientEqualsItsFormulaToTheBit) {
  constexpr int kWidth = 61, kHeight = 37;
  const Program program = overScreen(
      "uniform float k; out vec4 c;\n"
      "void main() { c = vec4(gl_FragCoord.x * k, gl_FragCoord.y * k, gl_FragCoord.x - gl_FragCoord.y, -k); "
      "}");
  constexpr float kFactor = 1.1f;  // one rounding in each product
  program.set("k", kFactor);
  const Target floats = target(kWidth, kHeight);
  floats.bind();
  program.draw();
  const auto pixels = floats.pixels();
  ASSERT_TRUE(pixels) << pixels.error().message;
  ASSERT_EQ(pixels->size(), std::size_t(kWidth * kHeight));
  for (int fromTop = 0; fromTop < kHeight; ++fromTop)
    for (int i = 0; i < kWidth; ++i) {
      const float x = float(i) + 0.5f, y = float(kHeight - 1 - fromTop) + 0.5f;
      ASSERT_EQ((*pixels)[std::size_t(fromTop * kWidth + i)],
                glm::vec4(x * kFactor, y * kFactor, x - y, -kFactor))
          << i << " " << fromTop;
    }
}

TEST_F(TargetTest, BytesAreClampedAndRoundedRowsFromTheTop) {
  const Program program =
      overScreen("out vec4 c; void main() { c = vec4(gl_FragCoord.y - 0.5, 2.0, -1.0, 100.0 / 255.0); }");
  for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Rgba32f}) {
    const Target rows = target(1, 2, {format});
    rows.bind();
    program.draw();
    const auto picture = rows.picture();
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->bytes, (std::vector<std::uint8_t>{255, 255, 0, 100, 0, 255, 0, 100}));
  }
}

TEST_F(TargetTest, OutputsFillTheirLayersInTheirFormats) {
  const Program program = overScreen(
      "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b; layout(location = 2) out vec4 c;\n"
      "void main() { a = b = c = vec4(0.1, 1.0, 70000.0, 2049.0); }");
  const Target layers = target(3, 2, {PixelFormat::Rgba8, PixelFormat::Rg32f, PixelFormat::Rgba32f});
  layers.bind();
  program.draw();
  EXPECT_EQ(layers.pixels(0)->back().z, 1.0f);
  EXPECT_EQ(layers.pixels(1)->back(), glm::vec4(0.1f, 1.0f, 0.0f, 1.0f));  // what it lacks reads so
  EXPECT_EQ(layers.pixels(2)->back(), glm::vec4(0.1f, 1.0f, 70000.0f, 2049.0f));
}

TEST_F(TargetTest, IsReadByTheNextProgram) {
  const Target first = target(4, 3, {PixelFormat::Rgba32f, PixelFormat::Rgba32f});
  first.bind();
  overScreen(
      "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b;\n"
      "void main() { a = vec4(gl_FragCoord.xy, 0.0, 0.0); b = -a; }")
      .draw();
  const Program reader = overScreen(
      "uniform sampler2D a, b; out vec4 c;\n"
      "void main() { c = vec4(texelFetch(a, ivec2(3, 2), 0).xy, textureLod(b, vec2(-1.0, 0.5), 0.0).xy); }");
  reader.set("a", 2);
  reader.set("b", 5);
  first.bindTexture(2, 0);
  first.bindTexture(5, 1);
  EXPECT_EQ(drawn(reader), glm::vec4(3.5f, 2.5f, -0.5f, -1.5f));
}

TEST_F(TargetTest, IsFilledLayerByLayerAndSummedUp) {
  const Target layers = target(4, 3, {PixelFormat::Rgba32f, PixelFormat::Rgba32f});
  layers.clear(0, glm::vec4(1, 2, 3, 4));
  layers.clear(1, glm::vec4(0.5));
  EXPECT_EQ(*layers.sum(0), glm::dvec4(12, 24, 36, 48));
  EXPECT_EQ(*layers.sum(1), glm::dvec4(6));
}

TEST_F(TargetTest, APartOfItIsDrawnInto) {
  const Target whole = target(5, 4);
  whole.clear(0, glm::vec4(0));
  whole.bind(1, 2, 3, 2);
  overScreen("out vec4 c; void main() { c = vec4(gl_FragCoord.xy, 1.0, 0.0); }").draw();
  EXPECT_EQ(*whole.sum(0), glm::dvec4(2 * (1.5 + 2.5 + 3.5), 3 * (2.5 + 3.5), 6, 0));
}

TEST_F(TargetTest, TheNearestFragmentWinsWhileAsked) {
  const Target pixel = target(1, 1, {PixelFormat::Rgba32f}, true);
  const Program program =
      overScreen("uniform float f; out vec4 c; void main() { c = vec4(f); gl_FragDepth = f; }");
  const auto draw = [&](float f) {
    program.set("f", f);
    program.draw();
    return pixel.pixels()->front().x;
  };
  pixel.clear(0, glm::vec4(9));
  pixel.clearDepth();
  {
    const DrawingMode nearest = nearestWins();
    EXPECT_EQ(draw(0.5f), 0.5f);
    EXPECT_EQ(draw(0.75f), 0.5f);
    EXPECT_EQ(draw(0.25f), 0.25f);
    EXPECT_EQ(draw(1.0f), 0.25f);
  }
  EXPECT_EQ(draw(0.75f), 0.75f);
}

TEST_F(TargetTest, FragmentsAddUpInOneLayerWhileAsked) {
  const Target pixel = target(1, 1, {PixelFormat::Rgba32f, PixelFormat::Rgba32f});
  const Program program = overScreen(
      "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b; void main() { a = b = vec4(2, 3, 4, "
      "5); }");
  pixel.clear(0, glm::vec4(1));
  pixel.clear(1, glm::vec4(1));
  {
    const DrawingMode second = oneLayer(1);
    const DrawingMode sum = sumOfAll();
    program.draw();
    program.draw();
  }
  EXPECT_EQ(pixel.pixels(0)->front(), glm::vec4(1));
  EXPECT_EQ(pixel.pixels(1)->front(), glm::vec4(5, 7, 9, 11));
  program.draw();
  EXPECT_EQ(pixel.pixels(0)->front(), glm::vec4(2, 3, 4, 5));
  EXPECT_EQ(pixel.pixels(1)->front(), glm::vec4(2, 3, 4, 5));
}

// Two cells of 3 x 2 tiles side by side: tile (1, 0) is low in the first, (2, 1) in the second.
TEST_F(ProgramTest, DrawsTheTilesThatACellAsksFor) {
  const Target cells = target(6, 2);
  cells.bind();
  overScreen(
      "out vec4 c;\n"
      "void main() { ivec2 p = ivec2(gl_FragCoord.xy); c = vec4(p == ivec2(1, 0) || p == ivec2(5, 1) ? 1.0 : "
      "7.0); }")
      .draw();
  const auto program = Program::overTiles(
      "#version 330 core\nout vec4 c; void main() { c = vec4(gl_FragCoord.xy, 1.0, 1.0); }");
  ASSERT_TRUE(program) << program.error().message;
  constexpr int kSide = 4, kWidth = 10, kHeight = 7;  // the last tiles reach beyond
  const auto drawnWith = [&](int first, int last) {
    const Target pixels = target(kWidth, kHeight);
    pixels.clear(0, glm::vec4(0));
    cells.bindTexture(3);
    program->set("tiles", 3);
    program->set("tileLimit", 7.0f);
    program->set("firstCell", first);
    program->set("lastCell", last);
    program->drawTiles(3, 2, kSide);
    return *pixels.sum(0);
  };
  const glm::dvec4 first(4 * (4.5 + 5.5 + 6.5 + 7.5), 4 * (0.5 + 1.5 + 2.5 + 3.5), 16, 16);
  const glm::dvec4 second(3 * (8.5 + 9.5), 2 * (4.5 + 5.5 + 6.5), 6, 6);
  EXPECT_EQ(drawnWith(0, 0), first);
  EXPECT_EQ(drawnWith(1, 1), second);
  EXPECT_EQ(drawnWith(0, 1), first + second);
}

TEST_F(TargetTest, ANewOneLeavesTheOldOneBound) {
  const Target old = target(1, 1);
  old.bind();
  const Target other = target(2, 2);
  ASSERT_TRUE(other.pixels());
  overScreen("out vec4 c; void main() { c = vec4(6); }").draw();
  EXPECT_EQ(old.pixels()->front(), glm::vec4(6));
}

TEST_F(TargetTest, SizesThatCannotBeAreRefusedWithTheLimit) {
  const Driver& driver = context->driver();
  const std::string limit = std::to_string(driver.mostWidth) + " x " + std::to_string(driver.mostHeight);
  const std::pair<int, int> kSizes[] = {
      {0, 10}, {10, 0}, {-1, 10}, {driver.mostWidth + 1, 1}, {1, driver.mostHeight + 1}};
  for (const auto& [width, height] : kSizes) {
    const auto refused = Target::create(width, height, {PixelFormat::Rgba8});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Limits);
    EXPECT_EQ(refused.error().message, "cannot draw " + std::to_string(width) + " x " +
                                           std::to_string(height) +
                                           " pixels: this driver draws from 1 x 1 to " + limit);
  }
}

TEST_F(TargetTest, TheLargestSidesCanBeDrawn) {
  const Program program = overScreen("out vec4 c; void main() { c = vec4(1); }");
  for (const auto& [width, height] :
       {std::pair{context->driver().mostWidth, 1}, std::pair{1, context->driver().mostHeight}}) {
    const Target largest = target(width, height, {PixelFormat::Rgba8});
    largest.bind();
    program.draw();
    const auto picture = largest.picture();
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(std::count(picture->bytes.begin(), picture->bytes.end(), 255),
              std::ptrdiff_t(picture->bytes.size()));
  }
}

/// Every byte differs from its neighbours', and rows from each other.
Picture sample(int width, int height, int channels) {
  Picture picture{width, height, channels, {}};
  for (int i = 0; i < width * height * channels; ++i) picture.bytes.push_back(std::uint8_t(i * 37 + i / 256));
  return picture;
}

TEST(Png, KeepsEveryByte) {
  const Folder folder;
  for (const Picture& picture : {sample(1, 1, 3), sample(31, 17, 3), sample(64, 5, 4)}) {
    ASSERT_TRUE(writePng(folder / "a.png", picture));
    const Picture again = test::readPng(folder / "a.png", picture.channels);
    EXPECT_EQ(again.width, picture.width);
    EXPECT_EQ(again.height, picture.height);
    EXPECT_EQ(again.bytes, picture.bytes);
  }
}

TEST(Png, SaysWhereItCannotWrite) {
  const Folder folder;
  const Status status = writePng(folder / "none/a.png", sample(2, 2, 4));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Files);
  EXPECT_EQ(status.error().message,
            "cannot write '" + (folder / "none/a.png").string() +
                "': No such file or directory; make the folder first or choose another");
}

TEST_F(CheckTest, NoContextIsLostThatNobodyReset) { EXPECT_FALSE(contextIsLost()); }

}  // namespace gpu_test
}  // namespace sdf::viewer
