// Text in scenes.
#include <gtest/gtest.h>

#include <filesystem>

#include "script/run.h"
#include "script/scene_folder.h"
#include "sdf/font/font_file.h"

namespace sdf::test {
namespace text_test {

namespace fs = std::filesystem;

class Texts : public SceneFolder {
 protected:
  Texts() {
    fs::copy_file(findFont("DejaVu Sans")->path, folder_ / "scenes" / "own.ttf");
    fs::copy_file(findFont("DejaVu Sans")->path, folder_ / "outside.ttf");
  }
};

// A letter l is a rectangle, in units of a 2048th from 193 to 377 and from 0 to 1556.
TEST_F(Texts, AreFlatShapesWithTheLettersDistances) {
  const Shape l = sceneOf(R"(return text("l", {size = 2.048}):extrude(10))").whole();
  EXPECT_NEAR(at(l.distance, 0.285, 0.7, 0.0), -0.092, 1e-12);
  EXPECT_NEAR(at(l.distance, 0.0, 0.7, 0.0), 0.193, 1e-12);
  EXPECT_NEAR(at(l.distance, 0.377 + 0.3, 1.556 + 0.4, 0.0), 0.5, 1e-12);
  EXPECT_EQ(l.claim.kind, ClaimKind::Exact);
  EXPECT_NEAR(l.bounds.max.y, 1.556, 1e-12);
}

TEST_F(Texts, AreWhatOtherFlatShapesAre) {
  for (const char* use :
       {R"(text("Ab"):extrude(0.1):round(0.01))", R"(text("o"):translate(2, 0):revolve())",
        R"(box(1) - text("Ab"):extrude(2))", R"(text("x"):translate(0, 2):extrude(0.1):polar_repeat(6))",
        R"((circle(2) - text("o\nx", {align = "center"})):extrude(0.1))",
        R"(text("S"):shell(0.02):extrude(0.1))"})
    EXPECT_EQ(errorOf(std::string("return ") + use), "none") << use;
}

TEST_F(Texts, ThatOverlapAreOne) {
  const Shape both = sceneOf(R"(return text("oo", {spacing = -0.5}):extrude(1))").whole();
  const Shape apart =
      sceneOf(R"(local o = text("o"); return (o | o:translate(0.11181640625, 0)):extrude(1))").whole();
  for (double x = -0.2; x < 1.0; x += 0.01) {
    const double f = at(apart.distance, x, 0.3, 0.0);
    if (f <= 0.0) continue;  // outside a union has the nearest one's distance
    EXPECT_NEAR(at(both.distance, x, 0.3, 0.0), f, 3e-5) << x;
  }
}

TEST_F(Texts, FollowSlidersInSize) {
  const std::string scene = R"(return text("l", {size = param("s", 1, {min = 0.5, max = 3})}):extrude(10))";
  options_.values["s"] = 2.048;
  EXPECT_NEAR(at(sceneOf(scene).whole().distance, 0.0, 0.7, 0.0), 0.193, 1e-12);
  EXPECT_NE(errorOf(R"(return text("l", {spacing = param("s", 1)}))").find("text: 'spacing'"),
            std::string::npos);
}

TEST_F(Texts, TakeFontsBesideTheScene) {
  const Scene scene = sceneOf(R"(return text("l", {font = "own.ttf", size = 2.048}):extrude(10))");
  EXPECT_NEAR(at(scene.whole().distance, 0.0, 0.7, 0.0), 0.193, 1e-12);
  ASSERT_EQ(scene.files.size(), 1u);
  EXPECT_EQ(fs::path(scene.files[0]).filename(), "own.ttf");
  EXPECT_NE(
      errorOf(R"(return text("l", {font = "../outside.ttf"}))").find("text: '../outside.ttf' lies outside"),
      std::string::npos);
  options_.folders = {folder_ / ""};
  EXPECT_EQ(errorOf(R"(return text("l", {font = "../outside.ttf"}):extrude(1))"), "none");
}

TEST_F(Texts, SayWhatIsWrong) {
  EXPECT_EQ(
      errorOf(R"(return text("a", {font = "None Such"}))"),
      here(
          ":1: text: this machine has no font 'None Such'; name one that fc-list shows, or a font's file, or "
          "install it"));
  EXPECT_NE(errorOf(R"(return text("a", {font = "none.ttf"}))").find("none.ttf': No such file or directory"),
            std::string::npos);
  EXPECT_EQ(errorOf(R"(return text(""))"), here(":1: text: the text is empty; write some"));
  EXPECT_EQ(errorOf(R"(return text("a\xff"))"),
            here(":1: text: the text is no UTF-8 at its byte 2; save the scene as UTF-8"));
  EXPECT_NE(errorOf(R"(return text(5))").find("text: the text must be a string, got"), std::string::npos);
  EXPECT_NE(errorOf(R"(return text("a", {size = -1}))").find("'size' must be positive"), std::string::npos);
  EXPECT_NE(errorOf(R"(return text("a", {align = "middle"}))").find("align"), std::string::npos);
  EXPECT_NE(errorOf(R"(part("t", text("a")))").find("is flat; extrude or revolve it"), std::string::npos);
}

// The same text is one node as long as a scene with it lives.
TEST_F(Texts, AreTheSameNodeAgain) {
  const std::string text = R"(return text("Again"):extrude(1))";
  const Scene first = sceneOf(text), second = sceneOf(text);
  EXPECT_EQ(first.whole().distance, second.whole().distance);
}

// As with meshes: the rest of a scene is made without what is missing.
TEST_F(Texts, ThatCannotBeHadMayBeLeftOut) {
  options_.withoutMissing = true;
  const Scene scene = sceneOf(R"(return box(1), text("a", {font = "none.ttf"}):extrude(1))");
  EXPECT_EQ(scene.parts.size(), 1u);
  EXPECT_EQ(scene.missing.size(), 1u);
}

}  // namespace text_test
}  // namespace sdf::test
