// What compiling costs: a scene of a thousand parts, and a parameter that moves.
#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "sdf/script/script.h"
#include "sdf/shape/solids.h"
#include "viewer/gpu/context.h"
#include "viewer/render/renderer.h"

namespace sdf::viewer {
namespace {

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
  ASSERT_TRUE(renderer->draw(frameOf(scene), *target));
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
    EXPECT_EQ(before->picture.values.uniformValues({{"time", 3.25}}), after->picture.values.uniformValues({}))
        << name;
  }
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

}  // namespace
}  // namespace sdf::viewer
