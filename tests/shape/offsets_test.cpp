// Offsets of shapes whose distance is only a bound or a field: their surfaces are as far away as asked for,
// by ways to the surface that the distance has no part in, and their claims hold.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "shape/claim_checks.h"

namespace sdf::offsets_test {

const Vec3E kAt = position();

Expr fourth(const Expr& e) { return square(square(e)); }

// The box by powers: |x|^4 + |y|^4 + |z|^4 <= 1.
Shape superellipsoid() {
  return field(fourth(kAt.x) + fourth(kAt.y) + fourth(kAt.z) - 1.0, Box::centred(glm::dvec3(1.0)));
}

// A point of its surface, and its normal.
std::pair<glm::dvec3, glm::dvec3> onSuperellipsoid(Points& points) {
  const glm::dvec3 u = points.direction(), v = u * u;
  const glm::dvec3 p = u / std::pow(glm::dot(v, v), 0.25);
  return {p, glm::normalize(p * p * p)};
}

TEST(OffsetsOfFields, AreAsFarAwayAsAskedFor) {
  // Of a convex solid the point at d along a normal is d away. Off by some hundredths: the distance is right
  // to first order, and in the middle of what the normals tell beyond.
  constexpr double kOff = 0.06;
  const Shape rounded = round(superellipsoid(), 0.2), skin = shell(superellipsoid(), 0.1);
  const Probe outer(rounded.distance), wall(skin.distance);
  Points points(1);
  for (int i = 0; i < 1000; ++i) {
    const auto [p, n] = onSuperellipsoid(points);
    EXPECT_LT(outer(p + n * (0.2 * (1.0 - kOff))), 0.0) << text(p);
    EXPECT_GT(outer(p + n * (0.2 * (1.0 + kOff))), 0.0) << text(p);
    for (const double side : {1.0, -1.0}) {
      EXPECT_LT(wall(p + n * (side * 0.05 * (1.0 - kOff))), 0.0) << text(p);
      EXPECT_GT(wall(p + n * (side * 0.05 * (1.0 + kOff))), 0.0) << text(p);
    }
  }
}

TEST(OffsetsOfFields, KeepTheirClaims) {
  const Box where = Box::centred(glm::dvec3(2.5));
  for (const Shape& s : {round(superellipsoid(), 0.2), shell(superellipsoid(), 0.1)}) {
    expectClaim(s, where, 2);
    EXPECT_LT(s.claim.lipschitz, 3.0);
    EXPECT_TRUE(s.bounds.finite());
  }
}

// The same at any scale, moved and turned: what is proven of one is proven of the other.
TEST(OffsetsOfFields, AreTheSameAtAnyScale) {
  for (const double size : {1e-3, 1e3}) {
    const Vec3E p{kAt.x / size, kAt.y / size, kAt.z / size};
    const Shape s = round(
        field(fourth(p.x) + fourth(p.y) + fourth(p.z) - 1.0, Box::centred(glm::dvec3(size))), 0.2 * size);
    const Probe f(s.distance);
    EXPECT_NEAR(f(1.2 * size, 0.0, 0.0), 0.0, 0.01 * size);
    EXPECT_LT(s.claim.lipschitz, 3.0);
  }
}

// Where the gradient vanishes all over the surface there is nothing to divide by.
TEST(OffsetsOfFields, StayWhereTheGradientVanishesOnTheSurface) {
  const Expr ball = square(kAt.x) + square(kAt.y) + square(kAt.z) - 1.0;
  const Shape s = field(ball * square(ball), Box::centred(glm::dvec3(1.0)));
  const TapePtr before = Function(s.distance).at(), after = Function(round(s, 0.1).distance).at();
  for (double at = -1.0; at <= 1.0; at += 0.1) {
    const glm::dvec3 p(at, 0.5 * at, -0.3);
    const double was = evaluate(*before, p);
    if (was > -0.5) {
      EXPECT_NEAR(evaluate(*after, p), was - 0.1, 1e-15);  // the roundings of a number below 1
    }
  }
}

TEST(OffsetsOfExactShapes, AreTheirDistanceLessTheAmount) {
  const Shape both = unite(sphere(1.0), translate(box(Vec3E(1.0)), Vec3E(1.0, 0.0, 0.0)));
  for (const Shape& s : {box(Vec3E(1.0)), sphere(1.0), both})
    EXPECT_EQ(round(s, 0.1).distance, s.distance - 0.1);
}

// Half spaces n p <= d, by unit normals.
struct HalfSpace {
  glm::dvec3 normal;
  double offset;
};

Shape shapeOf(const std::vector<HalfSpace>& all) {
  std::vector<Shape> planes;
  for (const HalfSpace& h : all) planes.push_back(plane(h.normal, h.offset));
  return intersect(planes);
}

// The distance to the intersection of half spaces, by projections in turn (Dykstra 1983).
double distanceTo(const std::vector<HalfSpace>& all, const glm::dvec3& from) {
  std::vector<glm::dvec3> left(all.size(), glm::dvec3(0.0));
  glm::dvec3 p = from;
  for (int sweep = 0; sweep < 2000; ++sweep)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const glm::dvec3 moved = p + left[i];
      const double out = std::max(0.0, glm::dot(all[i].normal, moved) - all[i].offset);
      p = moved - out * all[i].normal;
      left[i] = moved - p;
    }
  return glm::distance(p, from);
}

