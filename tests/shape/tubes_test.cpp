// Tubes along lines and curves, and struts.
#include "sdf/shape/operators/tubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "shape/claim_checks.h"

namespace sdf::test {
namespace tubes_test {

using glm::dvec3;

double toSegment(const dvec3& p, const dvec3& a, const dvec3& b) {
  const dvec3 way = b - a;
  const double t = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
  return glm::distance(p, a + t * way);
}

std::vector<Vec3E> moving(const std::vector<dvec3>& points) { return {points.begin(), points.end()}; }

// Both at many places in a cube.
void expectSame(const Shape& a, const Shape& b, double half, double tolerance) {
  ASSERT_TRUE(a.ok()) << *a.error;
  const Probe f(a.distance), g(b.distance);
  Points points(7);
  for (int i = 0; i < 5000; ++i) {
    const dvec3 p = points.in(cube(half));
    ASSERT_NEAR(f(p), g(p), tolerance) << text(p);
  }
}

TEST(Tube, IsWhatIsNearSegments) {
  const std::vector<dvec3> line{{-1, 0, 0}, {0, 1, 0.5}, {1, 0, 0}, {1, 0, -1}};
  for (const bool closed : {false, true}) {
    const Shape shape = tube(moving(line), 0.2, closed);
    const Probe f(shape.distance);
    Points points(3);
    for (int i = 0; i < 2000; ++i) {
      const dvec3 p = points.in(cube(2));
      double least = closed ? toSegment(p, line.back(), line.front()) : HUGE_VAL;
      for (std::size_t k = 0; k + 1 < line.size(); ++k)
        least = std::min(least, toSegment(p, line[k], line[k + 1]));
      ASSERT_NEAR(f(p), least - 0.2, 1e-12) << text(p);
    }
    expectClaim(shape, cube(2), 5);
  }
}

// Along each segment balls whose radius goes in step.
TEST(Tube, TapersAsItsBallsDo) {
  const std::vector<dvec3> line{{0, -1, 0}, {0.1, 0, 0}, {0.6, 0.7, 0.2}, {0.6, 0.7, -0.6}};
  const double radii[] = {0.4, 0.2, 0.3, 0.05};
  const Shape shape = taperedTube(line, {radii[0], radii[1], radii[2], radii[3]});
  ASSERT_TRUE(shape.ok()) << *shape.error;
  const Probe f(shape.distance);
  Points points(3);
  constexpr int kBalls = 4000;
  for (int i = 0; i < 300; ++i) {
    const dvec3 p = points.in(cube(1.5));
    double least = HUGE_VAL;
    for (int k = 0; k < 3; ++k)
      for (int b = 0; b <= kBalls; ++b) {
        const double t = static_cast<double>(b) / kBalls;
        least = std::min(least, glm::distance(p, glm::mix(line[k], line[k + 1], t)) -
                                    std::lerp(radii[k], radii[k + 1], t));
      }
    if (least > 0.0) {
      ASSERT_NEAR(f(p), least, 1e-3) << text(p);
    }
    ASSERT_EQ(f(p) < 0.0, least < 0.0 || std::abs(least) < 1e-6) << text(p) << " " << f(p) << " " << least;
  }
  expectClaim(shape, cube(1.5), 5);
}

// Whichever way, and within the range of a slider.
TEST(Tube, IsTheLargerBallWhereItHoldsTheOther) {
  const std::vector<dvec3> two{{0, 0, 0}, {1, 0, 0}};
  expectSame(taperedTube(two, {0.1, 1.5}), translate(sphere(1.5), Vec3E(two[1])), 3.0, 1e-5);
  expectSame(taperedTube(two, {1.5, 0.1}), sphere(1.5), 3.0, 1e-5);
  const Expr k = Expr::parameter({"k", 0.1, 0.1, 2.0});
  for (const bool first : {false, true}) {
    const Shape shape = taperedTube(two, {first ? k : 0.1, first ? 0.1 : k});
    for (const double radius : {0.5, 1.05, 1.9}) {
      const Probe f(shape.distance, {{"k", radius}});
      const Probe expected(taperedTube(two, {first ? radius : 0.1, first ? 0.1 : radius}).distance);
      Points points(4);
      for (int i = 0; i < 500; ++i) {
        const dvec3 p = points.in(cube(3.0));
        ASSERT_NEAR(f(p), expected(p), 1e-5) << text(p) << " " << radius;
      }
    }
  }
  EXPECT_EQ(taperedTube(two, {0.5, 0.1}).bounds.min, dvec3(-0.5));
  EXPECT_EQ(taperedTube(two, {0.5, 0.1}).bounds.max, dvec3(1.1, 0.5, 0.5));
}

// However the points lie on it.
TEST(CurvedTube, ThroughPointsOfACircleIsARing) {
  const dvec3 turn{0.4, 1.1, -0.7};
  const auto onCircle = [&](double angle) {
    const double s = std::sin(turn.x), c = std::cos(turn.x);
    const dvec3 p{1.2 * std::sin(angle), 0.0, 1.2 * std::cos(angle)};
    return dvec3(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
  };
  std::vector<dvec3> whole;
  for (const double angle : {0.0, 0.3, 1.7, 2.0, 4.1, 5.0}) whole.push_back(onCircle(angle));
  expectSame(curvedTube(whole, 0.1, true), rotate(torus(1.2, 0.1), Vec3E(dvec3(turn.x, 0.0, 0.0))), 2.0,
             1e-9);
  std::vector<dvec3> part;
  for (const double angle : {-1.3, -0.8, 0.6, 1.3}) part.push_back(onCircle(angle));
  expectSame(curvedTube(part, 0.1), rotate(cappedTorus(1.3, 1.2, 0.1), Vec3E(dvec3(turn.x, 0.0, 0.0))), 2.0,
             1e-9);
}

TEST(CurvedTube, ThroughPointsInALineIsACapsule) {
  const Shape shape = curvedTube({{0, 0, 0}, {1, 2, 0}, {2, 4, 0}}, 0.3);
  expectSame(shape, capsule(dvec3(0.0), dvec3(2, 4, 0), 0.3), 5.0, 1e-9);
  expectSame(curvedTube({{0, 0, 0}, {2, 4, 0}}, 0.3), capsule(dvec3(0.0), dvec3(2, 4, 0), 0.3), 5.0, 1e-9);
}

// Nearly straight arcs, points that lie together, sharp turns and ways back, in any direction.
TEST(CurvedTube, HoldsItsClaimAndPassesItsPoints) {
  Points random(11);
  for (unsigned i = 0; i < 12; ++i) {
    std::vector<dvec3> line{dvec3(0.0)};
    const bool closed = i % 3 == 0;
    const double bend = i % 4 == 0 ? 1e-6 : 1.0;
    for (int k = 0; k < 5; ++k)
      line.push_back(line.back() +
                     std::pow(10.0, random.uniform(-1.5, 0.0)) *
                         glm::normalize(dvec3(1.0, 0.5, 0.0) + bend * 2.0 * random.direction()));
    if (i % 5 == 0) line.push_back(line[4]);  // back to where it came from
    const double radius = random.uniform(0.02, 0.1);
    const Shape shape = curvedTube(line, radius, closed);
    ASSERT_TRUE(shape.ok()) << *shape.error;
    const Probe f(shape.distance);
    for (const dvec3& p : line) EXPECT_LE(f(p) + radius, 1e-12) << i;
    SCOPED_TRACE(i);
    expectClaim(shape, shape.bounds.grown(1.0), i);
  }
}

// What lies off the joints of arcs in any direction across is a radius away: the curve has no corner there,
// beside which it would be less on one side and more on none.
TEST(CurvedTube, HasNoCorners) {
  const std::vector<dvec3> line{{0, 0, 0}, {1, 0.2, 0}, {1.5, 1, 0.7}, {0.5, 1.5, 1}};
  const double radius = 0.05, step = 1e-5;
  const Probe f(curvedTube(line, radius).distance);
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    // On the sphere about a point, the distance is largest on a great circle, and equal to its radius there.
    Points random(static_cast<unsigned>(k));
    dvec3 across(0.0);
    double most = -HUGE_VAL;
    for (int i = 0; i < 20000; ++i) {
      const dvec3 d = random.direction();
      if (const double at = f(line[k] + step * d); at > most) most = at, across = d;
    }
    EXPECT_NEAR(most + radius, step, 1e-3 * step);
    const double other = f(line[k] - step * across) + radius;
    EXPECT_NEAR(other, step, 1e-2 * step) << "a corner turns the ways across apart";
  }
}

TEST(CurvedTube, MayBeExactWithin) {
  EXPECT_EQ(tube(moving({{0, 0, 0}, {1, 0, 0}}), 0.1).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(curvedTube({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}, 0.1).claim.kind, ClaimKind::ExactOutside);
}

TEST(Struts, AreCapsulesBetweenPoints) {
  const std::vector<dvec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Shape shape = struts(moving(points), {{0, 1}, {0, 2}, {3, 1}}, 0.1);
  const Probe f(shape.distance);
  Points random(2);
  for (int i = 0; i < 1000; ++i) {
    const dvec3 p = random.in(cube(2));
    const double least = std::min({toSegment(p, points[0], points[1]), toSegment(p, points[0], points[2]),
                                   toSegment(p, points[3], points[1])});
    ASSERT_NEAR(f(p), least - 0.1, 1e-12) << text(p);
  }
}

TEST(Tube, RefusesWhatHasNoLine) {
  const std::vector<dvec3> two{{0, 0, 0}, {1, 0, 0}}, same{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(*tube({}, 0.1).error, "tube: it needs 2 points or more, got 0");
  EXPECT_EQ(*tube(moving(two), 0.1, true).error, "tube: a closed line needs 3 points or more, got 2");
  EXPECT_EQ(*tube(moving(two), 0.0).error, "tube: radius must be positive, got 0");
  EXPECT_EQ(tube({Vec3E(0.0), position()}, 0.1).error->substr(0, 13), "tube: point 2");
  EXPECT_EQ(*curvedTube(same, 0.1).error, "tube: points 2 and 3 are the same");
  EXPECT_EQ(*curvedTube({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 0.1, true).error,
            "tube: points 3 and 1 are the same");
  EXPECT_EQ(*taperedTube(two, {0.1}).error, "tube: it needs a radius for each point, 2, got 1");
  EXPECT_EQ(*taperedTube(two, {0.1, -1.0}).error, "tube: radius 2 must be positive, got -1");
  EXPECT_EQ(*taperedTube(same, {0.1, 0.2, 0.3}).error, "tube: points 2 and 3 are the same");
  EXPECT_EQ(*struts({}, {}, 0.1).error, "struts: it needs at least one edge");
  EXPECT_EQ(*struts(moving(two), {{0, 2}}, 0.1).error, "struts: edge 1 names point 3 of 2");
}

}  // namespace tubes_test
}  // namespace sdf::test
