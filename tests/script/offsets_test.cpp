// What a scene says of offsets and blends of shapes whose distance is not exact.
#include <gtest/gtest.h>

#include "script/run.h"

namespace sdf::script_offsets_test {

const std::string kCure = "; use exact shapes there, or change the parts before they are combined";

TEST(OffsetNotes, SayByHowMuchAndWhere) {
  // The cube of a ball's formula has no gradient on its surface; |f| is 0.1 where p is sqrt(1 + 0.1^(1/3)).
  const Scene scene = sceneOf(
      "local b = {bounds = {{-2, -2, -2}, {2, 2, 2}}}\n"
      "local s = field(function(x, y, z) local a = x*x + y*y + z*z - 1 return a*a*a end, b)\n"
      "return s:round(0.1)");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0],
            "scene.lua:3: round: the surface is 0.21 away where it should be 0.1, for the distance is "
            "not exact since the field in line 2" +
                kCure);
}

TEST(OffsetNotes, ComeOncePerCall) {
  const Scene scene = sceneOf(
      "local function grown(r) return ellipsoid_bound(r, 0.5 * r, 0.3 * r):round(0.1) end\n"
      "for i = 1, 5 do part('p' .. i, grown(i):translate(20 * i, 0, 0)) end");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_TRUE(scene.notes[0].starts_with("scene.lua:1: round: the surface is 0.1 to 0.2")) << scene.notes[0];
  EXPECT_NE(scene.notes[0].find("since the ellipsoid_bound in line 1"), std::string::npos) << scene.notes[0];
}

TEST(OffsetNotes, NameTheBlendThatReadsAField) {
  const Scene scene = sceneOf(
      "local s = field(function(x, y, z) local a = x*x + y*y + z*z - 1 return a*a*a end,\n"
      "  {bounds = {{-2, -2, -2}, {2, 2, 2}}})\n"
      "return union{s, box(1, 0.2, 1), k = 0.2}");
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_TRUE(
      scene.notes[0].starts_with("scene.lua:3: union: what it blends is 0.21 away where it "
                                 "should be 0.1"))
      << scene.notes[0];
}

TEST(OffsetNotes, AreNoneWhereOffsetsAreRight) {
  for (const char* text :
       {"return sphere(1):round(0.1)", "return (box(1) | sphere(1.2)):round(0.1):shell(0.02)",
        "return (box(1) - cylinder(0.5, 2)):round(0.1)", "return (sphere(1) & box(0.8)):shell(0.1)",
        "return field(function(x, y, z) return x^4 + y^4 + z^4 - 1 end,\n"
        "  {bounds = {{-1, -1, -1}, {1, 1, 1}}}):shell(0.1) & plane({0, 0, -1}, 0)",
        "local wedge = intersection{plane({0, 1, 0}, 0), plane({1, -1, 0}, 0), plane({-1, -1, 0}, 2),\n"
        "  box(5, 5, 1)} return wedge:round(0.3)",
        "return union{sphere(1), box(1, 0.2, 1), k = 0.2}"})
    for (const std::string& note : sceneOf(text).notes) ADD_FAILURE() << text << ": " << note;
}

// At the values that parameters have.
TEST(OffsetNotes, FollowTheParameters) {
  const std::string text =
      "local k = param('k', 1, {min = 0.25, max = 1})\n"
      "local s = field(function(x, y, z) return k * (sqrt(x*x + y*y + z*z) - 1) end, {lipschitz = 1})\n"
      "return s:round(0.1)";
  EXPECT_TRUE(sceneOf(text).notes.empty());
  ScriptOptions options;
  options.values = {{"k", 0.25}};
  const Scene scene = sceneOf(text, options);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_TRUE(scene.notes[0].starts_with("scene.lua:3: round: the surface is 0.4 away")) << scene.notes[0];
}

TEST(FieldNotes, NameWhatIsSteeperThanStated) {
  const auto heart = [](const std::string& lipschitz) {
    return sceneOf(
               "return field(function(x, y, z) local a = x*x + 2.25*z*z + y*y - 1\n"
               "return a*a*a - x*x*y*y*y - 0.1125*z*z*y*y*y end,\n"
               "{bounds = {{-1.6, -1.6, -1.2}, {1.6, 1.6, 1.2}}" +
               lipschitz + "})")
        .notes;
  };
  EXPECT_TRUE(heart("").empty());
  EXPECT_TRUE(heart(", lipschitz = 2000").empty());
  const std::vector<std::string> notes = heart(", lipschitz = 8");
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(notes[0].starts_with("scene.lua:1: field: the formula's slope is ")) << notes[0];
  EXPECT_NE(notes[0].find("more than the lipschitz of 8 that is stated: parts of it may be missing; state a "
                          "larger one, or leave it out"),
            std::string::npos)
      << notes[0];
}

// Of a call that runs often it is said once, and of a parameter only where no value makes it true.
TEST(FieldNotes, AreOneForACallAndHoldForAllValues) {
  EXPECT_EQ(
      sceneOf("for i = 1, 3 do part('p' .. i, field(function(x, y, z) return 2 * (x*x + y*y + z*z - i) end, "
              "{lipschitz = 1, bounds = {{-2, -2, -2}, {2, 2, 2}}})) end")
          .notes.size(),
      1u);
  EXPECT_TRUE(sceneOf("local k = param('k', 3, {min = 0.1, max = 9})\n"
                      "return field(function(x, y, z) return k * (x*x + y*y + z*z - 1) end, "
                      "{lipschitz = 1, bounds = {{-2, -2, -2}, {2, 2, 2}}})")
                  .notes.empty());
}

}  // namespace sdf::script_offsets_test
