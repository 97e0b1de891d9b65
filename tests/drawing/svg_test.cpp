// Drawings against the same drawn by hand.
#include "sdf/drawing/svg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>

#include "sdf/outline/path_data.h"
#include "support/folder.h"

namespace sdf {
namespace svg_test {

using glm::dvec2;

class Drawings : public testing::Test {
 protected:
  Result<std::vector<Outline>> read(const std::string& text) const {
    std::ofstream(folder_ / "a.svg", std::ios::binary) << text;
    return svgOutlines(folder_ / "a.svg");
  }
  std::vector<Outline> outlinesOf(const std::string& inside, const std::string& attributes = "") const {
    auto outlines = read("<svg xmlns='http://www.w3.org/2000/svg' " + attributes + ">" + inside + "</svg>");
    if (outlines) return std::move(*outlines);
    ADD_FAILURE() << inside << ": " << outlines.error().message;
    return {};
  }
  // Without "cannot read 'file': ".
  std::string errorOf(const std::string& text) const {
    const auto outlines = read(text);
    const std::string begin = "cannot read '" + (folder_ / "a.svg").string() + "': ";
    if (outlines) return "none";
    EXPECT_TRUE(outlines.error().message.starts_with(begin)) << outlines.error().message;
    return outlines.error().message.substr(begin.size());
  }
  // Is what an element draws what this path data does, y being up there?
  void expectPath(const std::string& inside, const std::string& data,
                  const std::string& attributes = "") const {
    const std::vector<Outline> outlines = outlinesOf(inside, attributes);
    std::vector<Contour> drawn;
    for (const Outline& o : outlines) drawn.insert(drawn.end(), o.contours.begin(), o.contours.end());
    const std::vector<Contour> expected = pathContours(data).value();
    ASSERT_EQ(drawn.size(), expected.size()) << inside;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      ASSERT_EQ(drawn[i].curves.size(), expected[i].curves.size()) << inside;
      EXPECT_LT(glm::distance(drawn[i].from, expected[i].from), 1e-9) << inside;
      for (std::size_t k = 0; k < drawn[i].curves.size(); ++k) {
        const Curve &a = drawn[i].curves[k], &b = expected[i].curves[k];
        ASSERT_EQ(a.controls, b.controls) << inside;
        EXPECT_LT(glm::distance(a.to, b.to), 1e-9) << inside;
        for (int n = 0; n < a.controls; ++n)
          EXPECT_LT(glm::distance(a.control[n], b.control[n]), 1e-9) << inside;
      }
    }
  }

