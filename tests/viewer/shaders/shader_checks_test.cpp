// Slips between the shaders' parts and the code that feeds them: each is caught. While these tests are linked
// in, every program that any test draws with is held to the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "sdf/script/script.h"
#include "support/samples.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/headless_test.h"
#include "viewer/shaders/assemble.h"
#include "viewer/shaders/source.h"

namespace sdf::viewer {
namespace shader_checks_test {

using Lines = std::vector<std::string>;

class Strictly : public testing::Environment {
  void SetUp() override { Program::strict = Composer::strict = true; }
};
const testing::Environment* const kStrictly = testing::AddGlobalTestEnvironment(new Strictly);

TEST(DeclaredUniforms, AreThoseOfAllDeclarations) {
  EXPECT_EQ(declaredUniforms(
                "#version 330 core\nuniform vec2 size;  // uniform int no;\nuniform vec3 from, right;\n"
                "uniform vec4 lights[3] ; uniform int n;\n// uniform float commented;\nvoid main() {}\n"),
            (std::set<std::string>{"size", "from", "right", "lights", "n"}));
}

class StrictProgram : public HeadlessTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HeadlessTest::SetUp());
    target = Target::create(1, 1, {PixelFormat::Rgba8}).value();
    target->bind();
  }
  static Program program() {
    return Program::overScreen(
               "#version 330 core\nuniform float a;\nuniform vec4 b[2];\nout vec4 c;\nvoid main() { c = "
               "vec4(a); }\n")
        .value();
  }
  std::optional<Target> target;
};

TEST_F(StrictProgram, DrawsWithWhatItDeclares) {
  const Program p = program();
  p.set("a", 1.0f);
  p.set("b", std::vector{glm::vec4(1.0f), glm::vec4(2.0f)});
  EXPECT_TRUE(p.uniformFaults().empty());
  EXPECT_NO_THROW(p.draw());
}

TEST_F(StrictProgram, RefusesAUniformThatIsNeverSet) {
  const Program p = program();
  p.set("a", 1.0f);
  EXPECT_EQ(p.uniformFaults(), Lines{"the uniform b is declared but not set"});
  EXPECT_THROW(p.draw(), std::logic_error);
}

TEST_F(StrictProgram, RefusesAUniformThatNoShaderDeclares) {
  const Program p = program();
  p.set("a", 1.0f);
  p.set("b", std::vector{glm::vec4(1.0f), glm::vec4(2.0f)});
  p.set("typo", 1.0f);
  EXPECT_EQ(p.uniformFaults(), Lines{"the uniform typo is set but not declared"});
  EXPECT_THROW(p.draw(), std::logic_error);
}

TEST_F(StrictProgram, RefusesTilesWithoutTheirUniforms) {
  const Program p =
      Program::overTiles("#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n").value();
  EXPECT_THROW(p.drawTiles(1, 1, 1), std::logic_error);
}

TEST(Macros, AreCapitalsThatAreNotDeclared) {
  EXPECT_EQ(usedMacros("const int HIT = 1, MISS = 0;  // SAID\nfloat f(vec3 p) { return FAR * p.x + HIT; }"),
            std::set<std::string>{"FAR"});
}

TEST(Macros, OneThatIsUndefinedOrUnusedIsAFault) {
  EXPECT_EQ(macroFaults("#define ONE 1\n#define TWO (ONE + 1)\nint f() { return TWO; }\n"), Lines{});
  EXPECT_EQ(macroFaults("#define ONE 1\nint f() { return ONE + TWO; }\n"),
            Lines{"TWO is used but not defined"});
  EXPECT_EQ(macroFaults("#define ONE 1\n#define TWO(c) (c)\nint f() { return ONE; }\n"),
            Lines{"TWO is defined but not used"});
}

TEST(Macros, OneThatNoPartUsesIsDead) {
  EXPECT_EQ(deadMacros({{"REST", "0.0"}, {"ENCODE(c)", "c"}}), Lines{});
  EXPECT_EQ(deadMacros({{"REST", "0.0"}, {"RESTS", "0.0"}}), Lines{"RESTS"});
}

TEST(Composer, RefusesMacrosThatAreDeadOrUndefined) {
  EXPECT_THROW(Composer(false, {{"RESTS", "0.0"}}, {}, {}), std::logic_error);
  Composer composer(false, {{"REST", "TAPS"}}, {}, {});
  EXPECT_THROW(composer.compose("float rest(vec3 p) { return REST; }\n"), std::logic_error);
}

TEST(Composer, WritesTheMacrosAndFunctionsThatAreUsed) {
  const Functions functions{{"sdfOne", [] { return std::vector{position().x}; }},
                            {"sdfTwo", [] { return std::vector{position().y}; }}};
  Composer composer(false, {{"REST", "sdfOne(p, TAPS)"}, {"TAPS", "p"}, {"LIGHTS", "3"}}, functions, {});
  const std::string shader = composer.compose("float rest(vec3 p) { return REST; }\n");
  EXPECT_TRUE(macroFaults(shader).empty()) << shader;
  EXPECT_NE(shader.find("float sdfOne("), std::string::npos);
  EXPECT_EQ(shader.find("sdfTwo"), std::string::npos);
  EXPECT_EQ(shader.find("LIGHTS"), std::string::npos);
}

TEST(Macros, AreSoundInAllShadersOfAllSamples) {
  for (const std::filesystem::path& file : test::samples()) {
    const auto scene = loadScene(file);
    ASSERT_TRUE(scene) << scene.error().message;
    for (int view = 0; view < static_cast<int>(View::Count); ++view)
      for (const bool counts : {false, true}) {
        const auto made = assemble(*scene, {.view = static_cast<View>(view), .countReadings = counts});
        ASSERT_TRUE(made) << made.error().message;
        Lines shaders{made->picture.text, made->resolve};
        if (made->background) shaders.push_back(made->background->text);
        for (const HitShaders& pass : made->hits) shaders.insert(shaders.end(), {pass.cones, pass.hits});
        std::erase(shaders, "");
        for (const std::string& shader : shaders) EXPECT_EQ(macroFaults(shader), Lines{}) << file;
      }
  }
}

}  // namespace shader_checks_test
}  // namespace sdf::viewer
