// Text as outlines against what is known of the font: DejaVu Sans has 2048 units to its size.
#include "sdf/font/text_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "sdf/outline/side_tree.h"
#include "support/folder.h"

namespace sdf {
namespace text_outline_test {

constexpr double kUnit = 1.0 / 2048.0;

const FontFile& sans() {
  static const FontFile font = findFont("DejaVu Sans").value();
  return font;
}

Outline outlineOf(const std::string& text, const TextStyle& style = {}) {
  Result<Outline> outline = textOutline(text, sans(), style);
  if (outline) return std::move(*outline);
  ADD_FAILURE() << outline.error().message;
  return {};
}

std::string errorOf(const std::string& text, const FontFile& font = sans()) {
  const Result<Outline> outline = textOutline(text, font);
  return outline ? "none" : outline.error().message;
}

// Of the points on the curves alone.
Rectangle boxOf(const Contour& contour) {
  Rectangle box;
  box.add(contour.from);
  for (const Curve& c : contour.curves) box.add(c.to);
  return box;
}
Rectangle boxOf(const Outline& outline) {
  Rectangle box;
  for (const Contour& c : outline.contours) box.add(boxOf(c));
  return box;
}

void expectBox(const Rectangle& box, double left, double bottom, double right, double top) {
  EXPECT_NEAR(box.lo.x, left * kUnit, 1e-12);
  EXPECT_NEAR(box.lo.y, bottom * kUnit, 1e-12);
  EXPECT_NEAR(box.hi.x, right * kUnit, 1e-12);
  EXPECT_NEAR(box.hi.y, top * kUnit, 1e-12);
}

TEST(TextOutline, HasTheContoursOfItsLetters) {
  EXPECT_EQ(outlineOf("l").contours.size(), 1u);
  EXPECT_EQ(outlineOf("i").contours.size(), 2u);
  EXPECT_EQ(outlineOf("B").contours.size(), 3u);
  EXPECT_EQ(outlineOf("l i B").contours.size(), 6u);
  EXPECT_EQ(outlineOf("l").contours[0].curves.size(), 4u);
}

TEST(TextOutline, IsInSizesOfTheFont) {
  expectBox(boxOf(outlineOf("l")), 193, 0, 377, 1556);
  expectBox(boxOf(outlineOf("H")), 201, 0, 1339, 1493);
}

// A letter l is 569 units wide.
TEST(TextOutline, GoesOnByTheWidthsOfItsLetters) {
  const Outline three = outlineOf("lll");
  ASSERT_EQ(three.contours.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(boxOf(three.contours[i]).lo.x, (193 + 569 * i) * kUnit, 1e-12);
  TextStyle spaced;
  spaced.spacing = 0.25;
  const Outline wide = outlineOf("lll", spaced);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(boxOf(wide.contours[i]).lo.x, (193 + 569 * i) * kUnit + 0.25 * i, 1e-12);
}

TEST(TextOutline, IsAlignedByItsLines) {
  TextStyle style;
  style.align = TextStyle::Align::Right;
  Outline lines = outlineOf("l\nll", style);
  ASSERT_EQ(lines.contours.size(), 3u);
  EXPECT_NEAR(boxOf(lines.contours[0]).lo.x, (193 - 569) * kUnit, 1e-12);
  EXPECT_NEAR(boxOf(lines.contours[1]).lo.x, (193 - 2 * 569) * kUnit, 1e-12);
  style.align = TextStyle::Align::Center, style.spacing = 0.5;
  lines = outlineOf("l\nll", style);
  EXPECT_NEAR(boxOf(lines.contours[0]).lo.x, (193 - 569 / 2.0) * kUnit, 1e-12);
  EXPECT_NEAR(boxOf(lines.contours[1]).lo.x, (193 - 569) * kUnit - 0.25, 1e-12);
}

// Its lines are 2384 units apart.
TEST(TextOutline, HasItsLinesBelowEachOther) {
  TextStyle style;
  style.lineSpacing = 1.5;
  EXPECT_NEAR(boxOf(outlineOf("l\nl").contours[1]).lo.y, -2384 * kUnit, 1e-12);
  EXPECT_NEAR(boxOf(outlineOf("l\n\nl", style).contours[1]).lo.y, -3.0 * 2384 * kUnit, 1e-12);
  EXPECT_EQ(outlineOf("l\n").contours.size(), 1u);
}

TEST(TextOutline, IsKerned) {
  const double apart = boxOf(outlineOf("AV")).hi.x - boxOf(outlineOf("A")).lo.x;
  const double alone = boxOf(outlineOf("AA")).hi.x - boxOf(outlineOf("A")).lo.x;
  EXPECT_NEAR(boxOf(outlineOf("A")).hi.x, boxOf(outlineOf("V")).hi.x, 1e-12);
  EXPECT_LT(apart, alone - 0.03);
}

TEST(TextOutline, HasLigaturesUnlessItIsSpaced) {
  TextStyle spaced;
  spaced.spacing = 1e-9;
  const Outline joined = outlineOf("ffi"), apart = outlineOf("ffi", spaced);
  EXPECT_EQ(apart.contours.size(), 4u);
  EXPECT_LT(joined.contours.size(), 4u);
}

// Of these two the first stands on the right.
TEST(TextOutline, RunsInTheDirectionOfItsScript) {
  const Outline both = outlineOf("אב"), second = outlineOf("ב");
  EXPECT_EQ(boxOf(both.contours[0]).hi.x, boxOf(second.contours[0]).hi.x);
  EXPECT_GT(boxOf(both).hi.x, boxOf(second).hi.x + 0.4);
}

TEST(TextOutline, TakesLettersOfAllLengths) {
  EXPECT_GT(outlineOf("ÄΩЖ€").contours.size(), 4u);
  EXPECT_EQ(outlineOf("\xF0\x9D\x94\xB8").contours.size(), outlineOf("𝔸").contours.size());
}

TEST(TextOutline, SaysWhatIsWrongWithTheText) {
  EXPECT_EQ(errorOf(""), "the text is empty; write some");
  EXPECT_EQ(errorOf(" \n "), "the text has nothing to be seen; write letters");
  EXPECT_EQ(errorOf("ab\xFF"), "the text is no UTF-8 at its byte 3; save the scene as UTF-8");
  EXPECT_EQ(
      errorOf("a\tb"),
      "the text has the control character (U+0009); of those only \"\\n\" is taken, which begins a line");
  EXPECT_EQ(errorOf("a\nb字"),
            "the font DejaVuSans.ttf has no letter '字' (U+5B57), in line 2 of the text; choose a font that "
            "has it");
  EXPECT_EQ(errorOf(std::string(20'001, 'a')),
            "the text has 20001 bytes, and up to 20000 are taken; write it in several");
}

TEST(Fonts, AreFoundByTheirFamilies) {
  const auto bold = findFont("dejavu sans:bold");
  ASSERT_TRUE(bold.ok());
  EXPECT_EQ(bold->path.filename(), "DejaVuSans-Bold.ttf");
  EXPECT_EQ(sans().path.filename(), "DejaVuSans.ttf");
  for (const std::string family : {"No Such Family", "", ":bold", "::", ":::=,"})
    EXPECT_EQ(findFont(family).error().message,
              "this machine has no font '" + family +
                  "'; name one that fc-list shows, or a font's file, or install it");
}

TEST(Fonts, AreFilesByTheirExtensions) {
  for (const char* name : {"a.ttf", "b/c.OTF", "x.woff2", "d.ttc"}) EXPECT_TRUE(isFontFile(name));
  for (const char* name : {"DejaVu Sans", "ttf", "a.txt", ""}) EXPECT_FALSE(isFontFile(name));
}

class FontFiles : public testing::Test {
 protected:
  FontFile fileOf(const std::string& bytes) {
    const FontFile file{folder_ / "font.ttf", 0};
    std::ofstream(file.path, std::ios::binary) << bytes;
    return file;
  }
  static std::string bytesOfSans() {
    std::ostringstream bytes;
    bytes << std::ifstream(sans().path, std::ios::binary).rdbuf();
    return bytes.str();
  }
  std::string path() { return (folder_ / "font.ttf").string(); }
  Folder folder_;
};

TEST_F(FontFiles, ThatAreNoneAreNamed) {
  EXPECT_EQ(errorOf("a", fileOf("no font at all, but some text")),
            "cannot read '" + path() + "': it is no font, or a broken one; choose another");
  EXPECT_EQ(errorOf("a", fileOf("")), "cannot read '" + path() + "': it is empty");
  EXPECT_EQ(errorOf("a", {folder_ / "none.ttf", 0}), "cannot read '" + (folder_ / "none.ttf").string() +
                                                         "': No such file or directory; check its name");
}

// A font of points, as they were before outlines.
TEST_F(FontFiles, OfBitmapsAreRefused) {
  const std::string bdf =
      "STARTFONT 2.1\nFONT -x-x-medium-r-normal--8-80-75-75-c-80-iso10646-1\nSIZE 8 75 75\n"
      "FONTBOUNDINGBOX 8 8 0 0\nSTARTPROPERTIES 2\nFONT_ASCENT 8\nFONT_DESCENT 0\nENDPROPERTIES\nCHARS 1\n"
      "STARTCHAR a\nENCODING 97\nSWIDTH 500 0\nDWIDTH 8 0\nBBX 8 1 0 0\nBITMAP\nFF\nENDCHAR\nENDFONT\n";
  EXPECT_EQ(errorOf("a", fileOf(bdf)),
            "cannot read '" + path() +
                "': it is no TrueType or OpenType font with outlines; choose one that has them");
}

// What is cut off or changed anywhere gives an outline or an error.
TEST_F(FontFiles, ThatAreBrokenEndInAnErrorOrAnOutline) {
  const std::string whole = bytesOfSans();
  std::mt19937 random(1);
  int errors = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    if (i % 3 == 0) bytes.resize(1 + random() % whole.size());
    if (i % 3 != 0)
      for (int k = 0; k < 3000; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 3 == 2)
      for (int k = 0; k < 4; ++k) bytes[random() % 300] = static_cast<char>(random());
    const auto outline = textOutline("Quick AV fi\nאב", fileOf(bytes));
    errors += !outline.ok();
    EXPECT_TRUE(outline || !outline.error().message.empty());
  }
  EXPECT_GT(errors, 10);
}

}  // namespace text_outline_test
}  // namespace sdf
