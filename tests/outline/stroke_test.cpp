// Strokes against the distance to the lines that they are drawn along.
#include "sdf/outline/stroke.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "outline/curves.h"
#include "sdf/outline/biarcs.h"
#include "sdf/outline/boundary.h"

namespace sdf::test {
namespace stroke_test {

using glm::dvec2;

constexpr double kTolerance = 1e-6;

// What a stroke covers, by the winding number of its border.
class Covered {
 public:
  explicit Covered(const Outline& outline)
      : arcs_(arcsOf(boundaryOf(arcContours(outline, kTolerance), FillRule::NonZero).value())),
        tree_(treeOf(arcs_)) {}
  bool has(const dvec2& p) const { return windingNumber(arcs_, tree_, p) != 0; }
  // By Green's theorem along points of the arcs.
  double area() const {
    double twice = 0.0;
    for (const Arc& arc : arcs_) {
      const std::vector<dvec2> points = pointsOf(arc, 64);
      for (std::size_t i = 1; i < points.size(); ++i) twice += crossOf(points[i - 1], points[i]);
    }
    return 0.5 * twice;
  }

 private:
  std::vector<Arc> arcs_;
  SideTree tree_;
};

double distanceToLine(const dvec2& p, const std::vector<dvec2>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const dvec2 way = points[i] - points[i - 1], d = p - points[i - 1];
    const double square = dotOf(way, way),
                 t = square > 0.0 ? std::clamp(dotOf(d, way) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, glm::distance(d, t * way));
  }
  return least;
}

// Round strokes are all that is nearer than half of the width, however sharply curves bend.
TEST(Strokes, RoundOnesAreWhatIsNear) {
  for (int seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    Contour contour = randomContour(random, 1 + seed % 5);
    contour.isClosed = seed % 2 == 0;
    const double width = std::exp(std::uniform_real_distribution<double>(-4.0, 0.5)(random));
    const Covered covered({{contour}, FillRule::NonZero, Stroke{width}});
    std::vector<dvec2> line = pointsOf(contour, 400);
    if (!contour.isClosed) line.resize(line.size() - 401 + 1);  // without the line that closes it
    for (int i = 0; i < 200; ++i) {
      const dvec2 p = anyPoint(random, 1.5);
      const double off = distanceToLine(p, line) - 0.5 * width;
      if (std::abs(off) < 1e-4) continue;  // chords of the line
      ASSERT_EQ(covered.has(p), off < 0.0) << "seed " << seed << " width " << width << " off " << off;
    }
  }
}

// Each contour winds around what it covers once, the other way nowhere.
TEST(Strokes, AreCoveredOnceByEachOfTheirPieces) {
  for (int seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const Contour contour = randomContour(random, 3);
    for (const ArcContour& piece : arcContours({{contour}, FillRule::NonZero, Stroke{0.4}}, kTolerance)) {
      const std::vector<Arc> arcs = arcsOf({piece});
      const SideTree tree = treeOf(arcs);
      for (int i = 0; i < 20; ++i) {
        const int winding = windingNumber(arcs, tree, anyPoint(random, 1.5));
        ASSERT_TRUE(winding >= 0) << seed;
      }
    }
  }
}

// An arm of 2 and one of 1, at a right angle, of the width 0.4.
Outline angle(Stroke::Join join, Stroke::Cap cap, double miterLimit = 4.0) {
  Contour contour{{0.0, 0.0}, {{0, {}, {2.0, 0.0}}, {0, {}, {2.0, 1.0}}}};
  return {{contour}, FillRule::NonZero, Stroke{0.4, join, cap, miterLimit}};
}

TEST(Strokes, HaveTheirJoinsAndCaps) {
  using Join = Stroke::Join;
  using Cap = Stroke::Cap;
  // Both arms share a square of half the width on the inner side. 64 chords of a quarter of a circle of the
  // radius 0.2 lack 3e-6 of its area: one of them is in a round join, four are in two caps.
  const double arms = 3.0 * 0.4 - 0.2 * 0.2;
  const auto area = [](Join join, Cap cap, double limit = 4.0) {
    return Covered(angle(join, cap, limit)).area();
  };
  EXPECT_NEAR(area(Join::Miter, Cap::Butt), arms + 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(area(Join::Bevel, Cap::Butt), arms + 0.5 * 0.2 * 0.2, 1e-9);
  EXPECT_NEAR(area(Join::Round, Cap::Butt), arms + 0.25 * std::numbers::pi * 0.2 * 0.2, 1e-5);
  EXPECT_NEAR(area(Join::Miter, Cap::Square), arms + 0.2 * 0.2 + 2.0 * 0.4 * 0.2, 1e-9);
  EXPECT_NEAR(area(Join::Miter, Cap::Round), arms + 0.2 * 0.2 + std::numbers::pi * 0.2 * 0.2, 1e-4);
  // A miter at a right angle is as long as the width times the root of 2.
  EXPECT_NEAR(area(Join::Miter, Cap::Butt, 1.42), area(Join::Miter, Cap::Butt), 1e-9);
  EXPECT_NEAR(area(Join::Miter, Cap::Butt, 1.41), area(Join::Bevel, Cap::Butt), 1e-9);
}

// There and back: a bevel and a miter have no area there.
TEST(Strokes, TurnBackOnThemselves) {
  Contour contour{{0.0, 0.0}, {{0, {}, {2.0, 0.0}}, {0, {}, {1.0, 0.0}}}};
  for (const Stroke::Join join : {Stroke::Join::Miter, Stroke::Join::Bevel})
    EXPECT_NEAR(Covered({{contour}, FillRule::NonZero, Stroke{0.4, join, Stroke::Cap::Butt}}).area(), 0.8,
                1e-9);
  const Covered round({{contour}, FillRule::NonZero, Stroke{0.4, Stroke::Join::Round, Stroke::Cap::Butt}});
  EXPECT_TRUE(round.has({2.19, 0.0}));
}

// A circle's stroke is a ring; one wider than the circle has no hole.
TEST(Strokes, OfCirclesAreRings) {
  Contour circle = roundContour({0.3, -0.2}, 0.5);
  circle.isClosed = true;
  for (const double width : {0.1, 0.6, 0.999}) {
    const Covered ring({{circle}, FillRule::NonZero, Stroke{width}});
    const double outer = 0.5 + 0.5 * width, inner = 0.5 - 0.5 * width;
    EXPECT_NEAR(ring.area(), std::numbers::pi * (outer * outer - inner * inner), 1e-3) << width;
    EXPECT_FALSE(ring.has({0.3, -0.2})) << width;
  }
  const Covered disc({{circle}, FillRule::NonZero, Stroke{1.5}});
  EXPECT_NEAR(disc.area(), std::numbers::pi * 1.25 * 1.25, 1e-3);
  EXPECT_TRUE(disc.has({0.3, -0.2}));
}

// What is closed has a join where it begins, and what only ends there two caps.
TEST(Strokes, OfClosedContoursHaveNoEnds) {
  Contour square{{0, 0}, {{0, {}, {1, 0}}, {0, {}, {1, 1}}, {0, {}, {0, 1}}, {0, {}, {0, 0}}}};
  const auto area = [&] {
    return Covered({{square}, FillRule::NonZero, Stroke{0.2, Stroke::Join::Miter, Stroke::Cap::Butt}}).area();
  };
  EXPECT_NEAR(area(), 4.0 * 0.2 - 0.1 * 0.1, 1e-9);
  square.isClosed = true;
  EXPECT_NEAR(area(), 4.0 * 0.2, 1e-9);
}

}  // namespace stroke_test
}  // namespace sdf::test
