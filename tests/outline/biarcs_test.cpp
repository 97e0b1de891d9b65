// Curves as arcs against points of the curves.
#include "sdf/outline/biarcs.h"

#include <gtest/gtest.h>

#include "outline/curves.h"

namespace sdf {
namespace biarcs_test {

using glm::dvec2;

double distanceTo(const std::vector<Arc>& arcs, const dvec2& p) {
  double least = HUGE_VAL;
  for (const Arc& arc : arcs) least = std::min(least, arc.placeOf(p).squared());
  return std::sqrt(least);
}

double distanceTo(const std::vector<dvec2>& points, const dvec2& p) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i] == points[i + 1]) continue;
    least = std::min(least, Arc::through({points[i]}, points[i + 1]).placeOf(p).squared());
  }
  return std::sqrt(least);
}

// Both ways: no arc strays from the curve, and no part of the curve is left out.
TEST(Biarcs, AreWithinTheToleranceOfTheCurve) {
  std::mt19937 random(1);
  for (const double tolerance : {1e-2, 1e-4, 1e-6})
    for (int i = 0; i < 20; ++i) {
      Contour contour = test::randomContour(random, 3);
      contour.curves.back().to = contour.from;
      const std::vector<Arc> arcs = arcsOf(arcContours({{contour}}, tolerance));
      for (const dvec2& p : test::pointsOf(contour, 500)) ASSERT_LE(distanceTo(arcs, p), tolerance) << i;
      // Chords of so many are off by 1e-7.
      const std::vector<dvec2> curve = test::pointsOf(contour, 4000);
      for (std::size_t k = 0; k < arcs.size(); k += 1 + arcs.size() / 50)
        for (const dvec2& p : test::pointsOf(arcs[k], 4))
          ASSERT_LE(distanceTo(curve, p), tolerance + 4e-7) << i;
    }
}

TEST(Biarcs, OnlyRiseOrOnlyFallAndTurnByLess) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i)
    for (const Arc& arc : arcsOf(arcContours({{test::randomContour(random, 4)}}, 1e-4))) {
      EXPECT_GE(arc.along.y * arc.alongTo.y, -1e-12);
      EXPECT_LT(std::abs(arc.size * arc.curvature), 3.1);
    }
}

// A smooth curve gets no corners, which meshes would show.
TEST(Biarcs, TurnNowhereWhereTheCurveDoesNot) {
  for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
    const auto contours = arcContours({{test::roundContour({0.3, -0.2}, 1.0)}}, tolerance);
    const std::vector<Arc> arcs = arcsOf(contours);
    for (std::size_t i = 0; i < arcs.size(); ++i)
      EXPECT_NEAR(glm::distance(arcs[i].alongTo, arcs[(i + 1) % arcs.size()].along), 0.0, 1e-9);
  }
}

TEST(Biarcs, AreFew) {
  std::size_t before = 0;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const std::size_t count = arcsOf(arcContours({{test::roundContour({}, 1.0)}}, tolerance)).size();
    EXPECT_LE(count, 40.0 * std::cbrt(1e-3 / tolerance));
    EXPECT_GT(count, before);
    before = count;
  }
}

TEST(Biarcs, OfStraightCurvesAreSegments) {
  const Contour contour{{0, 0}, {{1, {{1, 0}}, {2, 0}}, {2, {{2, 1}, {2, 2}}, {2, 3}}, {0, {}, {0, 0}}}};
  const auto contours = arcContours({{contour}}, 1e-6);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_EQ(contours[0], (ArcContour{{{0, 0}}, {{2, 0}}, {{2, 3}}}));
}

// Cusps, curves that come back on themselves, control points on ends.
TEST(Biarcs, OfDegenerateCurvesEnd) {
  const std::vector<Curve> hard{{2, {{1, 1}, {0, 1}}, {1, 0}},  {1, {{3, 0}}, {1, 0}},
                                {2, {{3, 0}, {-2, 0}}, {1, 0}}, {2, {{0, 0}, {1, 0}}, {1, 0}},
                                {2, {{0, 0}, {0, 0}}, {0, 0}},  {2, {{2, 2}, {-2, 2}}, {0, 0}},
                                {1, {{1, 1}}, {0, 0}}};
  for (const Curve& c : hard) {
    const Contour contour{{0, 0}, {c}};
    const std::vector<Arc> arcs = arcsOf(arcContours({{contour}}, 1e-6));
    EXPECT_LT(arcs.size(), 2000u);
    if (arcs.empty()) continue;
    for (const dvec2& p : test::pointsOf(contour, 1000)) EXPECT_LE(distanceTo(arcs, p), 4e-6);
  }
}

}  // namespace biarcs_test
}  // namespace sdf
