// Path data against what SVG's specification says of it.
#include "sdf/outline/path_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "outline/curves.h"
#include "sdf/outline/ellipse_arc.h"

namespace sdf {
namespace path_data_test {

using glm::dvec2;

std::vector<Contour> contoursOf(const std::string& data) {
  Result<std::vector<Contour>> contours = pathContours(data);
  if (contours) return std::move(*contours);
  ADD_FAILURE() << data << ": " << contours.error().message;
  return {};
}

std::string errorOf(const std::string& data) {
  const auto contours = pathContours(data);
  return contours ? "none" : contours.error().message;
}

// Each contour's start, and its curves' points after it.
std::vector<std::vector<dvec2>> placesOf(const std::string& data) {
  std::vector<std::vector<dvec2>> places;
  for (const Contour& contour : contoursOf(data)) {
    places.push_back({contour.from});
    for (const Curve& c : contour.curves) {
      for (int i = 0; i < c.controls; ++i) places.back().push_back(c.control[i]);
      places.back().push_back(c.to);
    }
  }
  return places;
}
using Places = std::vector<std::vector<dvec2>>;

TEST(PathData, LinesGoToPlacesOrByWays) {
  const Places square{{{1, 1}, {3, 1}, {3, 4}, {1, 4}}};
  for (const char* data :
       {"M 1 1 L 3 1 L 3 4 L 1 4 Z", "M1,1L3,1,3,4,1,4z", "m 1 1 l 2 0 l 0 3 l -2 0 z", "M1 1H3V4H1Z",
        "m1 1h2v3h-2", "M 1 1 3 1 3 4 1 4", "m1+1 2-0 0 3-2,0", "\n M\t1e0 ,.1E1 L 3. 1 30e-1 4 1 +4"})
    EXPECT_EQ(placesOf(data), square) << data;
}

TEST(PathData, NumbersNeedNothingBetweenThemThatTellsThemApart) {
  EXPECT_EQ(placesOf("M-1-2L.5.25-.5-.25"), (Places{{{-1, -2}, {0.5, 0.25}, {-0.5, -0.25}}}));
}

TEST(PathData, ContoursBeginWhereTheLastOneWasClosed) {
  EXPECT_EQ(placesOf("M 1 1 l 1 0 0 1 z l -1 0 0 -1 z m 5 5 l 1 0 0 1"),
            (Places{{{1, 1}, {2, 1}, {2, 2}}, {{1, 1}, {0, 1}, {0, 0}}, {{6, 6}, {7, 6}, {7, 7}}}));
  EXPECT_TRUE(contoursOf("M 1 2 M 3 4 Z").empty()) << "nothing is drawn";
  EXPECT_TRUE(contoursOf(" ").empty());
}

TEST(PathData, CurvesHaveTheirControlPoints) {
  EXPECT_EQ(placesOf("M1 1 C2 1 3 2 3 3 Q3 5 1 5"),
            (Places{{{1, 1}, {2, 1}, {3, 2}, {3, 3}, {3, 5}, {1, 5}}}));
  EXPECT_EQ(placesOf("m1 1 c1 0 2 1 2 2 q0 2-2 2"), placesOf("M1 1 C2 1 3 2 3 3 Q3 5 1 5"));
}

TEST(PathData, SmoothCurvesTurnTheLastControlPointAround) {
  EXPECT_EQ(placesOf("M0 0 C0 1 1 2 2 2 S4 1 4 0"), placesOf("M0 0 C0 1 1 2 2 2 C3 2 4 1 4 0"));
  EXPECT_EQ(placesOf("M0 0 c0 1 1 2 2 2 s2-1 2-2"), placesOf("M0 0 C0 1 1 2 2 2 C3 2 4 1 4 0"));
  EXPECT_EQ(placesOf("M0 0 Q1 2 2 0 T4 0 6 0"), placesOf("M0 0 Q1 2 2 0 Q3-2 4 0 Q5 2 6 0"));
  // There is none after another command.
  EXPECT_EQ(placesOf("M0 0 L1 1 S4 1 4 0"), placesOf("M0 0 L1 1 C1 1 4 1 4 0"));
  EXPECT_EQ(placesOf("M0 0 C0 1 1 2 2 2 T4 0"), placesOf("M0 0 C0 1 1 2 2 2 Q2 2 4 0"));
}

TEST(PathData, ArcsAreThoseOfTheirEllipse) {
  struct Case {
    const char* data;
    dvec2 centre, through;
  };
  for (const Case& c :
       {Case{"M1 0 A1 1 0 0 1-1 0", {0, 0}, {0, 1}}, Case{"M1 0 A1 1 0 0 0-1 0", {0, 0}, {0, -1}},
        Case{"M1 0 a1 1 0 01-1 1", {0, 0}, {std::sqrt(0.5), std::sqrt(0.5)}},
        Case{"M1 0 A1 1 0 10 0 1", {0, 0}, {-std::sqrt(0.5), -std::sqrt(0.5)}},
        Case{"M1 0 A1 1 0 11 0 1", {1, 1}, {1 + std::sqrt(0.5), 1 + std::sqrt(0.5)}},
        Case{"M0 0 A.1.1 0 0 0 2 0", {1, 0}, {1, 1}}}) {
    const std::vector<Contour> contours = contoursOf(c.data);
    ASSERT_EQ(contours.size(), 1u) << c.data;
    double nearest = HUGE_VAL;
    const std::size_t count = contours[0].curves.size() * 64;
    const std::vector<dvec2> points = test::pointsOf(contours[0], 64);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(glm::distance(points[i], c.centre), 1.0, 1e-7) << c.data;
      nearest = std::min(nearest, glm::distance(points[i], c.through));
    }
    EXPECT_LT(nearest, 0.01) << c.data;
  }
  EXPECT_EQ(placesOf("M0 0 A0 1 0 0 1 2 0"), placesOf("M0 0 L2 0")) << "without a radius a line";
  EXPECT_TRUE(contoursOf("M1 1 A1 1 0 0 1 1 1").empty()) << "nor one to where it begins";
}

// Random ellipses: all points are on one, and the ends are met.
TEST(PathData, ArcsMayBeTurned) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  for (int i = 0; i < 500; ++i) {
    const dvec2 from(number(random), number(random));
    const EllipseArc arc{{0.1 + std::abs(number(random)), 0.1 + std::abs(number(random))},
                         90.0 * number(random),
                         random() % 2 == 0,
                         random() % 2 == 0,
                         {number(random), number(random)}};
    const Contour contour{from, curvesOf(from, arc)};
    ASSERT_EQ(contour.curves.back().to, arc.to);
    const double turn = arc.turn * std::numbers::pi / 180.0;
    const auto straight = [&](const dvec2& p) {
      return dvec2(std::cos(turn) * p.x + std::sin(turn) * p.y,
                   -std::sin(turn) * p.x + std::cos(turn) * p.y) /
             arc.radii;
    };
    // The circle through three of the points has all of them.
    const std::vector<dvec2> all = test::pointsOf(contour, 8);
    const std::size_t count = contour.curves.size() * 8;
    const dvec2 a = straight(all[0]), b = straight(all[count / 2]), c = straight(contour.curves.back().to);
    const dvec2 u = b - a, v = c - a;
    const double cross = 2.0 * (u.x * v.y - u.y * v.x), uu = glm::dot(u, u), vv = glm::dot(v, v);
    const dvec2 centre = a + dvec2(v.y * uu - u.y * vv, u.x * vv - v.x * uu) / cross;
    const double radius = glm::distance(centre, a);
    EXPECT_GE(radius, 1.0 - 1e-6);
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NEAR(glm::distance(straight(all[k]), centre), radius, 1e-5 * radius) << i;
    // The flags say how far it turns, and which way.
    double turned = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const dvec2 p = straight(all[k]) - centre, q = (k + 1 == count ? c : straight(all[k + 1])) - centre;
      turned += std::atan2(p.x * q.y - p.y * q.x, glm::dot(p, q));
    }
    EXPECT_EQ(turned > 0.0, arc.isPositive) << i;
    if (radius < 1.0 + 1e-6) {
      EXPECT_EQ(std::abs(turned) > std::numbers::pi, arc.isLarge) << i;
    }
  }
}

