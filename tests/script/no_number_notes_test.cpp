// What a scene says of formulas that are no numbers.
#include <gtest/gtest.h>

#include "script/run.h"

namespace sdf::no_number_notes_test {

// A dome by its height, in a cylinder that is wider: a maximum hides there what is no number.
TEST(NoNumberNotes, NameTheFormulaAndThePlace) {
  const Scene scene = sceneOf(
      "local dome = field(function(x, y, z)\n"
      "  return y - sqrt(1 - x*x - z*z) end, {bounds = {{-2, -1, -2}, {2, 2, 2}}})\n"
      "part('dome', dome & cylinder(1.5, 1))");
  ASSERT_EQ(scene.notes.size(), 1u);
  const std::string& note = scene.notes[0];
  EXPECT_TRUE(note.starts_with("part 'dome': the formula at scene.lua:2 is no number at (")) << note;
  EXPECT_NE(note.find("Let it be a number everywhere within the bounds, as by sqrt(max(a, 0))"),
            std::string::npos)
      << note;
}

TEST(NoNumberNotes, AreNotMadeOfNumbers) {
  EXPECT_TRUE(sceneOf("return field(function(x, y, z) return y - sqrt(max(1 - x*x - z*z, 0)) end, "
                      "{bounds = {{-2, -1, -2}, {2, 2, 2}}})")
                  .notes.empty());
  EXPECT_TRUE(sceneOf("return sphere(1):twist(30):round(0.1) | torus(2, 0.3)").notes.empty());
}

TEST(NoNumberNotes, GoByPresentValues) {
  const std::string text =
      "local k = param('k', 4, {min = 0, max = 4})\n"
      "return field(function(x, y, z) return y - sqrt(x + k) end, {bounds = {{-2, -1, -2}, {2, 2, 2}}})";
  EXPECT_TRUE(sceneOf(text).notes.empty());
  EXPECT_EQ(sceneOf(text, {.values = {{"k", 1.0}}}).notes.size(), 1u);
}

}  // namespace sdf::no_number_notes_test
