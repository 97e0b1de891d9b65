// Outlines of curves against points of these curves, and against their winding numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "outline/curves.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/outline/biarcs.h"
#include "sdf/outline/boundary.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/polygon_field.h"

namespace sdf {
namespace outline_test {

using glm::dvec2;

bool isInside(const std::vector<std::vector<dvec2>>& chains, FillRule rule, const dvec2& p) {
  int winding = 0;
  for (const auto& chain : chains) winding += test::windingOf(chain, p);
  return rule == FillRule::NonZero ? winding != 0 : winding % 2 != 0;
}

/// Distances to the border by its definition: to those points of the curves that have the inside on one side.
struct Reference {
  std::vector<std::vector<dvec2>> chains;
  std::vector<dvec2> border;
  FillRule rule;

  Reference(const Outline& outline, int count) : rule(outline.rule) {
    for (const Contour& c : outline.contours) chains.push_back(test::pointsOf(c, count));
    for (const auto& chain : chains)
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const dvec2 a = chain[i], b = chain[(i + 1) % chain.size()], way = b - a;
        if (glm::length(way) < 1e-9) continue;
        const dvec2 middle = 0.5 * (a + b), step = 1e-9 * glm::normalize(dvec2(way.y, -way.x));
        if (isInside(chains, rule, middle + step) != isInside(chains, rule, middle - step)) addLine(a, b);
      }
  }
  void addLine(const dvec2& a, const dvec2& b) {
    const int parts = 1 + static_cast<int>(glm::distance(a, b) / 5e-3);
    for (int i = 0; i <= parts; ++i) border.push_back(glm::mix(a, b, static_cast<double>(i) / parts));
  }
  double distance(const dvec2& p) const {
    double least = HUGE_VAL;
    for (const dvec2& q : border) least = std::min(least, glm::distance(p, q));
    return least;
  }
};

// Borders of what overlaps are the union's; the reference has points 5e-3 apart.
void expectTheBorder(const Outline& outline, unsigned seed) {
  const Reference reference(outline, 300);
  const Shape shape = sdf::outline(outline, {1e-6, 1e-4});
  ASSERT_TRUE(shape.ok()) << *shape.error;
  const Tape tape(shape.distance);
  std::mt19937 random(seed);
  for (int i = 0; i < 300; ++i) {
    const dvec2 p = test::anyPoint(random, 1.6);
    const double expected = reference.distance(p), f = evaluate(tape, {p, 0.7});
    if (expected < 5e-3) continue;  // of the reference the sides are not sure
    ASSERT_NEAR(std::abs(f), expected, 5e-3) << p.x << ", " << p.y;
    ASSERT_EQ(f < 0.0, isInside(reference.chains, outline.rule, p)) << p.x << ", " << p.y;
  }
}

TEST(Outline, IsTheBorderOfWhatRandomContoursWindAround) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Outline outline;
    outline.rule = seed % 2 == 0 ? FillRule::NonZero : FillRule::EvenOdd;
    for (unsigned i = 0; i < 1 + seed % 3; ++i) outline.contours.push_back(test::randomContour(random, 4));
    expectTheBorder(outline, seed + 1000);
  }
}

TEST(Outline, UnitesWhatOverlapsAndTouches) {
  using test::boxContour;
  using test::roundContour;
  const Contour box = boxContour({-0.5, -0.5}, {0.5, 0.5});
  const std::vector<std::vector<Contour>> cases{
      {box, boxContour({0.5, -0.5}, {1.0, 0.5})},   // a side of both
      {box, boxContour({0.0, -0.5}, {1.0, 0.5})},   // sides that lie on each other in part
      {box, box},                                   // the same twice
      {box, boxContour({0.5, 0.5}, {1.0, 1.0})},    // a corner of both
      {box, roundContour({0.5, 0.0}, 0.6)},         // crossing
      {box, roundContour({1.0, 0.0}, 0.5)},         // touching
      {box, roundContour({0.0, 0.0}, 0.3, false)},  // a hole
      {box, roundContour({0.0, 0.0}, 0.3)},         // no hole
      {roundContour({-0.3, 0.0}, 0.5), roundContour({0.3, 0.0}, 0.5, false)}};
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (const FillRule rule : {FillRule::NonZero, FillRule::EvenOdd}) {
      SCOPED_TRACE(i);
      if (i == 2 && rule == FillRule::EvenOdd) continue;  // nothing is left
      expectTheBorder({cases[i], rule}, 5);
    }
}

