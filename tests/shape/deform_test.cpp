#include "sdf/shape/operators/deform.h"

#include <numbers>

#include "claim_checks.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"
#include "support/bind.h"

namespace sdf {
namespace deform_test {

constexpr double kPi = std::numbers::pi;
const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

// A parameter that is known to have this value.
Expr known(double v) { return Expr::parameter({"known", v, v, v}); }

Shape bar() { return box(Vec3E(1.0, 0.2, 0.3)); }
Shape post() { return box(Vec3E(0.3, 1.0, 0.2)); }

// A shape with no symmetry, exact outside, and one that is a bound only.
Shape odd() {
  return translate(box(Vec3E(0.5, 0.3, 0.2)), Vec3E(0.2, 0.1, 0.0)) |
         translate(sphere(0.3), Vec3E(0.6, 0.4, 0.3));
}
Shape carved() { return odd() - translate(sphere(0.3), Vec3E(0.3, 0.4, 0.1)); }

// The largest difference quotient met on short steps within the box.
double steepestMet(const Shape& s, const Box& where, unsigned seed) {
  const Probe f(s.distance);
  Points points(seed);
  double most = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const glm::dvec3 p = points.in(where), q = p + 1e-5 * points.direction();
    most = std::max(most, std::abs(f(p) - f(q)) / 1e-5);
  }
  return most;
}

TEST(Morph, GoesFromOneShapeToTheOther) {
  const Shape a = sphere(0.8), b = box(Vec3E(0.5, 0.7, 0.9));
  Points points(1);
  const Probe fa(a.distance), fb(b.distance), start(morph(a, b, 0.0).distance),
      end(morph(a, b, 1.0).distance);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    ASSERT_NEAR(start(p), fa(p), kRounding);
    ASSERT_NEAR(end(p), fb(p), kRounding);
  }
  for (const double t : {0.0, 0.3, 1.0}) {
    const Shape s = morph(a, b, t);
    EXPECT_EQ(s.claim.kind, ClaimKind::Bound);
    EXPECT_EQ(s.distance.lipschitz(), 1.0);
    expectClaim(s, cube(2.0), 2);
  }
}

TEST(Morph, MixesTheMaterialsAlike) {
  Material red, green;
  red.color = Vec3E(1.0, 0.0, 0.0), green.color = Vec3E(0.0, 1.0, 0.0);
  const Shape a = sphere(0.8).paint(red), b = sphere(0.5).paint(green), s = morph(a, b, 0.25);
  EXPECT_EQ(Probe(s.surface[0])(0.0, 0.0, 0.0), 0.75);
  EXPECT_EQ(Probe(s.surface[1])(0.0, 0.0, 0.0), 0.25);
  const auto id = [](const Shape& m) {
    return Probe(m.surface[static_cast<int>(Attribute::MaterialId)])(0.0, 0.0, 0.0);
  };
  EXPECT_EQ(id(s), 0.0);
  EXPECT_EQ(id(morph(a, b, 0.75)), 1.0);
  EXPECT_EQ(s.materials, (std::vector{a.materials[0], b.materials[0]}));
}

TEST(Morph, StaysBetweenTheShapesOverASlidersWholeRange) {
  const Shape s = morph(sphere(0.8), sphere(0.5), slider("t", 0.5, -2.0, 3.0));
  EXPECT_NEAR(Probe(s.distance, {{"t", 3.0}})(1.0, 0.0, 0.0), 0.5, kRounding);
  EXPECT_NEAR(Probe(s.distance, {{"t", -2.0}})(1.0, 0.0, 0.0), 0.2, kRounding);
  EXPECT_EQ(s.claim.kind, ClaimKind::Bound);
}

