// A scene takes no more lines in C++ than in Lua, and is the same scene.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <string>

#include "script/run.h"
#include "sdf/scene/patterns.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace same_scene_test {

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

Scene sceneInCpp() {
  Scene scene;
  // begin
  const Expr k = scene.parameter("k", 0.2, 0.05, 1.0);
  const Material clay{.name = "clay", .color = {0.6, 0.2, 0.1}, .specular = Expr(0.3), .shininess = 24.0};
  const Shape body = round(box({1.0, 0.5, 1.0}), 0.1);
  const Shape dome = translate(sphere(0.7), {0.0, 0.6, 0.0});
  const Shape hole = rotate(cylinder(0.3, 2.0), {kQuarterTurn, 0.0, 0.0});
  scene.camera = {.from = Vec3E(3.0, 2.5, 4.0), .to = {0.0, 0.3, 0.0}};
  scene.lights = {{.vector = {1.0, 2.0, 1.0}}};
  scene.add("body", (unite(body, dome, Blend::quadratic(k)) - hole).paint(clay));
  scene.add("floor", plane({0.0, 1.0, 0.0}, -0.6).paint({.color = checkerboard(Expr(0.2), Expr(0.35))}));
  // end
  return scene;
}

/// Lines of code between the two markers.
int linesBetween(const std::string& file, const std::string& begin, const std::string& end) {
  std::ifstream in(std::string(SDF_SOURCE_DIR) + "/tests/script/" + file);
  int count = -1;
  for (std::string line; std::getline(in, line);) {
    const std::string text = line.substr(std::min(line.find_first_not_of(' '), line.size()));
    if (text == end) return count;
    if (count >= 0) ++count;
    if (text == begin) count = 0;
  }
  return -1;
}

TEST(SameScene, TakesNoMoreLinesInCppThanInLua) {
  const int lua = linesBetween("same_scene.lua", "-- begin", "-- end");
  const int cpp = linesBetween("same_scene_test.cpp", "// begin", "// end");
  ASSERT_GT(lua, 0);
  ASSERT_GT(cpp, 0);
  EXPECT_LE(cpp, lua);
}

// Equal graphs are one node, so this compares whole formulas.
TEST(SameScene, IsTheSameInBothLanguages) {
  const Result<Scene> fromLua = loadScene(std::string(SDF_SOURCE_DIR) + "/tests/script/same_scene.lua");
  ASSERT_TRUE(fromLua) << fromLua.error().message;
  const Scene fromCpp = sceneInCpp();
  ASSERT_EQ(fromLua->parts.size(), fromCpp.parts.size());
  for (std::size_t i = 0; i < fromCpp.parts.size(); ++i) {
    const Part &a = fromLua->parts[i], &b = fromCpp.parts[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_TRUE(a.shape.distance == b.shape.distance) << a.name;
    EXPECT_EQ(a.shape.bounds.min, b.shape.bounds.min) << a.name;
    EXPECT_EQ(a.shape.bounds.max, b.shape.bounds.max) << a.name;
    for (int v = 0; v < static_cast<int>(Attribute::MaterialId); ++v)
      EXPECT_TRUE(a.shape.surface[v] == b.shape.surface[v]) << a.name << " attribute " << v;
  }
  EXPECT_EQ(fromLua->parameters, fromCpp.parameters);
  EXPECT_TRUE(fromLua->camera.from == fromCpp.camera.from);
  EXPECT_TRUE(fromLua->camera.to == fromCpp.camera.to);
  ASSERT_EQ(fromLua->lights.size(), 1u);
  EXPECT_TRUE(fromLua->lights[0].vector == fromCpp.lights[0].vector);
}

}  // namespace same_scene_test
}  // namespace sdf
