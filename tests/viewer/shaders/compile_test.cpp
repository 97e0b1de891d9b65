// What compiling costs: a scene of a thousand parts, and a parameter that moves.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "sdf/march/field.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "support/samples.h"
#include "viewer/gpu/context.h"
#include "viewer/render/renderer.h"
#include "viewer/shaders/compile_count.h"

namespace sdf::viewer {
namespace compile_test {

Scene loaded(const std::string& name) {
  auto scene = loadScene(SDF_SOURCE_DIR "/samples/" + name);
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

// A union is straight code, however long. Five seconds is what someone would wait for a window; of the
// processor's time, for other programs may be running.
TEST(Compiling, TakesAThousandSpheresToTheirFirstFrameInFiveSeconds) {
  constexpr double kPatience = 5.0;
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // Mesa remembers what it has compiled before
  const auto context = Context::headless();
  ASSERT_TRUE(context) << context.error().message;
  const Scene scene = loaded("bench/s5_thousand.lua");
  const std::clock_t start = std::clock();
  auto renderer = Renderer::make(scene);
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto target = Target::create(320, 180, {PixelFormat::Rgba8});
  ASSERT_TRUE(target);
  ASSERT_TRUE(renderer->draw(frameOf(LookFunction(scene)), *target));
  ASSERT_TRUE(target->picture());  // waits until all is drawn
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kPatience);
}

// What moves with time or a parameter is a uniform: the shaders of two moments are the same.
TEST(Compiling, IsNotRepeatedWhenAParameterMoves) {
  for (const char* name :
       {"lighting_stack.lua", "melting_landscape.lua", "metaballs.lua", "gyroid_ball.lua"}) {
    ScriptOptions later;
    later.time = 3.25;
    auto moved = loadScene(SDF_SOURCE_DIR "/samples/" + std::string(name), later);
    ASSERT_TRUE(moved) << moved.error().message;
    const ShaderOptions options{.view = View::Normals};
    const auto before = assemble(loaded(name), options), after = assemble(*moved, options);
    ASSERT_TRUE(before && after) << name;
    EXPECT_EQ(before->picture.text, after->picture.text) << name;
    ASSERT_EQ(before->hits.size(), after->hits.size()) << name;
    for (std::size_t i = 0; i < before->hits.size(); ++i)
      EXPECT_EQ(before->hits[i].cones, after->hits[i].cones) << name;
    EXPECT_EQ(before->picture.uniforms.uniform({{"time", 3.25}}), after->picture.uniforms.uniform()) << name;
  }
}

// A frame's numbers are read from functions that were compiled with the shaders.
TEST(Compiling, IsOverWhenAFrameOfAnotherMomentIsDrawn) {
  const auto context = Context::headless();
  ASSERT_TRUE(context) << context.error().message;
  const auto target = Target::create(16, 9, {PixelFormat::Rgba8});
  ASSERT_TRUE(target);
  for (const char* name :
       {"lighting_stack.lua", "melting_landscape.lua", "metaballs.lua", "bench/v_balls.lua"}) {
    const Scene scene = loaded(name);
    const LookFunction look(scene);
    auto renderer = Renderer::make(scene);
    ASSERT_TRUE(renderer) << renderer.error().message;
    const auto draw = [&](double time) {
      Frame frame;
      frame.parameters = {{"time", time}};
      frame.look = look.at(frame.parameters);
      ASSERT_TRUE(renderer->draw(frame, *target));
    };
    draw(0.0);
    const test::CompileCount count;
    draw(1.25);
    draw(2.5);
    EXPECT_EQ(count.value(), 0) << name;
    EXPECT_EQ(count.tapes(), 0u) << name;
  }
}

// Of the processor's time, for other programs may be running; a frame at sixty a second has 16 ms for all.
TEST(Compiling, LeavesAFramesNumbersToBeComputedInAFifthOfAMillisecond) {
  constexpr int kFrames = 200;
  constexpr double kPatience = 0.2e-3;
  for (const std::filesystem::path& file : test::samples()) {
    const Scene scene = loaded(file.filename());
    const auto shaders = assemble(scene, {});
    ASSERT_TRUE(shaders) << shaders.error().message;
    const LookFunction look(scene);
    std::vector<UniformValues> all{UniformValues(shaders->picture.uniforms)};
    for (const HitShaders& pass : shaders->hits) all.emplace_back(pass.uniforms);
    all.emplace_back(shaders->rows);
    const std::clock_t start = std::clock();
    for (int i = 0; i < kFrames; ++i) {
      const Values values{{"time", 0.01 * i}};
      look.at(values);
      for (UniformValues& uniforms : all) uniforms.move(values);
    }
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / kFrames, kPatience) << file;
  }
}

TEST(Compiling, IsRefusedForTheShapesThatMarchingRefuses) {
  const Vec3E p = position();
  const Expr steep = p.x * p.x * p.y - 1.0, moderate = p.x * p.x - 1.0;
  const Box box = Box::centred(glm::dvec3(2.0));
  const Shape floor = plane(Vec3E(Expr(0.0), Expr(1.0), Expr(0.0)), 0.0);
  const Shape all[] = {sphere(1.0),
                       floor,
                       field(steep),
                       field(steep, box),
                       field(moderate, box) | floor,
                       field(moderate) | floor,
                       field(log(p.x), box)};
  std::vector<bool> refused;
  for (const Shape& shape : all) {
    Scene scene;
    scene.add("", shape);
    const auto marched = marchField(shape);
    ASSERT_TRUE(marched) << marched.error().message;
    refused.push_back(!assemble(scene, {}));
    EXPECT_EQ(refused.back(), !checkSlope(*marched, "a ray")) << refused.size();
  }
  EXPECT_EQ(refused, (std::vector<bool>{false, false, true, false, false, true, true}));
}

TEST(Compiling, NamesThePartWhoseSlopeIsNotKnown) {
  Scene scene;
  scene.add("ball", sphere(1.0));
  scene.add("blob", field(position().x * position().y - 1.0));
  const auto shaders = assemble(scene, {});
  ASSERT_FALSE(shaders.ok());
  EXPECT_EQ(shaders.error().message.find("part 'blob': the slope of this distance is not known"), 0u)
      << shaders.error().message;
}

TEST(Compiling, NamesThePartBehindEachLine) {
  Scene scene;
  scene.add("ball", sphere(1.0));
  scene.add("a \\\nmean name", box(Vec3E(Expr(1.0), Expr(2.0), Expr(3.0))));
  const auto shaders = assemble(scene, {});
  ASSERT_TRUE(shaders.ok());
  EXPECT_NE(shaders->picture.text.find(" - 1.0;  // part 'ball'\n"), std::string::npos)
      << shaders->picture.text;
  EXPECT_NE(shaders->picture.text.find("  // part 'a ??mean name'\n"), std::string::npos);
  const auto context = Context::headless();
  ASSERT_TRUE(context.ok());
  EXPECT_TRUE(Program::overScreen(shaders->picture.text).ok());
  std::string broken = shaders->picture.text;
  const std::size_t line = broken.find(" - 1.0;  // part 'ball'");
  broken.replace(line, 6, " - no;");
  const auto rejected = Program::overScreen(broken);
  ASSERT_FALSE(rejected.ok());
  EXPECT_NE(rejected.error().message.find("part 'ball'"), std::string::npos) << rejected.error().message;
}

}  // namespace compile_test
}  // namespace sdf::viewer