TEST(Round, GrowsByTheRadius) {
  const Shape s = round(box(Vec3E(0.5)), 0.25);
  EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
  EXPECT_EQ(s.bounds.max, glm::dvec3(0.75));
  EXPECT_EQ(Probe(s.distance)(1.0, 0.0, 0.0), 0.25);
  expectClaim(s, cube(2.0), 3);
  expectClaim(round(carved(), 0.1), cube(2.0), 4);
  expectClaim(round(odd(), 0.1), cube(2.0), 5);
}

TEST(Round, OfAScaledBoxGrowsByTheRadius) {
  const Shape thin = scale(box(Vec3E(1.0)), Vec3E(0.25, 1.0, 1.0));
  expectClaim(round(thin, 0.2), cube(3.0), 6);
  const Probe f(round(thin, 0.2).distance), same(round(box(Vec3E(0.25, 1.0, 1.0)), 0.2).distance);
  Points points(6);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    ASSERT_NEAR(f(p), same(p), kRounding) << text(p);
  }
}

TEST(Shell, IsTheSkinOnBothSides) {
  const Shape s = shell(sphere(1.0), 0.2);
  const Probe f(s.distance);
  for (const double r : {0.9, 1.1}) EXPECT_NEAR(f(r, 0.0, 0.0), 0.0, kRounding);
  EXPECT_NEAR(f(0.0, 0.0, 0.0), 0.9, kRounding);
  EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
  EXPECT_NEAR(s.bounds.max.x, 1.1, kRounding);
  expectClaim(s, cube(2.0), 7);
  expectClaim(shell(box(Vec3E(0.5, 0.7, 0.9)), 0.3), cube(2.0), 8);
  // Inside it has the distance to the edge where box and ball meet, whose slope is no longer 1.
  EXPECT_EQ(shell(odd(), 0.1).claim.kind, ClaimKind::Field);
  EXPECT_LT(shell(odd(), 0.1).claim.lipschitz, 2.0);
  expectClaim(shell(odd(), 0.1), cube(2.0), 9);
  expectClaim(shell(shell(sphere(1.0), 0.4), 0.1), cube(2.0), 10);
}

TEST(Elongate, FillsTheGapWithCrossSections) {
  const Shape s = elongate(sphere(0.5), Vec3E(1.0, 0.0, 0.5));
  const Probe f(s.distance);
  EXPECT_NEAR(f(1.5, 0.0, 0.0), 0.0, kRounding);
  EXPECT_NEAR(f(0.3, 0.5, 0.2), 0.0, kRounding);
  EXPECT_NEAR(f(0.0, 0.0, 1.0), 0.0, kRounding);
  EXPECT_EQ(s.bounds.max, glm::dvec3(1.5, 0.5, 1.0));
  expectClaim(s, cube(3.0), 11);
  expectClaim(elongate(carved(), Vec3E(0.3, 0.2, 0.1)), cube(3.0), 12);
  EXPECT_EQ(elongate(sphere(0.5), Vec3E(0.0)).distance, sphere(0.5).distance);
}

TEST(Displace, AddsTheSlopes) {
  const Shape s = displace(sphere(1.0), 0.1, 8.0);
  EXPECT_EQ(s.claim.kind, ClaimKind::Field);
  EXPECT_NEAR(s.distance.lipschitz(), 1.8, 1e-9);
  EXPECT_NEAR(s.bounds.max.x, 1.1, 1e-9);
  expectClaim(s, cube(2.0), 13);
  expectClaim(displace(carved(), -0.05, 10.0), cube(2.0), 14);
}

TEST(Displace, HasTheTightConstant) {
  // Of a distance that is 0 the wave alone is left. Its slope reaches amplitude times frequency where one
  // sine crosses 0 and the others peak.
  const double amplitude = 0.1, frequency = 18.0;
  Shape nothing;
  nothing.distance = 0.0;
  nothing.claim = {ClaimKind::Field, 0.0};
  const Shape wave = displace(nothing, amplitude, frequency);
  EXPECT_GT(steepestMet(wave, cube(0.8), 15), 0.98 * amplitude * frequency);
  EXPECT_LE(steepestMet(wave, cube(0.8), 15), amplitude * frequency * (1.0 + 1e-9));
}

