// Khronos' reference compiler reads every shader of every sample, as GLSL 3.30 core and as GLSL ES 3.00.
// Drivers let much pass that others refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "sdf/eval/glsl.h"
#include "sdf/script/script.h"
#include "sdf/shape/solids/solids.h"
#include "support/folder.h"
#include "support/operations.h"
#include "support/payloads.h"
#include "support/samples.h"
#include "tools/command.h"
#include "viewer/shaders/assemble.h"

namespace sdf {
namespace glsl_language_test {

using viewer::Method;
using viewer::View;

/// The shaders of a scene in all views and by all methods, each text once.
std::set<std::string> shadersOf(const Scene& scene) {
  std::set<std::string> all;
  for (int view = 0; view < static_cast<int>(View::Count); ++view)
    for (const Method method : {Method::AutoRelaxed, Method::Plain})
      for (const bool counts : {false, true})
        for (const bool es : {false, true}) {
          const auto made = viewer::assemble(
              scene, {.view = static_cast<View>(view), .method = method, .countReadings = counts, .es = es});
          EXPECT_TRUE(made) << made.error().message;
          if (!made) continue;
          all.insert({made->picture.text, made->resolve});
          if (made->background) all.insert(made->background->text);
          for (const viewer::HitShaders& pass : made->hits) all.insert({pass.cones, pass.hits});
          all.erase("");
        }
  return all;
}

class GlslLanguage : public testing::Test {
 protected:
  void SetUp() override {
    if (compiler.empty()) GTEST_SKIP() << "glslangValidator is not installed";
  }

  void expectSound(const std::set<std::string>& shaders) const {
    const Folder folder;
    Command command{{compiler}};
    for (const std::string& shader : shaders) {
      const auto file = folder / (std::to_string(command.words.size()) + ".frag");
      std::ofstream(file) << shader;
      command.words.push_back(file.string());
    }
    const Outcome outcome = command.run();
    EXPECT_EQ(outcome.status, 0) << outcome.out.substr(
        std::min(outcome.out.size(), outcome.out.find("ERROR")));
  }

  const std::string compiler = SDF_GLSLANG;
};

class GlslLanguageOf : public GlslLanguage, public testing::WithParamInterface<std::filesystem::path> {};

TEST_P(GlslLanguageOf, EveryShaderIsSound) {
  auto scene = loadScene(GetParam());
  ASSERT_TRUE(scene) << scene.error().message;
  expectSound(shadersOf(*scene));
}

TEST_F(GlslLanguage, HasEveryOperation) {
  GlslWriter writer;
  std::vector<Expr> outputs{Expr(NAN) + position().x, Expr(HUGE_VAL) * position().y};
  for (const test::OperationCase& c : test::graphOperations()) outputs.push_back(c.expr);
  writer.add("read", outputs);
  const std::string count = std::to_string(outputs.size());
  const std::string body =
      writer.source() + "out vec4 color;\nvoid main() {\n  sdfTakeValues();\n  float v[" + count +
      "];\n  read(gl_FragCoord.xyz, vec3(0.0), v);\n  color = vec4(v[" + count + " - 1]);\n}\n";
  expectSound({"#version 330 core\n" + body, "#version 300 es\nprecision highp float;\n" + body});
}

TEST_F(GlslLanguage, HasPayloads) {
  Scene scene;
  scene.add("grid", field(test::payloadHere(test::sampledBall(5)), Box::centred(glm::dvec3(1.0)), 2.0));
  scene.add("points", field(test::payloadHere(test::fourPoints()), Box::centred(glm::dvec3(1.5)), 1.0));
  for (const auto kind :
       {LatticeNoise::Kind::Value, LatticeNoise::Kind::Gradient, LatticeNoise::Kind::Nearest,
        LatticeNoise::Kind::Second, LatticeNoise::Kind::Border})
    scene.add("noise" + std::to_string(static_cast<int>(kind)),
              field(test::payloadHere(LatticeNoise::of(kind)) - 0.1, Box::centred(glm::dvec3(1.5)), 4.0));
  expectSound(shadersOf(scene));
}

TEST_F(GlslLanguage, HasEveryKindOfShadowAndOcclusion) {
  auto scene = loadScene(SDF_SOURCE_DIR "/samples/lighting_stack.lua");
  ASSERT_TRUE(scene) << scene.error().message;
  std::set<std::string> all;
  for (const auto shadow : {Shadow::Kind::None, Shadow::Kind::Hard, Shadow::Kind::Soft,
                            Shadow::Kind::Improved, Shadow::Kind::Signed})
    for (const auto occlusion :
         {AmbientOcclusion::Kind::None, AmbientOcclusion::Kind::Taps, AmbientOcclusion::Kind::Steps}) {
      scene->shadow.kind = shadow;
      scene->ambientOcclusion.kind = occlusion;
      all.merge(shadersOf(*scene));
    }
  expectSound(all);
}

INSTANTIATE_TEST_SUITE_P(Samples, GlslLanguageOf, testing::ValuesIn(test::samples()), test::stemOf);

}  // namespace glsl_language_test
}  // namespace sdf
