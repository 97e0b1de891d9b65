// Tubes and struts in scenes, and the bounds of shapes.
#include <gtest/gtest.h>

#include <cmath>

#include "script/run.h"

namespace sdf::test {
namespace tubes_test {

Shape shapeOf(const std::string& text) { return sceneOf("return " + text).whole(); }
std::string whyNot(const std::string& text) { return errorOf("return " + text); }

TEST(TubeInAScene, LeadsFromPointToPoint) {
  const Shape bent = shapeOf("tube({{0, 0, 0}, {1, 0, 0}, {x = 1, y = 1, z = 0}}, 0.1)");
  EXPECT_NEAR(at(bent.distance, 0.5, 0.5, 0.0), 0.4, 1e-12);
  EXPECT_NEAR(at(bent.distance, 1.0, 2.0, 0.0), 0.9, 1e-12);
  const Shape closed = shapeOf("tube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.1, {closed = true})");
  EXPECT_NEAR(at(closed.distance, -1.0, 0.5, 0.0), 0.9, 1e-12);
  const Shape ring =
      shapeOf("tube({{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}}, 0.1, {curve = true, closed = true})");
  EXPECT_NEAR(at(ring.distance, 0.0, 0.0, 0.0), 0.9, 1e-12);
  EXPECT_NEAR(at(ring.distance, 2.0, 0.0, 2.0), std::sqrt(8.0) - 1.1, 1e-12);
  const Shape horn = shapeOf("tube({{0, 0, 0}, {0, 2, 0}}, {0.4, 0.1})");
  EXPECT_NEAR(at(horn.distance, 0.0, -1.0, 0.0), 0.6, 1e-12);
  EXPECT_NEAR(at(horn.distance, 0.0, 3.0, 0.0), 0.9, 1e-12);
}

TEST(TubeInAScene, FollowsParametersWhereItIsStraight) {
  const Scene scene = sceneOf(R"(local k = param("k", 1, {min = 0, max = 2})
      return tube({{0, 0, 0}, {k, 0, 0}}, 0.1 + 0.1 * k))");
  EXPECT_NEAR(at(scene.whole().distance, 2.0, 0.0, 0.0), 0.8, 1e-12);
  EXPECT_GE(scene.whole().bounds.max.x, 2.3 - 1e-9);
  EXPECT_NE(errorOf(R"(local k = param("k", 1) return tube({{0, 0, 0}, {k, 0, 0}}, 0.1, {curve = true}))")
                .find("number 1 of tube: point 2 must be a plain number, got a formula; value(e) gives its "
                      "present value"),
            std::string::npos);
}

TEST(TubeInAScene, SaysWhatIsWrong) {
  EXPECT_EQ(whyNot("tube(1, 0.1)"),
            "scene.lua:1: tube: the points must be a list of points {{x, y, z}, …}, got the number 1");
  EXPECT_EQ(whyNot("tube({{0, 0, 0}}, 0.1)"), "scene.lua:1: tube: it needs 2 points or more, got 1");
  EXPECT_EQ(whyNot("tube({{0, 0, 0}, {1, 0, 0}}, {0.1, 0.1}, {curve = true})"),
            "scene.lua:1: tube: along a curve the radius is one number");
  EXPECT_EQ(whyNot("tube({0, 0, 0}, 0.1)").substr(0, 73),
            "scene.lua:1: tube: point 1 must be {x, y, z}, got the number 0; write tub");
  EXPECT_NE(whyNot("tube({{0, 0, 0}, {1, 0, 0}}, {0.1, 'x'})").find("tube: radius 2 must be a number"),
            std::string::npos);
  EXPECT_NE(whyNot("tube({{0, 0, 0}, {1, 0, 0}}, 'thin')").find("tube: the radius must be a number"),
            std::string::npos);
  EXPECT_NE(whyNot("tube({{0, 0, 0}, {1, 0, 0}}, 0.1, {smooth = true})").find("smooth"), std::string::npos);
  EXPECT_NE(whyNot("tube({{0, 0, 0}, {1, 0, 0}})").find("tube"), std::string::npos);
}

TEST(TubeInAScene, IsNamedWhereItsInsideIsNotExact) {
  const Scene scene = sceneOf("return tube({{-1, 0, 0}, {0, 1, 0}, {1, 0, 0}}, 0.15):shell(0.06)");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("not exact since the tube in line 1"), std::string::npos) << scene.notes[0];
}

TEST(StrutsInAScene, JoinPairsOfPoints) {
  const Shape shape = shapeOf("struts({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2}, {1, 3}}, 0.1)");
  EXPECT_NEAR(at(shape.distance, 0.5, -0.3, 0.0), 0.2, 1e-12);
  EXPECT_NEAR(at(shape.distance, -0.3, 0.5, 0.0), 0.2, 1e-12);
  const std::string points = "struts({{0, 0, 0}, {1, 0, 0}}, ";
  EXPECT_EQ(whyNot(points + "{{1, 3}}, 0.1)"), "scene.lua:1: struts: edge 1 names point 3 of 2");
  EXPECT_EQ(whyNot(points + "{{0, 1}}, 0.1)"), "scene.lua:1: struts: edge 1 counts points from 1, got 0");
  EXPECT_EQ(whyNot(points + "{{1, 2, 1}}, 0.1)"),
            "scene.lua:1: struts: edge 1 must be a pair of points' numbers {1, 2}, got a table");
  EXPECT_EQ(whyNot(points + "{}, 0.1)"), "scene.lua:1: struts: it needs at least one edge");
  EXPECT_NE(whyNot(points + "1, 0.1)").find("struts: the edges must be a list of pairs {{1, 2}, …}"),
            std::string::npos);
}

TEST(ShapesBounds, ArePairsOfCorners) {
  EXPECT_EQ(numberOf("high[2] - low[1]", "local low, high = box(1, 2, 3):bounds()"), 3.0);
  EXPECT_EQ(numberOf("#low + high[1]", "local low, high = circle(2):bounds()"), 4.0);
  EXPECT_EQ(numberOf("high[2] == math.huge and 1 or 0", "local low, high = infinite_cylinder(1):bounds()"),
            1.0);
  EXPECT_EQ(whyNot("sphere(1):bounds(2)"),
            "scene.lua:1: bounds: write local low, high = shape:bounds(), got the number 2");
  EXPECT_EQ(whyNot("sphere(1).bounds()"),
            "scene.lua:1: bounds: write local low, high = shape:bounds(), got nothing");
}

// In every program, as the script runs again for others.
TEST(ShapesBounds, AreThoseForPresentValues) {
  const std::string text = R"(local r = param("r", 1, {min = 0.5, max = 3})
      local low, high = sphere(r):translate(time, 0, 0):bounds()
      local _, wide = box(1):bounds()
      return box(0.1):translate(high[1] + wide[1], 0, 0))";
  for (const bool fixed : {false, true}) {
    const Scene scene = sceneOf(text, {.values = {{"r", 2.0}}, .time = 0.25, .fixed = fixed});
    EXPECT_NEAR(at(scene.whole().distance, 3.25, 0.0, 0.0), -0.1, 1e-12) << fixed;
    EXPECT_EQ(scene.valuesRead.size(), fixed ? 0u : 2u);
  }
}

}  // namespace tubes_test
}  // namespace sdf::test