TEST(Displace, ByAnyExpressionCarvesWherePositive) {
  const Shape s = displace(sphere(1.0), sin(kY * 5.0) * 0.1);
  const Probe f(s.distance);
  EXPECT_GT(f(0.0, 1.0, 0.0) * std::sin(5.0), 0.0);
  expectClaim(s, cube(2.0), 16);
  const Shape steps = displace(sphere(1.0), floor(kY * 5.0) * 0.01);
  EXPECT_EQ(steps.claim.kind, ClaimKind::Field);
  EXPECT_EQ(steps.claim.lipschitz, kInfinity);
}

TEST(Extrude, IsAsExactAsTheFlatShape) {
  const Shape s = extrude(circle(0.5), 0.8);
  EXPECT_EQ(s.dimension, 3);
  EXPECT_EQ(s.claim.kind, ClaimKind::Exact);
  EXPECT_EQ(s.distance.lipschitz(), 1.0);
  EXPECT_EQ(s.bounds.max, glm::dvec3(0.5, 0.5, 0.8));
  expectClaim(s, cube(2.0), 17);
  const Shape cut = extrude(rectangle(0.6, 0.4) - circle(0.3), 0.2);
  EXPECT_EQ(cut.claim.kind, ClaimKind::Bound);
  expectClaim(cut, cube(2.0), 18);
}

TEST(Revolve, SweepsAroundY) {
  const Shape s = revolve(circle(0.25), 1.0);
  EXPECT_EQ(s.claim.kind, ClaimKind::Exact);
  EXPECT_EQ(s.bounds.max, glm::dvec3(1.25, 0.25, 1.25));
  const Probe f(s.distance), same(torus(1.0, 0.25).distance);
  Points points(19);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    ASSERT_NEAR(f(p), same(p), kRounding);
  }
  expectClaim(s, cube(2.0), 20);
}

TEST(Revolve, SweepsPartOfATurn) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  for (const double degrees : {1.0, 50.0, 180.0, 271.0, 359.0}) {
    const Shape s = revolve(rectangle(0.2, 0.25), 1.0, degrees * kDegree);
    EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
    const Probe f(s.distance);
    Points points(19);
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 p = points.in(cube(1.5));
      const double rho = std::hypot(p.x, p.z), angle = std::abs(std::atan2(p.z, p.x));
      const bool inside =
          std::abs(rho - 1.0) < 0.2 && std::abs(p.y) < 0.25 && angle < 0.5 * degrees * kDegree;
      ASSERT_EQ(f(p) < 0.0, inside) << degrees << " degrees at " << test::text(p);
      ASSERT_TRUE(!inside || s.bounds.contains({p, p})) << degrees;
    }
    expectClaim(s, cube(2.0), 20);
    expectClaim(revolve(polygon(std::vector<glm::dvec2>{{-0.3, -0.2}, {0.4, 0.0}, {0.1, 0.5}}), 0.0,
                        degrees * kDegree),
                cube(1.0), 21);
  }
}

TEST(Revolve, HasNoSeamWhereAParameterCompletesTheTurn) {
  const Expr turn = Expr::parameter({"turn", 2.0 * std::numbers::pi, 0.0, 2.0 * std::numbers::pi});
  const Probe f(revolve(circle(0.25), 1.0, turn).distance), same(torus(1.0, 0.25).distance);
  Points points(22);
  for (int i = 0; i < 1000; ++i) {
    glm::dvec3 p = points.in(cube(1.5));
    if (i % 2 == 0) p.x = -1.0 + 0.1 * p.x, p.z *= 1e-3, p.y *= 0.1;
    ASSERT_NEAR(f(p), same(p), kRounding);
  }
}

