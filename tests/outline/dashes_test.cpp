// Dashes against the lengths of the lines that they lie along.
#include "sdf/outline/dashes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "outline/curves.h"
#include "sdf/outline/biarcs.h"
#include "sdf/outline/stroke.h"

namespace sdf::test {
namespace dashes_test {

using glm::dvec2;

double lengthOf(const Dash& dash) {
  double length = 0.0;
  for (std::size_t i = 1; i < dash.chain.size(); ++i)
    length += Arc::through(dash.chain[i - 1], dash.chain[i].at).size;
  return length;
}

Stroke dashed(std::vector<double> dashes, double offset = 0.0) {
  return {0.2, Stroke::Join::Miter, Stroke::Cap::Butt, 4.0, std::move(dashes), offset};
}

// Where dashes of a line along x begin and end.
std::vector<double> endsOf(const Stroke& stroke, double length = 10.0) {
  std::vector<double> ends;
  for (const Dash& dash : dashesOf({{{0.0, 0.0}, 0.0}, {{length, 0.0}, 0.0}}, false, stroke)) {
    ends.push_back(dash.chain.front().at.x);
    ends.push_back(dash.chain.back().at.x);
    EXPECT_EQ(dash.along, dvec2(1.0, 0.0));
  }
  return ends;
}

TEST(Dashes, FollowTheirPattern) {
  using Ends = std::vector<double>;
  EXPECT_EQ(endsOf(dashed({3.0, 2.0})), (Ends{0, 3, 5, 8}));
  EXPECT_EQ(endsOf(dashed({3.0, 2.0}, 1.0)), (Ends{0, 2, 4, 7, 9, 10}));
  EXPECT_EQ(endsOf(dashed({3.0, 2.0}, -1.0)), (Ends{1, 4, 6, 9}));
  EXPECT_EQ(endsOf(dashed({3.0, 2.0}, 13.0)), (Ends{2, 5, 7, 10}));
  EXPECT_EQ(endsOf(dashed({3.0, 1.0, 2.0})), (Ends{0, 3, 4, 6, 9, 10}));  // 3 1 2 3 1 2
  EXPECT_EQ(endsOf(dashed({4.0})), (Ends{0, 4, 8, 10}));
  EXPECT_EQ(endsOf(dashed({20.0, 1.0})), (Ends{0, 10}));
  EXPECT_EQ(endsOf(dashed({1.0, 20.0}, 1.0)), Ends{});
  EXPECT_EQ(endsOf(dashed({0.0, 4.0})), (Ends{0, 0, 4, 4, 8, 8}));
  EXPECT_EQ(endsOf(dashed({0.0, 4.0}, 1.0)), (Ends{3, 3, 7, 7}));
}

TEST(Dashes, OfNoLengthAreTheirCaps) {
  const ArcContour line{{{0.0, 0.0}, 0.0}, {{10.0, 0.0}, 0.0}};
  Stroke stroke = dashed({0.0, 4.0});
  EXPECT_TRUE(strokeContours(line, false, stroke).empty());
  stroke.cap = Stroke::Cap::Square;
  EXPECT_EQ(strokeContours(line, false, stroke).size(), 6u);  // half a square on either side
  stroke.cap = Stroke::Cap::Round;
  EXPECT_EQ(strokeContours(line, false, stroke).size(), 6u);
}

// By the arcs' lengths, on parts of the arcs, and none is longer than it should be.
TEST(Dashes, LieOnTheirCurves) {
  for (int seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const Contour contour = randomContour(random, 1 + seed % 5);
    const Stroke whole{0.1};
    for (const bool isClosed : {false, true}) {
      Outline outline{{contour}, FillRule::NonZero, {}};
      ArcContour chain = arcContours(outline, 1e-6).at(0);
      if (!isClosed) chain.push_back({chain.front().at, 0.0});
      const std::vector<Arc> arcs = arcsOf(chain, isClosed);
      double length = 0.0;
      for (const Arc& arc : arcs) length += arc.size;
      std::uniform_real_distribution<double> any(0.02, 0.5);
      const double dash = any(random), gap = any(random), offset = any(random);
      outline.stroke = dashed({dash, gap}, offset);
      const std::vector<Dash> dashes = dashesOf(chain, isClosed, *outline.stroke);
      EXPECT_LE(dashes.size(), mostDashes(outline)) << seed;
      double drawn = 0.0;
      for (const Dash& d : dashes) {
        drawn += lengthOf(d);
        // One that runs over the end of a closed contour may be of two.
        EXPECT_LE(lengthOf(d), (isClosed ? 2.0 : 1.0) * dash + 1e-6) << seed;
        for (const ArcCorner& corner : d.chain) {
          double off = 1.0;
          for (const Arc& arc : arcs) off = std::min(off, arc.placeOf(corner.at).squared());
          EXPECT_LT(off, 1e-16) << seed;
        }
      }
      const auto drawnUpTo = [&](double s) {
        return std::floor(s / (dash + gap)) * dash + std::min(std::fmod(s, dash + gap), dash);
      };
      EXPECT_NEAR(drawn, drawnUpTo(offset + length) - drawnUpTo(offset), 1e-6) << seed;
    }
  }
}

// The corner at which a closed contour begins lies inside of a dash, if one runs over it.
TEST(Dashes, RunOverTheEndOfAClosedContour) {
  const ArcContour square{{{0.0, 0.0}, 0.0}, {{4.0, 0.0}, 0.0}, {{4.0, 4.0}, 0.0}, {{0.0, 4.0}, 0.0}};
  const std::vector<Dash> dashes = dashesOf(square, true, dashed({2.0, 2.0}, 1.0));
  ASSERT_EQ(dashes.size(), 4u);
  EXPECT_EQ(dashes[0].chain, (ArcContour{{{0.0, 1.0}, 0.0}, {{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}}));
  // One that is longer than the contour is all of it, without ends.
  EXPECT_EQ(strokeContours(square, true, dashed({20.0, 1.0})), strokeContours(square, true, dashed({})));
  EXPECT_EQ(dashesOf(square, true, dashed({2.0, 2.0})).size(), 4u);
  // One with a small gap has ends.
  EXPECT_EQ(dashesOf(square, true, dashed({15.5, 0.5}, 1.0)).size(), 1u);
  EXPECT_NE(strokeContours(square, true, dashed({15.5, 0.5}, 1.0)), strokeContours(square, true, dashed({})));
}

TEST(Dashes, WithoutLengthsAreNone) {
  EXPECT_FALSE(dashed({}).isDashed());
  EXPECT_FALSE(dashed({0.0, 0.0}).isDashed());
  EXPECT_TRUE(dashed({0.0, 1.0}).isDashed());
  EXPECT_EQ(mostDashes({{}, FillRule::NonZero, dashed({})}), 0.0);
}

}  // namespace dashes_test
}  // namespace sdf::test