TEST(Outline, IsTheDistanceToTheArcsInDouble) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const Outline outline{{test::randomContour(random, 5)}};
    const auto border = boundaryOf(arcContours(outline, 1e-5), FillRule::NonZero);
    ASSERT_TRUE(border.ok());
    const std::vector<Arc> arcs = arcsOf(*border);
    const PolygonDistance distance(*border);
    std::uint32_t hint = 0;
    for (int k = 0; k < 100; ++k) {
      const dvec2 p = test::anyPoint(random, 2.0);
      double least = HUGE_VAL;
      for (const Arc& arc : arcs)
        for (const dvec2& q : {arc.from, arc.to}) least = std::min(least, glm::distance(p, q));
      for (const Arc& arc : arcs) {
        if (arc.curvature == 0.0) {
          const double t = glm::dot(p - arc.from, arc.along);
          if (t > 0.0 && t < arc.size) least = std::min(least, glm::distance(p, arc.from + t * arc.along));
          continue;
        }
        const dvec2 centre = arc.from + dvec2(-arc.along.y, arc.along.x) / arc.curvature;
        const dvec2 foot = centre + glm::normalize(p - centre) / std::abs(arc.curvature);
        const double t = glm::dot(foot - arc.from, arc.along), u = glm::dot(foot - arc.to, arc.alongTo);
        if (t > 0.0 && u < 0.0) least = std::min(least, glm::distance(p, foot));
      }
      const PolygonDistance::Read read = distance.read(p, hint);
      hint = read.side;
      // The centre of an arc that is all but straight is far off, and so is the reference.
      ASSERT_NEAR(std::abs(read.distance), least, 1e-9);
      ASSERT_NEAR(glm::length(read.gradient), 1.0, 1e-12);
      ASSERT_NEAR(distance.read(p - read.distance * read.gradient, hint).distance, 0.0, 1e-12);
    }
  }
}

// The distance to a parabola's nearest point solves a cubic; here it is found by a dense search and Newton's
// steps.
TEST(Outline, IsAsNearToTheCurveAsItsTolerance) {
  const Contour contour{{-1, 0}, {{1, {{0, 2}}, {1, 0}}, {0, {}, {-1, 0}}}};
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const Shape shape = outline({{contour}}, {tolerance, 1e-4});
    ASSERT_TRUE(shape.ok());
    const Tape tape(shape.distance);
    double worst = 0.0;
    for (int i = 1; i < 100; ++i) {
      const double t = i / 100.0;
      const dvec2 p = test::pointOf({-1, 0}, contour.curves[0], t);
      const dvec2 way(2.0, 4.0 * (1.0 - 2.0 * t)), out = glm::normalize(dvec2(-way.y, way.x));
      worst = std::max(worst, std::abs(evaluate(tape, {p + 0.3 * out, 0.0}) - 0.3));
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GE(worst, 1e-3 * tolerance);
  }
}

TEST(Outline, SaysWhatIsWrong) {
  EXPECT_EQ(outline(Outline{}, {1e-6, 1e-4}).error.value_or(""), "outline: it encloses no area");
  const Contour line{{0, 0}, {{0, {}, {1, 0}}}};
  EXPECT_EQ(outline({{line}}, {1e-6, 1e-4}, "text").error.value_or(""), "text: it encloses no area");
  const Contour bad{{0, 0}, {{0, {}, {NAN, 0}}, {0, {}, {1, 1}}}};
  EXPECT_EQ(outline({{bad}}, {1e-6, 1e-4}).error.value_or(""), "outline: its points must be finite");
  EXPECT_EQ(outline({{test::roundContour({}, 1.0)}}, {1e-6, 0.0}).error.value_or(""),
            "outline: its tolerances must be positive, got 0");
}

TEST(Outline, HasTightBounds) {
  const Shape shape = outline({{test::roundContour({2.0, 1.0}, 0.5)}}, {1e-7, 1e-4});
  EXPECT_NEAR(shape.bounds.min.x, 1.5, 1e-6);
  EXPECT_NEAR(shape.bounds.max.x, 2.5, 1e-6);
  EXPECT_NEAR(shape.bounds.min.y, 0.5, 1e-6);
  EXPECT_NEAR(shape.bounds.max.y, 1.5, 1e-6);
  EXPECT_EQ(shape.dimension, 2);
  EXPECT_EQ(shape.claim.kind, ClaimKind::Exact);
}

}  // namespace outline_test
}  // namespace sdf