TEST(Revolve, IsExactAcrossTheAxisOnlyForAMirrorImage) {
  EXPECT_EQ(revolve(rectangle(0.5, 0.3)).claim.kind, ClaimKind::Exact);
  expectClaim(revolve(rectangle(0.5, 0.3)), cube(2.0), 21);
  const Shape skew = revolve(translate(rectangle(0.5, 0.3), Vec3E(-0.3, 0.0, 0.0)));
  EXPECT_EQ(skew.claim.kind, ClaimKind::Bound);
  EXPECT_NEAR(skew.bounds.max.x, 0.2, kRounding);
  expectClaim(skew, cube(2.0), 22);
}

TEST(Revolve, OfWhatStandsOnTheAxisIsExactOnlyOutside) {
  // The flat shape's edge along the axis lies within the solid: from near it, the surface is farther than
  // that edge.
  const Shape s = revolve(translate(rectangle(0.5, 0.5), Vec3E(0.5, 0.0, 0.0)));
  EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
  EXPECT_NEAR(Probe(s.distance)(0.1, 0.0, 0.0), -0.1, kRounding);
  expectClaim(s, cube(2.0), 31);
}

TEST(Twist, TurnsWithHeight) {
  const double rate = 1.3;
  const Shape s = twist(post(), rate);
  EXPECT_LT(s.claim.lipschitz, 1.7);
  for (const double y : {-0.9, 0.0, 0.5}) {
    // The section at height y is the box's, turned by rate * y about y.
    const Probe turned(rotate(post(), Vec3E(0.0, rate * y, 0.0)).distance), f(s.distance);
    Points points(23);
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 p(points.uniform(-0.5, 0.5), y, points.uniform(-0.5, 0.5));
      if (std::abs(turned(p)) < 1e-9) continue;
      ASSERT_EQ(f(p) < 0.0, turned(p) < 0.0) << text(p);
    }
  }
  expectClaim(s, cube(2.0), 24);
  expectClaim(s, cube(8.0), 25);
  expectClaim(twist(carved(), -2.0), cube(3.0), 26);
}

TEST(Twist, HasTheTightConstant) {
  // A shear by a stretches most along (a, s^2 - 1) / norm for the largest singular value s; with a = 2 that
  // is a normal tilted by pi / 8. A plate with this normal at the clamp radius meets the bound but for the
  // margin, 1/16 of the radius.
  const Shape plate = rotate(box(Vec3E(1.0, 0.6, 0.02)), Vec3E(-kPi / 8.0, 0.0, 0.0));
  for (const double rate : {2.0, -2.0}) {
    const Shape s = twist(plate, rate);
    expectLipschitz(s, cube(1.3), 27, 200000);
  }
  EXPECT_GT(
      std::max(steepestMet(twist(plate, 2.0), cube(1.1), 47), steepestMet(twist(plate, -2.0), cube(1.1), 48)),
      0.9);
}

TEST(Twist, KeepsToTheConstantsThatAreClaimedWithin) {
  const Shape lattice = intersect(box(Vec3E(0.8)), gyroid(0.5, 0.05));
  EXPECT_LT(twist(lattice, 0.6).claim.lipschitz, 2.0) << "the formula's own is a hundred times as much";
  expectClaim(twist(lattice, 0.6), cube(1.5), 49);
}

TEST(Twist, OfAnUnboundedShapeIsAField) {
  const Shape s = twist(plane(Vec3E(1.0, 0.0, 0.0), 0.0), 1.0);
  EXPECT_EQ(s.claim.kind, ClaimKind::Field);
  EXPECT_EQ(s.claim.lipschitz, kInfinity);
  EXPECT_EQ(s.bounds.min, glm::dvec3(-kInfinity));
  EXPECT_EQ(s.bounds.max, glm::dvec3(kInfinity));
  const Shape column = twist(box(Vec3E(0.3, 1.0, 0.2)), 0.0);
  EXPECT_EQ(column.claim.kind, ClaimKind::Exact) << "no twist at all changes nothing";
}

