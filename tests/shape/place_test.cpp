#include "sdf/shape/operators/place.h"

#include <numbers>
#include <random>

#include "claim_checks.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace place_test {

constexpr double kPi = std::numbers::pi;
const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

// A shape with no symmetry at all, exact outside.
Shape odd() {
  return translate(box(Vec3E(0.5, 0.3, 0.2)), Vec3E(0.2, 0.1, 0.0)) |
         translate(sphere(0.3), Vec3E(0.6, 0.4, 0.3));
}

std::size_t operations(const Shape& s) { return topologicalOrder(withoutClaims({&s.distance, 1})).size(); }

TEST(Translate, MovesDistanceBoundsAndColour) {
  Material m;
  m.color = Vec3E(kX, kY, kZ);
  const Shape s = translate(sphere(0.5).paint(m), Vec3E(1.0, -2.0, 3.0));
  const Probe f(s.distance);
  EXPECT_EQ(f(1.0, -2.0, 3.0), -0.5);
  EXPECT_EQ(s.bounds.min, glm::dvec3(0.5, -2.5, 2.5));
  EXPECT_EQ(s.bounds.max, glm::dvec3(1.5, -1.5, 3.5));
  EXPECT_EQ(Probe(s.surface[0])(1.25, 0.0, 0.0), 0.25) << "colour is that of the place before the move";
  EXPECT_EQ(s.claim.kind, ClaimKind::Exact);
  EXPECT_EQ(s.distance.lipschitz(), 1.0);
  expectClaim(s, {glm::dvec3(-1.0, -4.0, 1.0), glm::dvec3(3.0, 0.0, 5.0)}, 1);
}

TEST(Translate, ByASliderBoundsEveryPlace) {
  const Shape s = translate(sphere(0.5), Vec3E(slider("a", 0.0, -1.0, 2.0), 0.0, 0.0));
  EXPECT_EQ(s.bounds.min.x, -1.5);
  EXPECT_EQ(s.bounds.max.x, 2.5);
  EXPECT_FALSE(translate(plane(Vec3E(0.0, 1.0, 0.0), 0.0), Vec3E(1.0)).bounds.finite());
}

TEST(Rotate, TurnsAboutXThenYThenZByTheRightHandRule) {
  const Shape s = translate(sphere(0.1), Vec3E(1.0, 2.0, 3.0));
  const auto centre = [&](const Vec3E& angles) { return rotate(s, angles).bounds.centre(); };
  EXPECT_EQ(centre(Vec3E(kPi / 2, 0.0, 0.0)), glm::dvec3(1.0, -3.0, 2.0));
  EXPECT_EQ(centre(Vec3E(0.0, kPi / 2, 0.0)), glm::dvec3(3.0, 2.0, -1.0));
  EXPECT_EQ(centre(Vec3E(0.0, 0.0, kPi / 2)), glm::dvec3(-2.0, 1.0, 3.0));
  // (1, 2, 3) -> x: (1, -3, 2) -> y: (2, -3, -1) -> z: (3, 2, -1)
  EXPECT_EQ(centre(Vec3E(kPi / 2)), glm::dvec3(3.0, 2.0, -1.0));
  EXPECT_NEAR(Probe(rotate(s, Vec3E(kPi / 2)).distance)(3.0, 2.0, -1.0), -0.1, kRounding);
}

TEST(Rotate, CostsNothingForQuarterTurns) {
  const Shape s = translate(box(Vec3E(0.1, 0.2, 0.3)), Vec3E(1.0, 2.0, 3.0));
  EXPECT_LE(operations(rotate(s, Vec3E(0.0, kPi / 2, 0.0))), operations(s) + 1) << "one sign";
  EXPECT_EQ(rotate(s, Vec3E(0.0)).distance, s.distance);
  // Two products and a sum for each of two coordinates, their four constants (two shared), one square less to
  // share.
  EXPECT_LE(operations(rotate(s, Vec3E(0.0, 0.3, 0.0))), operations(s) + 9);
}

