// Paths and drawings in scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "script/run.h"
#include "script/scene_folder.h"

namespace sdf::test {
namespace drawing_test {

namespace fs = std::filesystem;

class Paths : public SceneFolder {
 protected:
  Paths() {
    std::ofstream(folder_ / "scenes" / "ring.svg")
        << "<svg><g transform='translate(50 50)'><path fill-rule='evenodd' d='M20 0A20 20 0 1 1-20 0 20 20 0 "
           "1 1 20 0"
           "M10 0A10 10 0 1 1-10 0 10 10 0 1 1 10 0'/></g></svg>";
    std::ofstream(folder_ / "scenes" / "two.svg")
        << "<svg><rect width='2' height='1'/><path d='M1 0V1H3V0Z'/><path d='M2.5 0.5H4V3H2.5'/></svg>";
    std::ofstream(folder_ / "scenes" / "lines.svg") << "<svg><g stroke='red' stroke-width='2'><line x2='18' "
                                                       "y2='0'/><path d='M9-9V9' fill='none'/></g></svg>";
    std::ofstream(folder_ / "outside.svg") << "<svg/>";
  }

  Shape shapeOf(const std::string& text) const { return sceneOf("return " + text).whole(); }
  std::string whyNot(const std::string& text) const { return errorOf("return " + text); }
};

TEST_F(Paths, EncloseFlatShapes) {
  const Shape half = shapeOf(R"(path("M -1 0 A 1 1 0 0 0 1 0 Z"):extrude(10))");  // the way over the top
  EXPECT_EQ(half.claim.kind, ClaimKind::Exact);
  EXPECT_NEAR(at(half.distance, 0.0, 1.5, 0.0), 0.5, 4e-6);
  EXPECT_NEAR(at(half.distance, 0.0, 0.1, 0.0), -0.1, 4e-6);
  EXPECT_NEAR(at(half.distance, 0.0, -0.5, 0.0), 0.5, 4e-6);
  EXPECT_NEAR(at(half.distance, 2.0, -1.0, 0.0), std::sqrt(2.0), 4e-6);
  const std::string squares = "\"M 0 0 H 3 V 3 H 0 Z M 1 1 H 2 V 2 H 1 Z\"";
  EXPECT_NEAR(at(shapeOf("path(" + squares + "):extrude(10)").distance, 1.5, 1.5, 0.0), -1.5, 1e-9);
  EXPECT_NEAR(at(shapeOf("path(" + squares + ", {rule = 'evenodd'}):extrude(10)").distance, 1.5, 1.5, 0.0),
              0.5, 1e-9);
}

TEST_F(Paths, DrawStrokes) {
  const auto stroke = [&](const std::string& more, double x, double y) {
    return at(shapeOf("path('M -1 0 H 1', {stroke = 0.5" + more + "}):extrude(10)").distance, x, y, 0.0);
  };
  EXPECT_NEAR(stroke("", 0.0, 1.0), 0.75, 1e-9);
  EXPECT_NEAR(stroke("", 2.0, 0.0), 0.75, 1e-9);
  EXPECT_NEAR(stroke(", cap = 'butt'", 2.0, 0.0), 1.0, 1e-9);
  EXPECT_NEAR(stroke(", cap = 'square'", 2.0, 0.0), 0.75, 1e-9);
  EXPECT_NEAR(stroke(", cap = 'square'", 1.0, 0.0), -0.25, 1e-9);
  // Dashes from -1 to -0.5 and from 0.25 to 0.75; dots at -1 and 0.
  EXPECT_NEAR(stroke(", cap = 'butt', dash = 0.5, gap = 0.75", -0.25, 0.0), 0.25, 1e-9);
  EXPECT_NEAR(stroke(", cap = 'butt', dash = 0.5, gap = 0.75", 0.5, 0.0), -0.25, 1e-9);
  EXPECT_NEAR(stroke(", cap = 'butt', dash = 0.5", 0.25, 0.0), -0.25, 1e-9);
  EXPECT_NEAR(stroke(", dash = 0, gap = 1", 0.0, 1.0), 0.75, 1e-9);
  EXPECT_NEAR(stroke(", dash = 0, gap = 1", -0.5, 0.0), 0.25, 1e-9);
  const Shape square = shapeOf("path('M -1 -1 h 2 v 2 h -2 z', {stroke = 0.5, join = 'miter'}):extrude(10)");
  EXPECT_NEAR(at(square.distance, 0.0, 0.0, 0.0), 0.75, 1e-9);
  EXPECT_NEAR(at(square.distance, 2.25, 2.25, 0.0), std::sqrt(2.0), 1e-9);
  // A cross of two lines of the width 10 / 9.
  const Shape drawing = shapeOf(R"(svg("lines.svg", {size = 10}):extrude(1))");
  EXPECT_NEAR(at(drawing.distance, 0.0, 0.0, 0.0), -std::sqrt(2.0) * 5.0 / 9.0, 1e-9);
  EXPECT_NEAR(drawing.bounds.size().x, 10.0, 1e-9);
}

TEST_F(Paths, MayLieFarFromTheOrigin) {
  const Shape square = shapeOf(R"(path("M 1e12 0 h 8 v 8 h -8 z"):extrude(10))");
  EXPECT_NEAR(at(square.distance, 1e12 + 4.0, 4.0, 0.0), -4.0, 1e-9);
  EXPECT_NEAR(at(square.distance, 1e12 - 2.0, 4.0, 0.0), 2.0, 1e-9);
}

TEST_F(Paths, AreWhatOtherFlatShapesAre) {
  for (const char* use :
       {R"(path("M 1 0 Q 2 1 1 2 Z"):revolve())", R"(box(1) - path("M 0 0 C 1 0 1 1 0 1"):extrude(2))",
        R"(path("M 0 0 H 1 V 1"):round(0.1):extrude(0.2):round(0.05):twist(40))",
        R"((circle(2) - svg("ring.svg")):extrude(0.1))",
        R"(path("M 0 0 C 1 0 1 1 0 1", {stroke = 0.1}):round(0.1):extrude(0.2):bend(1))",
        R"(svg("two.svg", {size = param("s", 1, {min = 0.5, max = 2})}):extrude(0.1):polar_repeat(5))"})
    EXPECT_EQ(whyNot(use), "none") << use;
}

TEST_F(Paths, SayWhatIsWrong) {
  EXPECT_EQ(whyNot(R"(path("M 0 0 L 1 x"))"),
            here(":1: path: the path has something else than a number at its character 11, 'x'"));
  EXPECT_EQ(whyNot(R"(path("M 0 0 L 1 1"))"), here(":1: path: it encloses no area"));
  EXPECT_EQ(whyNot(R"(path(""))"), here(":1: path: it encloses no area"));
  EXPECT_NE(whyNot(R"(path({{0, 0}}))").find("path: the path must be a string, got"), std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1 V 1", {rule = "odd"}))").find("rule"), std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1", {stroke = -1}))").find("'stroke' must be positive"),
            std::string::npos)
      << whyNot(R"(path("M 0 0 H 1", {stroke = -1}))");
  // Ends that are a ten thousandth apart, with sides that run along the ring.
  EXPECT_NE(whyNot(R"(path("M 0 0 A 1 1 0 1 1 0 0.0001", {stroke = 1, cap = "square"}))")
                .find("make a stroke a little wider"),
            std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1", {stroke = 1, join = "sharp"}))").find("join"), std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1", {stroke = 1, dash = 0}))").find("dots need a gap"),
            std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1", {stroke = 1, dash = 1e-6}))").find("more than 10,000 dashes"),
            std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1", {stroke = 1, cap = "flat"}))").find("cap"), std::string::npos);
  EXPECT_NE(whyNot(R"(path("M 0 0 H 1 V 1"))").find("is flat; extrude or revolve it"), std::string::npos);
}