TEST(Bend, LaysABarAroundACircle) {
  const double curvature = 0.8, radius = 1.0 / curvature;
  const Shape s = bend(bar(), curvature);
  EXPECT_LT(s.claim.lipschitz, 2.5);
  const Probe f(s.distance), straight(bar().distance);
  Points points(28);
  for (int i = 0; i < 5000; ++i) {
    // The point at arc length u along the circle, v towards its centre.
    const double u = points.uniform(-1.2, 1.2), v = points.uniform(-0.4, 0.4), z = points.uniform(-0.5, 0.5);
    const glm::dvec3 p((radius - v) * std::sin(u / radius), radius - (radius - v) * std::cos(u / radius), z);
    if (std::abs(straight(u, v, z)) < 1e-9) continue;
    ASSERT_EQ(f(p) < 0.0, straight(u, v, z) < 0.0) << u << ", " << v;
  }
  expectClaim(s, cube(2.0), 29);
  expectClaim(s, cube(8.0), 30);
}

TEST(Bend, HoldsItsClaimEitherWayAndNearlyClosed) {
  expectClaim(bend(bar(), -0.8), cube(3.0), 31);
  expectClaim(bend(bar(), 3.0), cube(2.0), 32);
  expectClaim(bend(translate(carved(), Vec3E(0.0, -0.5, 0.0)), 1.5), cube(3.0), 33);
  expectClaim(bend(translate(odd(), Vec3E(-0.3, 0.2, 0.0)), 0.9), cube(3.0), 34);
  expectClaim(bend(cylinder(0.4, 0.3), 0.001), cube(2.0), 35);
}

TEST(Bend, BySoLittleThatTheRadiusSwallowsTheShapeKeepsItsBounds) {
  const Box straight = bar().bounds;
  for (const double curvature : {1e-9, 1e-18, -1e-30}) {
    const Box bent = bend(bar(), curvature).bounds;
    // It sags by x^2 curvature / 2 and leans by y x curvature.
    const glm::dvec3 slack(4.0 * std::abs(curvature) + kRounding);
    EXPECT_TRUE((Box{straight.min - slack, straight.max + slack}.contains(bent))) << curvature;
    EXPECT_TRUE((Box{bent.min - slack, bent.max + slack}.contains(straight))) << curvature;
  }
}

TEST(Bend, ByLessThanAFloatCanSayIsNone) {
  EXPECT_EQ(bend(bar(), 1e-160).distance, bar().distance);
  EXPECT_EQ(bend(bar(), -9e-31).distance, bar().distance);
}

TEST(Bend, ByASliderFromZeroHoldsForEveryValue) {
  const Shape s = bend(bar(), slider("k", 0.5, 0.0, 1.5));
  for (const double k : {0.0, 1e-9, 0.3, 1.5}) {
    Shape now = s;
    now.distance = test::bind(s.distance, {{"k", k}});
    expectLipschitz(now, cube(2.0), 36);
    expectBounded(now, cube(3.0), 37);
  }
  const Probe flat(s.distance, {{"k", 0.0}}), straight(bar().distance);
  // At a curvature of a hair a bar of length 1 sags by less than that.
  Points points(38);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(1.5));
    if (std::abs(straight(p)) < 1e-5) continue;
    ASSERT_EQ(flat(p) < 0.0, straight(p) < 0.0) << text(p);
  }
}