TEST(OffsetsOfIntersections, OfHalfSpacesAreExact) {
  Points points(3);
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<HalfSpace> all;
    for (int i = 0; i < 2 + trial % 3; ++i) all.push_back({points.direction(), points.uniform(-0.5, 0.5)});
    const Shape s = round(shapeOf(all), 0.3);
    EXPECT_EQ(s.claim.kind, ClaimKind::Bound);
    const Probe f(s.distance);
    for (int i = 0; i < 100; ++i) {
      const glm::dvec3 p = points.in(Box::centred(glm::dvec3(2.0)));
      const double true_ = distanceTo(all, p);
      if (true_ > 0.0) {
        EXPECT_NEAR(f(p), true_ - 0.3, 1e-4) << "trial " << trial << " at " << text(p);
      }
    }
    expectLipschitz(s, Box::centred(glm::dvec3(3.0)), 4, 4000);
  }
}

// Two half spaces that meet at 45 degrees in the z axis, cut to a board.
TEST(OffsetsOfIntersections, RoundASharpEdge) {
  const Shape wedge = intersect({plane(Vec3E(0.0, 1.0, 0.0), 0.0), plane(Vec3E(1.0, -1.0, 0.0), 0.0),
                                 plane(Vec3E(-1.0, -1.0, 0.0), 2.0), box(Vec3E(5.0, 5.0, 1.0))});
  const Shape s = round(wedge, 0.3);
  const Probe f(s.distance);
  for (int degrees = -44; degrees < 90; ++degrees) {
    const double angle = degrees * 3.14159265358979323846 / 180.0;
    EXPECT_NEAR(f(0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.2), 0.0, 1e-9) << degrees;
  }
  // A corner of the board: the edge in the z axis, and the board's end.
  EXPECT_NEAR(f(0.1, 0.1, 1.2), std::sqrt(0.06) - 0.3, 1e-9);
  expectClaim(s, Box::centred(glm::dvec3(8.0)), 5);
}

// The distance of a point from the circle about the y axis of this radius and height.
double toRim(const glm::dvec3& p, double radius, double height) {
  return std::hypot(std::hypot(p.x, p.z) - radius, p.y - height);
}

TEST(OffsetsOfIntersections, RoundTheEdgesOfCurvedFaces) {
  // Two balls of radius 1, 0.6 above and below: they meet in a rim of radius 0.8.
  const Shape ball = sphere(1.0);
  const Shape up = translate(ball, Vec3E(0.0, 0.6, 0.0)), down = translate(ball, Vec3E(0.0, -0.6, 0.0));
  const Shape lens = round(intersect(up, down), 0.05);
  const Shape skin = shell(unite(up, down), 0.1);
  const Shape bowl = round(subtract(box(Vec3E(2.0, 1.0, 2.0)), infiniteCylinder(0.8)), 0.05);
  const Probe atLens(lens.distance), atSkin(skin.distance), atBowl(bowl.distance);
  const Box around = Box::centred(glm::dvec3(3.0));
  for (const Shape& s : {lens, skin, bowl}) expectClaim(s, around, 6);
  // To first order in distance times curvature.
  constexpr double kOff = 0.003;
  for (int i = -4; i <= 4; ++i) {
    // Outside of both balls' normals at the rim: their slopes are 0.75 either way.
    const double angle = i / 4.0 * std::atan(0.6 / 0.8) * 0.99;
    const glm::dvec3 out(0.8 + 0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.0);
    EXPECT_NEAR(toRim(out, 0.8, 0.0), 0.05, 1e-12);
    EXPECT_NEAR(atLens(out), 0.0, kOff) << i;
    // The balls' union has the same rim as a notch, whose inside is the other way.
    const double inwards = i / 4.0 * std::atan(0.6 / 0.8) * 0.99;
    const glm::dvec3 in(0.8 - 0.05 * std::cos(inwards), 0.05 * std::sin(inwards), 0.0);
    EXPECT_NEAR(atSkin(in), 0.0, kOff) << i;
    const double over = (i + 4) / 8.0 * 1.57;
    const glm::dvec3 above(0.8 - 0.05 * std::sin(over), 1.0 + 0.05 * std::cos(over), 0.0);
    EXPECT_NEAR(atBowl(above), 0.0, kOff) << i;
  }
}

