// The panels, in a Dear ImGui of their own that draws nowhere.
#include <gtest/gtest.h>
#include <imgui/imgui.h>

#include <random>

#include "support/folder.h"
#include "viewer/app/gui.h"
#include "viewer/headless_test.h"

namespace sdf::viewer {
namespace gui_test {

constexpr float kWidth = 800.0f, kHeight = 700.0f;
constexpr int kPictureSize = 16;

class GuiTest : public HeadlessTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HeadlessTest::SetUp());
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {kWidth, kHeight};
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  }
  void TearDown() override { ImGui::DestroyContext(); }

  Session open(const std::filesystem::path& scene) {
    auto session = Session::open(scene);
    if (!session) throw std::runtime_error(session.error().message);
    return std::move(*session);
  }

  Session openText(const std::string& text) {
    std::ofstream(folder / "scene.lua") << text;
    return open(folder / "scene.lua");
  }

  Requests frame(Session& session) {
    ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    ImGui::NewFrame();
    Requests requests;
    gui.mesh.overPicture(session);
    gui.panels(session, canvas, requests);
    gui.overlay(session);
    ImGui::Render();
    return requests;
  }

  /// Presses and lets go at a place, with the frames that Dear ImGui needs to notice.
  void click(Session& session, float x, float y) { clickRequests(session, x, y); }

  /// The same, and whether it asked for the mesh to be exported.
  Requests clickRequests(Session& session, float x, float y) {
    ImGuiIO& io = ImGui::GetIO();
    Requests all;
    const auto next = [&] { all.exportMesh |= frame(session).exportMesh; };
    io.MousePos = {x, y};
    next();
    for (const bool down : {true, false}) {
      io.MouseDown[0] = down;
      next();
    }
    next();
    return all;
  }

  const Folder folder;
  Canvas canvas;
  Gui gui{"scene.png"};
};

TEST_F(GuiTest, PanelsThatNobodyTouchesChangeNothing) {
  for (const char* sample : {"lighting_stack", "metaballs", "machined_part"}) {
    Session session = open(std::string(SDF_SOURCE_DIR "/samples/") + sample + ".lua");
    const Controls before = session.controls;
    for (int i = 0; i < 5; ++i) {
      const Requests requests = frame(session);
      EXPECT_FALSE(requests.savePicture || requests.copyCamera || requests.measure || requests.close);
    }
    EXPECT_TRUE(session.controls == before) << sample;
  }
}

TEST_F(GuiTest, ParametersMayHaveAnyNameAndRange) {
  Session session = openText(R"(
local a = param("##", 0, {min = 0, max = 0})
local b = param("100 %s %n", 0, {min = -1e308, max = 1e308})
local c = param("###x##y", 1e-9, {min = 0, max = 1e-8})
local d = param("\xff\xfe", 0, {min = -1e7, max = 1e7})
part("%s##", sphere(1 + a + c):translate(d + b, 0, 0))
)");
  for (float y = 0.0f; y < 200.0f; y += 6.0f) click(session, 100.0f, y);
  for (const ParameterInfo& p : session.scene().parameters) {
    EXPECT_GE(session.value(p), p.min) << p.name;
    EXPECT_LE(session.value(p), p.max) << p.name;
  }
}

TEST_F(GuiTest, MeshControlsMoveTheMesh) {
  Session session = openText("return sphere(1)");
  bool uniform = false, tolerance = false, exports = false, voxels = false;
  for (const float x : {40.0f, 120.0f})
    for (float y = 0.0f; y < 400.0f; y += 5.0f) {
      session.controls = {};
      session.controls.shader.view = View::Mesh;
      const Requests requests = clickRequests(session, x, y);
      const MeshSettings& mesh = session.controls.mesh;
      uniform = uniform || (mesh.voxelSize && !mesh.tolerance);
      tolerance = tolerance || (mesh.tolerance && !mesh.voxelSize);
      voxels = voxels || (mesh.tolerance && mesh.voxelSize);
      exports = exports || requests.exportMesh;
      for (const auto& length : {mesh.tolerance, mesh.voxelSize})
        if (length) {
          EXPECT_GE(*length, 0.9e-5 * session.extent());
          EXPECT_LE(*length, 0.11 * session.extent());
        }
    }
  EXPECT_TRUE(uniform);
  EXPECT_TRUE(tolerance);
  EXPECT_TRUE(voxels);
  EXPECT_TRUE(exports);
}

TEST_F(GuiTest, NoClicksBreakAnything) {
  Session session = open(SDF_SOURCE_DIR "/samples/lighting_stack.lua");
  constexpr unsigned kSeed = 1;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> x(0.0f, 340.0f), y(0.0f, kHeight);
  const Controls before = session.controls;
  for (int i = 0; i < 300; ++i) {
    click(session, x(random), y(random));
    session.settle();
    const auto drawn = canvas.update(session, kPictureSize, kPictureSize, i);
    ASSERT_TRUE(drawn) << "seed " << kSeed << ", click " << i << ": " << drawn.error().message;
    ASSERT_EQ(session.message(), "") << "seed " << kSeed << ", click " << i;
  }
  EXPECT_FALSE(session.controls == before) << "the clicks hit nothing";
}

}  // namespace gui_test
}  // namespace sdf::viewer