TEST(Taper, ScalesTheCrossSectionWithHeight) {
  const Shape s = taper(post(), -0.4);
  EXPECT_LT(s.claim.lipschitz, 1.7);
  const Probe f(s.distance);
  EXPECT_NEAR(f(0.3, 0.0, 0.0), 0.0, kRounding);
  EXPECT_NEAR(f(0.3 * 0.6, 0.99, 0.0), 0.0, 0.01);
  const Vec3E p = position();
  const Expr factor = 1.0 / (p.y * -0.4 + 1.0);
  expectSameSolid(s, Probe(remap(post().distance, {p.x * factor, p.y, p.z * factor}, kInfinity)),
                  {glm::dvec3(-1.0, -1.1, -1.0), glm::dvec3(1.0, 1.1, 1.0)}, 39);
  expectClaim(s, cube(2.0), 40);
  expectClaim(s, cube(8.0), 41);
  expectClaim(taper(carved(), 0.9), cube(3.0), 42);
  expectClaim(taper(translate(odd(), Vec3E(0.0, 3.0, 0.0)), -0.2),
              {glm::dvec3(-2.0, 1.0, -2.0), glm::dvec3(2.0, 5.0, 2.0)}, 43);
}

TEST(Warps, CarryColoursAlong) {
  Material m;
  m.color = Vec3E(kX, kY, kZ);
  const Shape s = twist(post().paint(m), kPi / 2.0);
  // At height 1 the section has turned a quarter about y: what was at +x is at -z.
  EXPECT_NEAR(Probe(s.surface[0])(0.0, 1.0, -0.25), 0.25, kRounding);
  const Shape b = bend(bar().paint(m), 1.0);
  EXPECT_NEAR(Probe(b.surface[0])(std::sin(0.7), 1.0 - std::cos(0.7), 0.0), 0.7, kRounding);
}

TEST(Warps, CanBeStackedAndBlended) {
  const Shape s = bend(rotate(twist(box(Vec3E(0.2, 1.0, 0.2)), 1.5), Vec3E(0.0, 0.0, kPi / 2.0)), 1.0);
  expectClaim(s, cube(2.0), 44);
  const Shape blended = unite(s, translate(sphere(0.4), Vec3E(0.9, 0.4, 0.0)), Blend::quadratic(0.3));
  EXPECT_TRUE(blended.bounds.finite());
  expectClaim(blended, cube(3.0), 45);
  expectBounded(blended, cube(30.0), 46);
}

TEST(Deform, RefusesWhatCannotBeWithOneLine) {
  const Shape s = sphere(1.0), flat = circle(1.0), half = plane(Vec3E(0.0, 1.0, 0.0), 0.0);
  EXPECT_EQ(*morph(s, s, 1.5).error, "morph: t must lie in 0 to 1, got 1.5");
  EXPECT_EQ(*morph(s, flat, 0.5).error,
            "morph: one shape is flat and the other solid; extrude or revolve the flat one first");
  EXPECT_EQ(*round(s, -0.1).error, "round: radius must be 0 or more, got -0.1");
  EXPECT_EQ(*shell(s, 0.0).error, "shell: thickness must be positive, got 0");
  EXPECT_EQ(*elongate(s, Vec3E(0.0, -1.0, 0.0)).error, "elongate: half.y must be 0 or more, got -1");
  EXPECT_EQ(*displace(flat, 0.1, 5.0).error, "displace: the shape is flat; extrude or revolve it first");
  EXPECT_EQ(*displace(flat, sin(kZ)).error, "displace: the offset of a flat shape must not depend on z");
  EXPECT_EQ(*displace(s, std::nan(""), 5.0).error, "displace: amplitude must be a finite number, got nan");
  EXPECT_EQ(*extrude(s, 1.0).error,
            "extrude: the shape is solid already; give it a flat one, such as a circle");
  EXPECT_EQ(*extrude(flat, 0.0).error, "extrude: half_height must be positive, got 0");
  EXPECT_EQ(*revolve(s).error, "revolve: the shape is solid already; give it a flat one, such as a circle");
  EXPECT_EQ(*revolve(flat, -2.0).error,
            "revolve: the flat shape lies at x < 0 altogether; move it or give it an offset");
  EXPECT_EQ(*twist(flat, 1.0).error, "twist: the shape is flat; extrude or revolve it first");
  EXPECT_EQ(*bend(flat, 1.0).error, "bend: the shape is flat; extrude or revolve it first");
  EXPECT_EQ(*bend(half, 0.1).error, "bend: the shape is unbounded in x; intersect it with a box first");
  EXPECT_EQ(*bend(s, 1.0).error,
            "bend: the shape would fold: it reaches the circle's centre, 1 from the x axis; use a rate "
            "nearer to 0 or make it thinner");
  EXPECT_EQ(
      *bend(bar(), 4.0).error,
      "bend: the ends would pass each other: the shape reaches 1 along x, and half a turn ends at 0.785398; "
      "use a rate nearer to 0");
  EXPECT_EQ(*taper(flat, 0.1).error, "taper: the shape is flat; extrude or revolve it first");
  EXPECT_EQ(*taper(half, 0.1).error, "taper: the shape is unbounded in y; intersect it with a box first");
  EXPECT_EQ(
      *taper(s, -1.0).error,
      "taper: the cross section shrinks to nothing before y = 1, within the shape; use a rate nearer to 0");
}

