// Arcs against points of them.
#include "sdf/outline/arc.h"

#include <gtest/gtest.h>

#include "outline/curves.h"

namespace sdf {
namespace arc_test {

using glm::dvec2;

Arc randomArc(std::mt19937& random, double mostBulge) {
  std::uniform_real_distribution<double> bulge(-mostBulge, mostBulge);
  const dvec2 from = test::anyPoint(random), to = test::anyPoint(random);
  return Arc::through({from, bulge(random)}, to);
}

double nearestOf(const std::vector<dvec2>& points, const dvec2& p) {
  double least = HUGE_VAL;
  for (const dvec2& q : points) least = std::min(least, glm::distance(p, q));
  return least;
}

TEST(Arc, EndsWhereItIsToEnd) {
  std::mt19937 random(1);
  for (const double bulge : {0.9, 0.1, 1e-6, 0.0})
    for (int i = 0; i < 200; ++i) {
      const Arc arc = randomArc(random, bulge);
      EXPECT_NEAR(glm::distance(test::pointsOf(arc, 1).back(), arc.to), 0.0, 1e-14);
      EXPECT_NEAR(glm::length(arc.along), 1.0, 1e-15);
      EXPECT_NEAR(glm::length(arc.alongTo), 1.0, 1e-15);
      EXPECT_NEAR(arc.placeOf(arc.middle()).squared(), 0.0, 1e-28);
    }
}

TEST(Arc, HasTheDistanceToItsNearestPoint) {
  std::mt19937 random(2);
  for (const double bulge : {0.99, 0.1, 1e-5, 0.0})
    for (int i = 0; i < 100; ++i) {
      const Arc arc = randomArc(random, bulge);
      constexpr int kCount = 2000;
      const std::vector<dvec2> points = test::pointsOf(arc, kCount);
      for (int k = 0; k < 20; ++k) {
        const dvec2 p = test::anyPoint(random, 2.0);
        const double expected = nearestOf(points, p), step = arc.size / kCount;
        const double distance = std::sqrt(arc.placeOf(p).squared());
        EXPECT_LE(distance, expected + 1e-14);
        // Half a step aside of the nearest point, whose distance grows as a root there.
        EXPECT_GE(distance,
                  std::sqrt(std::max(
                      0.0, expected * expected - step * step * (1.0 + expected * std::abs(arc.curvature)))) -
                      1e-14);
      }
    }
}

// The distance to the right is what its sign and its normal say.
TEST(Arc, KnowsItsSidesAndItsNormal) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-0.01, 0.01);
  for (int i = 0; i < 300; ++i) {
    const Arc arc = randomArc(random, 0.7);
    const std::vector<dvec2> points = test::pointsOf(arc, 10);
    for (int k = 1; k < 10; ++k) {
      const dvec2 way = points[k + 1] - points[k - 1], right = glm::normalize(dvec2(way.y, -way.x));
      const double d = off(random) * arc.size;
      const Arc::Place place = arc.placeOf(points[k] + d * right);
      EXPECT_EQ(place.past, 0.0);
      EXPECT_NEAR(place.out, d, 1e-14);
      EXPECT_NEAR(glm::distance(arc.normalAt(points[k] + d * right), right), 0.0, 1e-12);
    }
  }
}

TEST(Arc, HasItsPointsInItsBoxAndTouchesIt) {
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) {
    const Arc arc = randomArc(random, i % 2 == 0 ? 0.95 : 1e-4);
    const Rectangle box = arc.box();
    Rectangle seen;
    for (const dvec2& p : test::pointsOf(arc, 1000)) seen.add(p);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(seen.lo[k], box.lo[k], 1e-5);
      EXPECT_NEAR(seen.hi[k], box.hi[k], 1e-5);
      EXPECT_GE(seen.lo[k], box.lo[k] - 1e-14);
      EXPECT_LE(seen.hi[k], box.hi[k] + 1e-14);
    }
  }
}

TEST(Arc, HasPartsThatLieOnIt) {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const Arc arc = randomArc(random, 0.9);
    const std::vector<dvec2> points = test::pointsOf(arc, 10);
    const Arc part = Arc::through(arc.part(points[2], points[9]), points[9]);
    for (const dvec2& p : test::pointsOf(part, 20)) EXPECT_NEAR(arc.placeOf(p).squared(), 0.0, 1e-26);
    EXPECT_NEAR(part.size, 0.7 * arc.size, 1e-13);
  }
}

}  // namespace arc_test
}  // namespace sdf