// Of fields and planes together.
TEST(OffsetsOfIntersections, RoundTheEdgesOfFields) {
  const Shape cut = intersect(superellipsoid(), plane(Vec3E(0.0, 1.0, 0.0), 0.0));
  const Shape s = round(cut, 0.1);
  const Probe f(s.distance);
  // The rim at (1, 0, 0) has a right angle.
  for (const double angle : {0.1, 0.5, 0.8, 1.2, 1.5})
    EXPECT_NEAR(f(1.0 + 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0), 0.0, 0.006) << angle;
  expectClaim(s, Box::centred(glm::dvec3(2.5)), 7);
}

// An offset of an offset reads the same distance.
TEST(OffsetsOfIntersections, OfOffsetsGoOn) {
  const Shape wedge = intersect(plane(Vec3E(0.0, 1.0, 0.0), 0.0), plane(Vec3E(1.0, 0.0, 0.0), 0.0));
  const Probe f(round(round(wedge, 0.1), 0.2).distance);
  EXPECT_NEAR(f(0.3 * std::cos(0.7), 0.3 * std::sin(0.7), 0.0), 0.0, 1e-9);
}

// A ball with dents that meet in creases, whose offsets make distances around edges.
Shape dented(int dents, double radius) {
  Shape s = box(Vec3E(1.0));
  for (int i = 0; i < dents; ++i)
    s = round(s, radius) - translate(sphere(0.1), Vec3E(std::cos(i), std::sin(i), std::sin(3.0 * i)));
  return s;
}

TEST(OffsetsOfOffsets, DoNotTryAgainWhatCouldNotBeCalibrated) {
  const Shape tried = round(dented(3, 0.001), 0.001);
  ASSERT_FALSE(tried.claim.calibrated);
  ASSERT_EQ(tried.claim.uncalibrated.size(), 1u);
  const Shape again = round(tried, 0.001);
  EXPECT_EQ(again.distance, tried.distance - 0.001);
  ASSERT_EQ(again.claim.uncalibrated.size(), 1u);
  EXPECT_EQ(again.claim.uncalibrated[0].part, tried.claim.uncalibrated[0].part);
}

TEST(OffsetsOfOffsets, CalibrateForASmallOffsetWhatCouldNotBeForALargeOne) {
  // Of x^2 - y^2 + z^2 - 0.05 the gradient vanishes at the origin, 0.22 from the surface.
  const Shape saddle =
      field(square(kAt.x) - square(kAt.y) - 0.05 + square(kAt.z), Box::centred(glm::dvec3(1.0)));
  const Shape large = round(saddle, 2.0);
  ASSERT_FALSE(large.claim.calibrated);
  Shape small = saddle;
  small.claim.uncalibrated = large.claim.uncalibrated;
  EXPECT_EQ(round(small, 0.02).claim.calibrated, round(saddle, 0.02).claim.calibrated);
  EXPECT_TRUE(round(small, 0.02).claim.calibrated);
}

TEST(OffsetsOfOffsets, OfHundredsTakeAsLongAsAllOfThem) {
  // Each took some 70 ms and more the more there were, and each shell within a shell twice as long.
  EXPECT_TRUE(dented(60, 0.001).ok());
  Shape skin = sphere(1.0);
  for (int i = 1; i <= 150; ++i) skin = shell(skin, 0.3 / i);
  EXPECT_TRUE(skin.ok());
  EXPECT_LT(topologicalOrder({&skin.distance, 1}).size(), 2000u);
}

TEST(BlendsOfFields, AreAsWideAsAskedFor) {
  // Where a plane stands at right angles on the field, at equal distances d, a quadratic blend lowers both by
  // k / 4: its surface is where d = k / 4.
  const Shape wall = plane(Vec3E(0.0, 1.0, 0.0), 0.0);
  const Shape s = unite(superellipsoid(), wall, Blend::quadratic(0.4));
  const Probe f(s.distance);
  EXPECT_NEAR(f(1.1, 0.1, 0.0), 0.0, 0.01);
  expectLipschitz(s, Box::centred(glm::dvec3(2.0)), 8);
}

}  // namespace sdf::offsets_test