TEST(Rotate, KeepsTheClaim) {
  for (const Vec3E& angles : {Vec3E(0.3, 0.0, 0.0), Vec3E(0.5, -0.7, 1.1)}) {
    const Shape s = rotate(odd(), angles);
    EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
    EXPECT_EQ(s.distance.lipschitz(), 1.0);
    expectClaim(s, cube(2.0), 2);
  }
}

TEST(Rotate, ByASliderBoundsEveryTurn) {
  const Expr angle = slider("a", 0.0, 0.0, 6.3);
  const Shape s = rotate(odd(), Vec3E(0.0, angle, 0.0));
  for (const double a : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    const Box now = rotate(odd(), Vec3E(0.0, a, 0.0)).bounds;
    EXPECT_TRUE(s.bounds.contains(now)) << a;
  }
  EXPECT_LE(s.bounds.longestSide(),
            2.0 * glm::length(glm::max(-odd().bounds.min, odd().bounds.max)) + kRounding);
  EXPECT_EQ(s.bounds.max.y, odd().bounds.max.y) << "a turn about y keeps heights";
}

TEST(RotateAbout, IsTheSameTurnAboutACoordinateAxis) {
  Points points(3);
  const Shape s = odd();
  const Probe one(rotate(s, Vec3E(0.0, 0.4, 0.0)).distance),
      other(rotateAbout(s, Vec3E(0.0, 2.5, 0.0), 0.4).distance);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    ASSERT_NEAR(one(p), other(p), kRounding);
  }
}

TEST(RotateAbout, TheDiagonalPermutesTheAxes) {
  const Shape s = rotateAbout(translate(sphere(0.1), Vec3E(1.0, 0.0, 0.0)), Vec3E(1.0), 2.0 * kPi / 3.0);
  EXPECT_NEAR(Probe(s.distance)(0.0, 1.0, 0.0), -0.1, kRounding);
  expectClaim(rotateAbout(odd(), Vec3E(1.0, -2.0, 0.5), 0.8), cube(2.0), 4);
}