// 40 units wide, about (50, -50).
TEST_F(Paths, OfDrawingsAreAsLargeAsIsSaid) {
  const Shape ring = shapeOf(R"(svg("ring.svg", {size = 2}):extrude(10))");
  for (const double angle : {0.0, 1.0, 2.5}) {
    const auto along = [&](double r) {
      return at(ring.distance, r * std::cos(angle), r * std::sin(angle), 0.0);
    };
    EXPECT_NEAR(along(1.25), 0.25, 4e-6);
    EXPECT_NEAR(along(0.75), -0.25, 4e-6);
    EXPECT_NEAR(along(0.25), 0.25, 4e-6);
  }
  EXPECT_NEAR(ring.bounds.max.x, 1.0, 4e-6);
  // Three that overlap are one; y is up. 4 units wide and 3 high.
  const Shape two = shapeOf(R"(svg("two.svg", {size = 4}):extrude(10))");
  EXPECT_NEAR(at(two.distance, -0.6, 1.0, 0.0), -0.5, 1e-5) << "within both";
  EXPECT_NEAR(at(two.distance, -1.0, 0.0, 0.0), 0.5, 1e-5);
  EXPECT_NEAR(at(two.distance, 1.25, -1.0, 0.0), -0.5, 1e-5);
}

TEST_F(Paths, OfDrawingsComeFromFiles) {
  const Result<Scene> scene = run(R"(return svg("ring.svg"):extrude(1))");
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->files.size(), 1u);
  EXPECT_EQ(fs::path(scene->files[0]).filename(), "ring.svg");
  EXPECT_NE(whyNot(R"(svg("../outside.svg"))").find("svg: '../outside.svg' lies outside"), std::string::npos);
  EXPECT_NE(whyNot(R"(svg("none.svg"))").find("none.svg': No such file or directory"), std::string::npos);
  options_.folders = {folder_ / ""};
  EXPECT_NE(whyNot(R"(svg("../outside.svg"))").find("it fills and strokes nothing"), std::string::npos);
  options_.withoutMissing = true;
  const Result<Scene> rest = run(R"(return box(1), svg("none.svg"):extrude(1))");
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->parts.size(), 1u);
  EXPECT_EQ(rest->missing.size(), 1u);
}

}  // namespace drawing_test
}  // namespace sdf::test