TEST(PathData, SaysWhatIsWrongAndWhere) {
  const std::pair<const char*, const char*> cases[] = {
      {"L 1 1", "the path must begin with M, the place where it starts"},
      {"z", "the path must begin with M, the place where it starts"},
      {"M 1", "the path has something else than a number at its end"},
      {"M 1 1 L 2 x", "the path has something else than a number at its character 11, 'x'"},
      {"M 1 1 B 2", "the path has something else than a command or a number at its character 7, 'B 2'"},
      {"1 1",
       "the path has something else than a command, one of M L H V C S Q T A Z, at its character 1, '1 1'"},
      {"M 0 0 A 1 1 0 2 0 1 1",
       "the path has something else than a flag, 0 or 1, at its character 15, '2 0 1 1'"},
      {"M 0 0 L inf 1", "the path has something else than a number at its character 9, 'inf 1'"},
      {"M 0 0 L 1e999 1", "the path has something else than a number at its character 9, '1e999 1'"},
      {"M 0 0 L 1 1,", "the path has something else than a command or a number at its character 12, ','"},
      {"M 0 0 Z 1 1",
       "the path has something else than a command, one of M L H V C S Q T A Z, at its character 9, '1 1'"}};
  for (const auto& [data, message] : cases) EXPECT_EQ(errorOf(data), message) << data;
  std::string many = "M 0 0 L";
  for (std::size_t i = 0; i <= kMostCurves; ++i) many += " 1 1";
  EXPECT_EQ(errorOf(many), "the path has more than 100000 curves; simplify it");
}

TEST(PathData, AnyBytesArePathsOrErrors) {
  std::mt19937 random(3);
  const std::string letters = "MmLlHhVvCcSsQqTtAaZz0123456789.-+eE, \n\x01\xff";
  for (int i = 0; i < 20'000; ++i) {
    std::string data = i % 2 ? "M 1 2 " : "";
    for (std::size_t k = random() % 40; k > 0; --k) data += letters[random() % letters.size()];
    const auto contours = pathContours(data);
    if (!contours) {
      EXPECT_FALSE(contours.error().message.empty());
      continue;
    }
    for (const Contour& c : *contours) EXPECT_FALSE(c.curves.empty()) << data;
  }
}

}  // namespace path_data_test
}  // namespace sdf