TEST(Scale, AlikeKeepsExactness) {
  for (const double factor : {0.3, 2.0, -1.5}) {
    const Shape s = scale(odd(), factor);
    EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
    EXPECT_EQ(s.distance.lipschitz(), 1.0);
    expectClaim(s, cube(3.0), 5);
  }
  EXPECT_EQ(scale(sphere(1.0), 2.0).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(Probe(scale(sphere(1.0), 2.0).distance)(3.0, 0.0, 0.0), 1.0);
}

TEST(Scale, UnevenlyIsAsSteepAsItIsUneven) {
  const Shape s = scale(sphere(1.0), Vec3E(0.5, 1.0, 2.0));
  // 1, and a third of q (q - 1 / q) / 2 with q = 2 / 0.5 for how fast its own slope turns.
  EXPECT_LE(s.claim.lipschitz, 3.5 + 1e-9);
  EXPECT_GE(s.claim.lipschitz, 2.0) << "far away it is off by the root of 2 over 0.5";
  EXPECT_EQ(scale(box(Vec3E(1.0)), Vec3E(0.5, 1.0, 2.0)).claim.kind, ClaimKind::Bound) << "faces are exact";
  EXPECT_EQ(s.bounds.max, glm::dvec3(0.5, 1.0, 2.0));
  expectClaim(s, cube(3.0), 6);
  expectClaim(scale(odd(), Vec3E(0.5, -1.0, 2.0)), cube(3.0), 7);
  const Expr wild = square(square(kX)) + square(kY) + square(kZ) - 0.25;
  expectSameSolid(scale(odd(), Vec3E(2.0, 1.0, 1.0)), Probe(remap(odd().distance, {kX * 0.5, kY, kZ}, 1.0)),
                  cube(3.0), 8);
  expectSameSolid(scale(field(wild, cube(1.0)), Vec3E(1.0, 3.0, 1.0)),
                  Probe(remap(wild, {kX, kY * (1.0 / 3.0), kZ}, 1.0)), cube(3.0), 9);
}

TEST(Scale, ByASliderThroughZeroHasNoNaN) {
  const Shape s = scale(sphere(1.0), slider("s", 1.0, -1.0, 2.0));
  ASSERT_TRUE(s.ok());
  EXPECT_EQ(s.bounds.max.x, 2.0);
  for (const double v : {-1.0, 0.0, 1.0})
    EXPECT_TRUE(std::isfinite(Probe(s.distance, {{"s", v}})(0.1, 0.2, 0.3)));
  EXPECT_EQ(Probe(s.distance, {{"s", -1.0}})(2.0, 0.0, 0.0), 1.0);
}

// A false fact about z itself would outlive the shape.
TEST(Scale, OfAFlatShapeLeavesZAsSteepAsItIs) {
  Material striped;
  striped.color = Vec3E(kZ);
  const Shape s = scale(circle(1.0).paint(std::move(striped)), 3.0);
  EXPECT_EQ(s.claim.kind, ClaimKind::Exact);
  EXPECT_EQ(s.distance.lipschitz(), 1.0);
  EXPECT_EQ(kZ.lipschitz(), 1.0);
}

TEST(Mirror, UnitesTheShapeWithItsImage) {
  const Shape s = odd();
  const Probe f(s.distance);
  for (const Vec3E& n :
       {Vec3E(1.0, 0.0, 0.0), Vec3E(0.0, -1.0, 0.0), Vec3E(0.0, 0.0, 1.0), Vec3E(1.0, 2.0, -0.5)}) {
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(uniformValue(n.x), uniformValue(n.y), uniformValue(n.z)));
    for (const double away : {0.0, 2.0, -2.0}) {  // across the plane, on one side, on the other
      const Vec3E to(normal * away);
      const Shape moved = translate(s, to), image = mirror(moved, n);
      const Probe g(image.distance), here(moved.distance);
      Points points(10);
      for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = points.in(cube(4.0)), q = p - 2.0 * glm::dot(p, normal) * normal;
        ASSERT_NEAR(g(p), std::min(here(p), here(q)), kRounding) << text(p);
      }
      expectClaim(image, cube(4.0), 11);
      if (away == 0.0) continue;
      EXPECT_LT(operations(image), 1.5 * operations(moved)) << "one side is evaluated once";
    }
  }
}