TEST(Deform, PassesOnAFailure) {
  const Shape bad = Shape::failed("bad"), s = sphere(1.0);
  for (const Shape& r : {morph(bad, s, 0.5), morph(s, bad, 0.5), round(bad, 0.1), shell(bad, 0.1),
                         elongate(bad, Vec3E(0.1)), displace(bad, 0.1), displace(bad, 0.1, 1.0),
                         extrude(bad, 1.0), revolve(bad), twist(bad, 1.0), bend(bad, 1.0), taper(bad, 0.1)})
    EXPECT_EQ(*r.error, "bad");
}

// Balls beside each other, warped: operations for each.
double operationsOfEach(int count) {
  std::vector<Shape> balls;
  for (int i = 0; i < count; ++i) balls.push_back(translate(sphere(0.1), Vec3E(0.3 * i, 0.1 * i, 0.0)));
  const Expr distance = twist(unite(balls), 0.2).distance;
  return static_cast<double>(topologicalOrder({&distance, 1}).size()) / count;
}

TEST(Warp, DozensOfBallsAreAsCheapAsTheirLengths) {
  EXPECT_GT(operationsOfEach(8), 40.0) << "each is divided by its own slope";
  EXPECT_LT(operationsOfEach(64), 20.0) << "a length, a radius, and what is taken of all";
}

// Slopes, bounds and distances are those of the number.
TEST(Deform, OfKnownParametersIsThatOfNumbers) {
  const auto shapes = [](const auto& of) {
    return std::vector{bend(bar(), of(0.6)), twist(post(), of(0.9)), taper(post(), of(-0.3)),
                       bend(rotate(bar() | sphere(0.4), Vec3E(of(0.4), 0.0, of(0.2))), of(0.3)),
                       shell(twist(round(post(), of(0.1)), of(1.3)), of(0.05))};
  };
  const std::vector<Shape> numbers = shapes([](double v) { return Expr(v); }), same = shapes(known);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_TRUE(same[i].ok());
    EXPECT_NEAR(slopeOf(same[i]), slopeOf(numbers[i]), 1e-9 * slopeOf(numbers[i]));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(same[i].bounds.min[axis], numbers[i].bounds.min[axis], 1e-12);
      EXPECT_NEAR(same[i].bounds.max[axis], numbers[i].bounds.max[axis], 1e-12);
    }
    const Tape a(same[i].distance), b(numbers[i].distance);
    for (const glm::dvec3& p :
         {glm::dvec3(0.1, 0.2, 0.3), glm::dvec3(1.1, 0.6, -0.4), glm::dvec3(-0.8, 0.9, 2.0)})
      EXPECT_NEAR(evaluate(a, p), evaluate(b, p), 1e-9);
  }
}

}  // namespace deform_test
}  // namespace sdf