  Folder folder_;
};

TEST_F(Drawings, HaveShapes) {
  expectPath("<path d='M0 0 L2 0 Q2 1 0 1 Z'/>", "M0 0 L2 0 Q2-1 0-1 Z");
  expectPath("<rect x='1' y='2' width='3' height='4'/>", "M1-2 H4 V-6 H1 V-2");
  expectPath("<rect width='4' height='3' rx='1'/>",
             "M1 0 H3 A1 1 0 0 0 4-1 V-2 A1 1 0 0 0 3-3 H1 A1 1 0 0 0 0-2 V-1 A1 1 0 0 0 1 0");
  expectPath(
      "<rect width='4' height='3' ry='9'/>",
      "M2 0 H2 A2 1.5 0 0 0 4-1.5 V-1.5 A2 1.5 0 0 0 2-3 H2 A2 1.5 0 0 0 0-1.5 V-1.5 A2 1.5 0 0 0 2 0");
  expectPath("<circle cx='1' cy='1' r='2'/>", "M3-1 A2 2 0 0 0-1-1 A2 2 0 0 0 3-1");
  expectPath("<ellipse cx='1' rx='2' ry='1'/>", "M3 0 A2 1 0 0 0-1 0 A2 1 0 0 0 3 0");
  expectPath("<polygon points='0,0 1,0 1,1'/><polyline points='2 0 3 0 3 1'/>",
             "M0 0 L1 0 L1-1 M2 0 L3 0 L3-1");
  expectPath("<rect width='1in' height='25.4mm'/>", "M0 0 H96 V-96 H0 L0 0");
  expectPath("<s:circle xmlns:s='http://www.w3.org/2000/svg' r='1'/>", "M1 0 A1 1 0 0 0-1 0 A1 1 0 0 0 1 0");
}

TEST_F(Drawings, DrawNothingWhereNothingIsFilled) {
  const std::string square = "<path d='M0 0 H1 V-1 H0'/>", hidden = "<path id='x' d='M5 5 H6 V6' ";
  for (const char* attribute :
       {"fill='none'", "style='stroke:none; fill : none'", "display='none'", "style='visibility:hidden'",
        "class='a none'", "fill='red' style='fill:transparent'"})
    expectPath("<style>.none, .other {fill:none}</style>" + square + hidden + attribute + "/>",
               "M0 0 H1 V1 H0");
  expectPath(square + "<g fill='none'><path d='M5 5 H6 V6'/></g><defs><circle r='3'/></defs><text>a</text>",
             "M0 0 H1 V1 H0");
  expectPath(square + "<circle r='0'/><rect width='2'/><path d=''/><path/><polygon/>", "M0 0 H1 V1 H0");
  expectPath("<path d='M5 5 H6 V6'/><path fill='#123' d='M0 0 H1 V-1 H0'/>", "M0 0 H1 V1 H0", "fill='none'");
  expectPath("<g fill='none'><g fill='red'>" + square + "</g></g>", "M0 0 H1 V1 H0");
  expectPath("<g fill='none'><g fill='inherit'><circle r='2'/></g></g>" + square, "M0 0 H1 V1 H0");
}

TEST_F(Drawings, HaveStrokes) {
  const std::string line = "<line x1='1' y1='2' x2='3' y2='4' ";
  const auto stroke = [&](const std::string& attributes, const std::string& around = "") {
    return outlinesOf("<g " + around + ">" + line + attributes + "/></g>").at(0).stroke.value();
  };
  const Stroke plain = stroke("stroke='red'");
  EXPECT_EQ(plain.width, 1.0);
  EXPECT_EQ(plain.join, Stroke::Join::Miter);
  EXPECT_EQ(plain.cap, Stroke::Cap::Butt);
  EXPECT_EQ(plain.miterLimit, 4.0);
  const Stroke own =
      stroke("stroke='red' style='stroke-width:2mm; stroke-linejoin:round; stroke-linecap:square'");
  EXPECT_DOUBLE_EQ(own.width, 2.0 * 96.0 / 25.4);
  EXPECT_EQ(own.join, Stroke::Join::Round);
  EXPECT_EQ(own.cap, Stroke::Cap::Square);
  const Stroke handedOn =
      stroke("", "stroke='red' stroke-width='0.5' stroke-linejoin='bevel' stroke-miterlimit='2'");
  EXPECT_EQ(handedOn.width, 0.5);
  EXPECT_EQ(handedOn.join, Stroke::Join::Bevel);
  EXPECT_EQ(handedOn.miterLimit, 2.0);
  EXPECT_DOUBLE_EQ(stroke("stroke='red'", "transform='scale(2 8)'").width, 4.0);
  const auto dashes = [&](const std::string& attributes, const std::string& around = "") {
    return stroke("stroke='red' " + attributes, around).dashes;
  };
  using Lengths = std::vector<double>;
  EXPECT_EQ(dashes("stroke-dasharray='3 1,2'"), (Lengths{3, 1, 2}));
  EXPECT_EQ(dashes("stroke-dasharray='3, 1in'"), (Lengths{3, 96}));
  EXPECT_EQ(dashes("style='stroke-dasharray:3'", "transform='scale(2 8)'"), Lengths{12});
  EXPECT_EQ(dashes("stroke-dasharray='none'"), Lengths{});
  EXPECT_EQ(dashes("stroke-dasharray='3 -1'"), Lengths{});
  EXPECT_EQ(dashes("stroke-dasharray='3 x'"), Lengths{});
  EXPECT_EQ(dashes("stroke-dasharray='none'", "stroke-dasharray='3'"), Lengths{});
  EXPECT_EQ(dashes("", "stroke-dasharray='3'"), Lengths{3});
  EXPECT_EQ(stroke("stroke='red' stroke-dashoffset='2'", "transform='scale(3)'").dashOffset, 6.0);
  // A line fills nothing; what is filled and stroked is both.
  EXPECT_EQ(errorOf("<svg>" + line + "/></svg>").substr(0, 28), "it fills and strokes nothing");
  const std::vector<Outline> both = outlinesOf("<circle r='1' stroke='red'/>");
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NE(both[0].stroke.has_value(), both[1].stroke.has_value());
  EXPECT_EQ(outlinesOf("<circle r='1' stroke='red' stroke-width='0'/>").size(), 1u);
}

// A stroke goes round what is closed, and ends where nothing closes it.
TEST_F(Drawings, KnowWhatIsClosed) {
  const auto isClosed = [&](const std::string& inside) {
    return outlinesOf("<g stroke='red' fill='none'>" + inside + "</g>").at(0).contours.at(0).isClosed;
  };
  for (const char* closed : {"<circle r='1'/>", "<ellipse rx='1' ry='2'/>", "<rect width='1' height='1'/>",
                             "<polygon points='0 0 1 0 1 1'/>", "<path d='M0 0 H1 V1 Z'/>"})
    EXPECT_TRUE(isClosed(closed)) << closed;
  for (const char* open :
       {"<line x2='1'/>", "<polyline points='0 0 1 0 1 1'/>", "<path d='M0 0 H1 V1 H0 V0'/>"})
    EXPECT_FALSE(isClosed(open)) << open;
}

TEST_F(Drawings, DoNotReadWhatIsNotDrawn) {
  const std::string square = "<path d='M0 0 H1 V-1 H0'/>", broken = "<path d='M 0 0 L x' fill='none' ";
  expectPath(square + broken + "/>", "M0 0 H1 V1 H0");
  EXPECT_NE(errorOf("<svg>" + square + broken + "stroke='red'/></svg>").find("something else than a number"),
            std::string::npos);
}

TEST_F(Drawings, HaveFillRules) {
  const auto rule = [&](const std::string& inside) { return outlinesOf(inside).at(0).rule; };
  EXPECT_EQ(rule("<circle r='1'/>"), FillRule::NonZero);
  EXPECT_EQ(rule("<circle r='1' fill-rule='evenodd'/>"), FillRule::EvenOdd);
  EXPECT_EQ(rule("<g style='fill-rule:evenodd'><circle r='1'/></g>"), FillRule::EvenOdd);
  EXPECT_EQ(rule("<style><![CDATA[.a{fill-rule:evenodd;fill:red}]]></style><circle class='a' r='1'/>"),
            FillRule::EvenOdd);
}

TEST_F(Drawings, FollowTransforms) {
  const auto line = [](const std::string& transform) {
    return "<path d='M1 0 L2 0' transform='" + transform + "'/>";
  };
  expectPath(line("translate(3)"), "M4 0 L5 0");
  expectPath(line("translate(3, -4)"), "M4 4 L5 4");
  expectPath(line("scale(2)"), "M2 0 L4 0");
  expectPath(line("rotate(90)"), "M0-1 L0-2");
  expectPath(line("rotate(90 1 0)"), "M1 0 L1-1");
  expectPath(line("matrix(0 2 -1 0 5 6)"), "M5-8 L5-10");
  expectPath(line("skewY(45)"), "M1-1 L2-2");
  expectPath(line("translate(1 0),scale(3)"), "M4 0 L7 0");
  expectPath("<path d='M0 1 L0 2' transform=' skewX( 45 ) '/>", "M1-1 L2-2");
  expectPath("<g transform='translate(1 0)'><g transform='scale(3)'><path d='M1 0 L2 0'/></g></g>",
             "M4 0 L7 0");
}

TEST_F(Drawings, UseElementsAgain) {
  const std::string defs =
      "<defs><path id='p' d='M0 0 L1 0'/><symbol id='s'><path d='M0 0 L2 0'/></symbol></defs>";
  expectPath(defs + "<use href='#p' x='1' y='2'/>", "M1-2 L2-2");
  expectPath(defs + "<use xmlns:xlink='http://www.w3.org/1999/xlink' xlink:href='#s' transform='scale(2)'/>",
             "M0 0 L4 0");
  expectPath("<svg x='1' y='1'><path d='M0 0 L1 0'/></svg>", "M1-1 L2-1");
}

TEST_F(Drawings, SayWhatIsWrong) {
  const auto svg = [](const std::string& inside) { return "<svg>" + inside + "</svg>"; };
  EXPECT_NE(errorOf("<svg>\n<g></svg>").find("it is no SVG drawing: Start-end tags mismatch in line 2"),
            std::string::npos)
      << errorOf("<svg>\n<g></svg>");
  EXPECT_NE(errorOf("plain text").find("it is no SVG drawing: "), std::string::npos);
  EXPECT_EQ(errorOf("<html/>"), "it is no SVG drawing: its outermost element is no svg");
  EXPECT_EQ(errorOf(svg("<path d='M0 0 H1' fill='none'/>")),
            "it fills and strokes nothing; make text to paths (in Inkscape: Path > Object to Path)");
  EXPECT_EQ(errorOf(svg("<path id='nose' d='M 0 0 L x'/>")),
            "path 'nose': the path has something else than a number at its character 9, 'x'");
  EXPECT_EQ(errorOf(svg("<circle r='wide'/>")), "circle: r must be a length, got \"wide\"");
  EXPECT_EQ(errorOf(svg("<rect width='50%' height='1'/>")), "rect: width must be a length, got \"50%\"");
  EXPECT_EQ(errorOf(svg("<polygon points='1 2 3'/>")),
            "polygon: points must be pairs of numbers, got \"1 2 3\"");
  EXPECT_EQ(errorOf(svg("<g transform='turn(3)'/>")), "g: transform must be a transform, got \"turn(3)\"");
  EXPECT_EQ(errorOf(svg("<use href='#none'/>")),
            "use: href must be the # and id of an element, got \"#none\"");
  EXPECT_EQ(errorOf(svg("<g id='a'><use href='#a'/></g>")),
            "its elements are more than 64 deep; ungroup some");
  std::string many;
  for (int i = 0; i < 18; ++i)
    many += "<g id='g" + std::to_string(i + 1) + "'><use href='#g" + std::to_string(i) + "'/><use href='#g" +
            std::to_string(i) + "'/></g>";
  EXPECT_EQ(errorOf(svg("<g id='g0'/>" + many)), "it has more than 200000 elements");
  std::string curves = "<path d='M0 0 L";
  for (std::size_t i = 0; i < 60'000; ++i) curves += " 1 1";
  curves += "'/>";
  EXPECT_EQ(errorOf(svg(curves + curves)), "it has more than 100000 curves; simplify its paths");
  EXPECT_NE(svgOutlines(folder_ / "none.svg").error().message.find("No such file"), std::string::npos);
}

// Bytes of a drawing that are changed at random: an outline or an error.
TEST_F(Drawings, AnyBytesAreDrawingsOrErrors) {
  const std::string whole =
      "<svg viewBox='0 0 9 9'><style>.a{fill:none;}.b{fill:red}</style><g id='g' transform='rotate(30) "
      "scale(2,3)'>"
      "<rect class='b' width='2' height='3' rx='1'/><path style='fill:red' d='M0 0c1 1 2 2 3 0a1 2 30 011 "
      "1z'/></g>"
      "<use href='#g' x='4'/><!-- c --><circle r='3mm'/></svg>";
  std::mt19937 random(11);
  for (int i = 0; i < 3000; ++i) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k)
      text[random() % text.size()] = static_cast<char>(random() % 3 ? "<>'#./ 09-"[random() % 10] : random());
    if (i % 5 == 0) text.resize(random() % text.size() + 1);
    const auto outlines = read(text);
    EXPECT_TRUE(outlines || !outlines.error().message.empty());
  }
}

}  // namespace svg_test
}  // namespace sdf