TEST(Mirror, OfAnExactShapeClearOfThePlaneStaysExact) {
  const auto at = [](double x) {
    return mirror(translate(sphere(0.5), Vec3E(x, 0.0, 0.0)), Vec3E(1.0, 0.0, 0.0));
  };
  EXPECT_EQ(at(1.0).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(at(-1.0).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(at(0.5).claim.kind, ClaimKind::ExactOutside);
  EXPECT_EQ(at(0.2).claim.kind, ClaimKind::ExactOutside);
  expectClaim(at(-1.0), cube(3.0), 12);
}

TEST(Mirror, CarriesTheColourAcross) {
  Material m;
  m.color = Vec3E(kX, 0.0, 0.0);
  const Shape s = mirror(translate(sphere(0.5).paint(m), Vec3E(1.0, 0.0, 0.0)), Vec3E(1.0, 0.0, 0.0));
  EXPECT_EQ(Probe(s.surface[0])(-1.25, 0.0, 0.0), 0.25);
}

// At a place that moves no faster than the position it is the moved shape's; elsewhere it is as steep as the
// place is fast.
TEST(DistanceAt, IsTheShapesDistanceThere) {
  const Shape s = odd();
  const Vec3E p(kX, kY, kZ), far(1.0, -2.0, 0.5);
  EXPECT_TRUE(distanceAt(s, p) == s.distance);
  EXPECT_TRUE(distanceAt(s, p - far) == translate(s, far).distance);
  EXPECT_DOUBLE_EQ(distanceAt(s, {kX * 2.0, kY * 2.0, kZ * 2.0}).lipschitz(), 2.0 * s.distance.lipschitz());
  EXPECT_EQ(distanceAt(sphere(1.0), {3.0, 0.0, 0.0}).constantValue(), 2.0);
  const Vec3E warped(kX + sin(kY) * 0.5, kY * kZ, kZ - kX * kX);
  const Probe there(distanceAt(s, warped)), f(s.distance);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2.0, 2.0);
  for (int i = 0; i < 100; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    EXPECT_EQ(there(x, y, z), f(x + std::sin(y) * 0.5, y * z, z - x * x));
  }
  EXPECT_EQ(distanceAt(s, warped).lipschitz(), kInfinity);  // kY * kZ has none
}

TEST(Place, FlatShapesStayInTheirPlane) {
  const Shape flat = rectangle(0.5, 0.2);
  EXPECT_EQ(translate(flat, Vec3E(1.0, 2.0, 0.0)).dimension, 2);
  EXPECT_TRUE(rotate(flat, Vec3E(0.0, 0.0, 0.3)).ok());
  EXPECT_TRUE(rotateAbout(flat, Vec3E(0.0, 0.0, 1.0), 0.3).ok());
  EXPECT_EQ(scale(flat, 2.0).claim.kind, ClaimKind::Exact);
  EXPECT_EQ(scale(flat, Vec3E(2.0, 2.0, 7.0)).claim.kind, ClaimKind::Exact);
  EXPECT_TRUE(mirror(flat, Vec3E(1.0, 1.0, 0.0)).ok());
  EXPECT_EQ(*rotate(flat, Vec3E(0.1, 0.0, 0.0)).error,
            "rotate: a flat shape turns about z only; extrude or revolve it first");
  EXPECT_EQ(*rotateAbout(flat, Vec3E(0.0, 1.0, 0.0), 0.1).error,
            "rotate_about: a flat shape turns about z only; extrude or revolve it first");
  EXPECT_EQ(*mirror(flat, Vec3E(0.0, 0.0, 1.0)).error,
            "mirror: a flat shape needs a normal without a z part");
}

TEST(Place, RefusesWhatCannotBeWithOneLine) {
  const Shape s = sphere(1.0);
  EXPECT_EQ(*translate(s, Vec3E(0.0, std::nan(""), 0.0)).error,
            "translate: offset.y must be a finite number, got nan");
  EXPECT_EQ(*translate(s, Vec3E(kX, 0.0, 0.0)).error, "translate: offset.x must not depend on position");
  EXPECT_EQ(*rotate(s, Vec3E(0.0, 0.0, kInfinity)).error,
            "rotate: angles.z must be a finite number, got inf");
  EXPECT_EQ(*rotateAbout(s, Vec3E(0.0), 1.0).error, "rotate_about: axis must not be {0, 0, 0}");
  EXPECT_EQ(*scale(s, 0.0).error, "scale: factor.x must be other than 0, got 0");
  EXPECT_EQ(*scale(s, Vec3E(1.0, 1.0, 0.0)).error, "scale: factor.z must be other than 0, got 0");
  EXPECT_EQ(*mirror(s, Vec3E(0.0)).error, "mirror: normal must not be {0, 0, 0}");
}

TEST(Place, PassesOnAFailure) {
  const Shape bad = Shape::failed("bad");
  for (const Shape& s : {translate(bad, Vec3E(1.0)), rotate(bad, Vec3E(1.0)),
                         rotateAbout(bad, Vec3E(1.0), 1.0), scale(bad, 2.0), mirror(bad, Vec3E(1.0))})
    EXPECT_EQ(*s.error, "bad");
}

}  // namespace place_test
}  // namespace sdf
