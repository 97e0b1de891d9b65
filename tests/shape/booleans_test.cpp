#include "sdf/shape/operators/booleans.h"

#include <set>

#include "claim_checks.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace booleans_test {

using Kind = Blend::Kind;

Shape ball(double x, double y, double z, double radius) { return translate(sphere(radius), Vec3E(x, y, z)); }

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y);

// A half space whose distance is a coordinate: blends of two show the blend itself.
Shape left() { return plane(Vec3E(1.0, 0.0, 0.0), 0.0); }
Shape below() { return plane(Vec3E(0.0, 1.0, 0.0), 0.0); }

std::vector<Blend> smoothBlends(const Expr& k) {
  return {Blend::quadratic(k), Blend::cubic(k), Blend::exponential(k), Blend::chamfer(k)};
}

double depthAtTie(Kind kind, double k) {
  switch (kind) {
    case Kind::Quadratic:
      return k / 4.0;
    case Kind::Cubic:
      return k / 6.0;
    case Kind::Exponential:
      return k * std::log(2.0);
    case Kind::Chamfer:
      return k / 2.0;
    default:
      return 0.0;
  }
}

double attribute(const Shape& s, Attribute which, const glm::dvec3& p) {
  return Probe(s.surface[static_cast<int>(which)])(p);
}

Shape red(const Shape& s) {
  Material m;
  m.color = Vec3E(1.0, 0.0, 0.0);
  return s.paint(m);
}
Shape green(const Shape& s) {
  Material m;
  m.color = Vec3E(0.0, 1.0, 0.0);
  return s.paint(m);
}

TEST(Union, IsTheMinimumWhateverTheNumberOfShapes) {
  std::vector<Shape> shapes;
  for (int i = 0; i < 7; ++i) shapes.push_back(ball(std::sin(i), std::cos(2.0 * i), 0.3 * i, 0.2 + 0.05 * i));
  const Probe f(unite(shapes).distance);
  Points points(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(3.0));
    double least = kInfinity;
    for (const Shape& s : shapes) least = std::min(least, Probe(s.distance)(p));
    ASSERT_EQ(f(p), least) << text(p);
  }
}

TEST(Union, OfManyIsABalancedTree) {
  std::vector<Shape> shapes;
  for (int i = 0; i < 64; ++i) shapes.push_back(ball(i, 0.0, 0.0, 0.1));
  int depth = 0;
  for (Expr e = unite(shapes).distance; e.op() == Op::Min; e = e.arg(0)) ++depth;
  EXPECT_EQ(depth, 6);
}

TEST(Union, OfAUnionAndOneMoreSharesItsList) {
  const Shape three = ball(0, 0, 0, 1) | ball(2, 0, 0, 1) | ball(4, 0, 0, 1);
  const Shape four = three | ball(6, 0, 0, 1), other = three | ball(0, 6, 0, 1);
  EXPECT_EQ(four.outer->operands.data(), three.outer->operands.data());
  EXPECT_EQ(three.outer->operands.size(), 3u);
  ASSERT_EQ(four.outer->operands.size(), 4u);
  ASSERT_EQ(other.outer->operands.size(), 4u);
  EXPECT_EQ(four.outer->operands[3].bounds.centre(), glm::dvec3(6, 0, 0));
  EXPECT_EQ(other.outer->operands[3].bounds.centre(), glm::dvec3(0, 6, 0));
}

TEST(Union, OfExactShapesIsExactOutside) {
  const Shape s = ball(-0.5, 0.0, 0.0, 0.7) | translate(box(Vec3E(0.4)), Vec3E(0.6, 0.2, 0.0));
  EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
  EXPECT_EQ(s.claim.lipschitz, 1.0);
  expectClaim(s, cube(2.0), 2);
}

TEST(Booleans, HoldTheirClaims) {
  const Shape a = ball(-0.3, 0.0, 0.0, 0.8), b = translate(box(Vec3E(0.5, 0.3, 0.6)), Vec3E(0.4, 0.3, 0.0));
  const Shape c = torus(0.8, 0.2);
  for (const Blend& blend : {Blend::hard(), Blend::quadratic(0.3), Blend::cubic(0.4), Blend::exponential(0.1),
                             Blend::chamfer(0.25)}) {
    SCOPED_TRACE(static_cast<int>(blend.kind));
    for (const Shape& s : {unite({a, b, c}, blend), intersect({a, b, c}, blend), subtract({a, b, c}, blend),
                           exclude({a, b, c}, blend)}) {
      EXPECT_LE(s.claim.kind, ClaimKind::Bound);
      EXPECT_LE(s.claim.lipschitz, 1.0);
      EXPECT_LE(s.distance.lipschitz(), 1.0);
      expectClaim(s, cube(2.0), 3);
    }
  }
}

TEST(Booleans, MeanWhatTheyAreCalled) {
  const Shape a = ball(0.0, 0.0, 0.0, 1.0), b = ball(0.8, 0.0, 0.0, 1.0), c = ball(0.0, 0.8, 0.0, 1.0);
  const Probe fa(a.distance), fb(b.distance), fc(c.distance);
  const Probe all(intersect({a, b, c}).distance), any(unite({a, b, c}).distance);
  const Probe rest(subtract({a, b, c}).distance), odd(exclude({a, b, c}).distance);
  Points points(4);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    const bool inA = fa(p) < 0.0, inB = fb(p) < 0.0, inC = fc(p) < 0.0;
    ASSERT_EQ(any(p) < 0.0, inA || inB || inC) << text(p);
    ASSERT_EQ(all(p) < 0.0, inA && inB && inC) << text(p);
    ASSERT_EQ(rest(p) < 0.0, inA && !inB && !inC) << text(p);
    ASSERT_EQ(odd(p) < 0.0, inA ^ inB ^ inC) << text(p);
  }
}

TEST(Booleans, HaveOperators) {
  const Shape a = sphere(1.0), b = box(Vec3E(0.7));
  EXPECT_EQ((a | b).distance, unite(a, b).distance);
  EXPECT_EQ((a & b).distance, intersect(a, b).distance);
  EXPECT_EQ((a - b).distance, subtract(a, b).distance);
  EXPECT_EQ((a ^ b).distance, exclude(a, b).distance);
}

TEST(SmoothUnion, IsSymmetricBelowTheHardOneAndEqualToItAwayFromTheSeam) {
  constexpr double kWidth = 0.4;
  for (const Blend& blend : smoothBlends(kWidth)) {
    SCOPED_TRACE(static_cast<int>(blend.kind));
    const Probe smooth(unite(left(), below(), blend).distance),
        swapped(unite(below(), left(), blend).distance);
    const double deepest = depthAtTie(blend.kind, kWidth);
    Points points(5);
    for (int i = 0; i < 5000; ++i) {
      const glm::dvec3 p = points.in(cube(1.0));
      const double hard = std::min(p.x, p.y), value = smooth(p);
      ASSERT_NEAR(value, swapped(p), kRounding);
      ASSERT_LE(value, hard + kRounding);
      ASSERT_GE(value, hard - deepest - kRounding);
      if (blend.kind != Kind::Exponential && std::abs(p.x - p.y) >= kWidth) {
        ASSERT_EQ(value, hard) << text(p);
      }
    }
    EXPECT_NEAR(smooth(0.3, 0.3, 0.0), 0.3 - deepest, kRounding) << "deepest where the distances are equal";
  }
}

TEST(SmoothIntersection, IsTheComplementOfTheUnionOfComplements) {
  for (const Blend& blend : smoothBlends(0.4)) {
    const Probe upper(intersect(left(), below(), blend).distance),
        lower(unite(left(), below(), blend).distance);
    Points points(6);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 p = points.in(cube(1.0));
      ASSERT_NEAR(upper(p), -lower(-p), kRounding);
    }
  }
}

TEST(SmoothUnion, JoinsSmoothlyToTheOrderItPromises) {
  constexpr double kWidth = 0.5, kStep = 1e-4;
  // Along x + y = 0 the blend's ends are at x - y = +-k. The n-th difference quotient there jumps by n! / 2n
  // k^(n-1) for the first discontinuous derivative n, and by O(step) for the lower ones.
  const auto jump = [&](const Blend& blend, int order) {
    const Probe f(unite(left(), below(), blend).distance);
    const auto at = [&](double s) {
      return f(0.5 * s, -0.5 * s, 0.0) + 0.5 * std::abs(s);
    };  // difference to hard
    const double s = kWidth - 5.0 * kStep;
    const double first = (at(s + kStep) - at(s)) / kStep;
    const double second = (at(s + 2.0 * kStep) - 2.0 * at(s + kStep) + at(s)) / (kStep * kStep);
    return std::abs(order == 1 ? first : second);
  };
  EXPECT_GT(jump(Blend::chamfer(kWidth), 1), 0.1);
  EXPECT_LT(jump(Blend::quadratic(kWidth), 1), 10.0 * kStep / kWidth);
  EXPECT_GT(jump(Blend::quadratic(kWidth), 2), 0.1);
  EXPECT_LT(jump(Blend::cubic(kWidth), 2), 10.0 * kStep / (kWidth * kWidth));
}

TEST(SmoothBooleans, ShowTheMeanOfTheGradientsWhereTheDistancesAreEqual) {
  // Half way between two balls, on a plane of symmetry: no part of the gradient may point across it.
  const Shape left = translate(sphere(1.0), Vec3E(-0.5, 0.0, 0.0)),
              right = translate(sphere(1.0), Vec3E(0.5, 0.0, 0.0));
  for (const Blend& blend :
       {Blend::quadratic(0.3), Blend::cubic(0.3), Blend::exponential(0.3), Blend::chamfer(0.3)})
    for (const Shape& s :
         {unite(left, right, blend), intersect(left, right, blend), exclude(left, right, blend)})
      EXPECT_NEAR(evaluateGradient(Tape(s.distance), {0.0, 0.9, 0.2}).gradient.x, 0.0, kRounding)
          << "blend " << static_cast<int>(blend.kind);
}

TEST(Chamfer, IsAFlatBevelWhereTheDistancesSumToItsWidth) {
  const Probe f(unite(left(), below(), Blend::chamfer(0.4)).distance);
  for (const double x : {0.05, 0.2, 0.35}) EXPECT_NEAR(f(x, 0.4 - x, 0.0), 0.0, kRounding);
}

TEST(ExponentialUnion, DoesNotOverflowAndDoesNotDependOnOrder) {
  const Expr huge = kX * 1e30;
  const Shape a = field(huge, Box::everything()), b = field(huge - 1.0, Box::everything());
  for (const Blend& blend : {Blend::exponential(1e-3), Blend::exponential(10.0)})
    for (const Shape& s : {unite({a, b}, blend), unite({a, b, a}, blend), intersect({a, b}, blend)})
      for (const double x : {-1e8, -1.0, 0.0, 1.0, 1e8})
        EXPECT_TRUE(std::isfinite(Probe(s.distance)(x, 0.0, 0.0)));
  const std::vector<Shape> shapes{ball(0.5, 0.0, 0.0, 0.5), ball(-0.5, 0.1, 0.0, 0.4),
                                  ball(0.0, 0.6, 0.2, 0.3)};
  const Blend blend = Blend::exponential(0.2);
  const Probe one(unite(shapes, blend).distance),
      other(unite({shapes[2], shapes[0], shapes[1]}, blend).distance);
  const Probe pairs(unite(unite(shapes[0], shapes[1], blend), shapes[2], blend).distance);
  Points points(7);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 p = points.in(cube(2.0));
    ASSERT_NEAR(one(p), other(p), kRounding);
    ASSERT_NEAR(one(p), pairs(p), kRounding);
  }
}

TEST(SmoothUnion, OfManyKeepsWithinItsBounds) {
  // Ten equal spheres in one place swell the most.
  for (const Blend& blend : smoothBlends(0.3)) {
    SCOPED_TRACE(static_cast<int>(blend.kind));
    const Shape s = unite(std::vector<Shape>(10, sphere(0.5)), blend);
    EXPECT_LE(s.claim.lipschitz, 1.0);
    expectBounded(s, cube(3.0), 8);
    const double reach = s.bounds.max.x;
    EXPECT_NEAR(Probe(s.distance)(reach, 0.0, 0.0), 0.0, kRounding) << "the bound is reached";
  }
}

TEST(SmoothUnion, OfAnInexactBoundGrowsItsBoundsByTheProvenRate) {
  // Halving the distance doubles what a blend adds.
  Shape slow = ball(0.0, 0.0, 0.0, 1.0);
  slow.distance = slow.distance * 0.5;
  slow.claim = {ClaimKind::Bound, 0.5};
  slow.claim.growth = 2.0;
  const Shape s = unite(slow, slow, Blend::chamfer(0.4));
  EXPECT_NEAR(s.bounds.max.x, 1.0 + 2.0 * 0.2, kRounding);
  expectBounded(s, cube(3.0), 9);
  slow.claim.growth = kInfinity;
  EXPECT_FALSE(unite(slow, slow, Blend::chamfer(0.4)).bounds.finite()) << "an unknown rate proves no bounds";
}

TEST(Booleans, BoundsShrinkToWhatCanBeLeft) {
  const Shape a = box(Vec3E(1.0)), b = translate(box(Vec3E(1.0)), Vec3E(1.5, 0.0, 0.0));
  EXPECT_EQ((a & b).bounds.min.x, 0.5);
  EXPECT_EQ((a & b).bounds.max.x, 1.0);
  EXPECT_EQ((a - b).bounds.max.x, 1.0);
  EXPECT_EQ((a | b).bounds.max.x, 2.5);
  const Shape apart = a & translate(box(Vec3E(1.0)), Vec3E(2.5, 0.0, 0.0));
  expectBounded(apart, cube(4.0), 10);
}

TEST(Intersection, OfALatticeAndABoxGrowsAsTheBoxDoes) {
  const Shape s = gyroid(1.0, 0.1) & box(Vec3E(1.0));
  EXPECT_EQ(growthOf(s.claim), 1.0);
  expectBounded(s, cube(2.0), 13);
  EXPECT_TRUE(unite(s, sphere(1.0), Blend::quadratic(0.2)).bounds.finite());
}

TEST(Union, ShowsTheNearerShapeAndTheLaterOneOnATie) {
  const Shape s = red(left()) | green(below());
  EXPECT_EQ(attribute(s, Attribute::Red, {0.1, 0.5, 0.0}), 1.0);
  EXPECT_EQ(attribute(s, Attribute::Red, {0.5, 0.1, 0.0}), 0.0);
  EXPECT_EQ(attribute(s, Attribute::Green, {0.3, 0.3, 0.0}), 1.0);
  EXPECT_EQ(attribute(s, Attribute::Red, {0.3, 0.3, 0.0}), 0.0);
  EXPECT_EQ(s.materials.size(), 2u);
}

TEST(Union, OfFourStillLetsTheLastWinATie) {
  const Shape one = left();
  const Shape s = unite({red(one), red(one), red(one), green(one)});
  EXPECT_EQ(attribute(s, Attribute::Green, {0.1, 0.0, 0.0}), 1.0);
}

TEST(Booleans, IntersectionAndDifferenceKeepTheFirstSurface) {
  for (const Blend& blend : {Blend::hard(), Blend::quadratic(0.3)})
    for (const Shape& s :
         {intersect(red(left()), green(below()), blend), subtract(red(left()), green(below()), blend)}) {
      for (const glm::dvec3& p : {glm::dvec3(-0.5, 0.0, 0.0), glm::dvec3(0.0, -0.5, 0.0)}) {
        EXPECT_EQ(attribute(s, Attribute::Red, p), 1.0);
        EXPECT_EQ(attribute(s, Attribute::Green, p), 0.0);
      }
      EXPECT_EQ(s.materials.size(), 1u);
    }
}

TEST(Xor, ShowsTheShapeWhoseSolidIsThere) {
  // Of two overlapping spheres the wall of the common hole is cut into the other one.
  const Shape s = red(ball(0.0, 0.0, 0.0, 1.0)) ^ green(ball(1.0, 0.0, 0.0, 1.0));
  EXPECT_EQ(attribute(s, Attribute::Red, {-1.0, 0.0, 0.0}), 1.0);
  EXPECT_EQ(attribute(s, Attribute::Green, {2.0, 0.0, 0.0}), 1.0);
  EXPECT_EQ(attribute(s, Attribute::Red, {0.0, 0.0, 0.0}), 1.0)
      << "the second sphere's surface, cut into the first";
  EXPECT_EQ(attribute(s, Attribute::Green, {1.0, 0.0, 0.0}), 1.0)
      << "the first sphere's surface, cut into the second";
}

TEST(SmoothUnion, MixesColoursByTheWeightThatMixesTheDistance) {
  constexpr double kH = 1e-6;
  for (const Blend& blend : smoothBlends(0.4)) {
    SCOPED_TRACE(static_cast<int>(blend.kind));
    const Shape s = unite(red(left()), green(below()), blend);
    const Probe f(s.distance), greenness(s.surface[static_cast<int>(Attribute::Green)]);
    const Probe redness(s.surface[static_cast<int>(Attribute::Red)]);
    Points points(11);
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 p = points.in(cube(0.5));
      const double apart = std::abs(p.x - p.y);
      if (apart < 2.0 * kH || std::abs(apart - 0.4) < 2.0 * kH) continue;  // creases
      const double weight = (f(p.x, p.y + kH, 0.0) - f(p.x, p.y - kH, 0.0)) / (2.0 * kH);
      // The quotient errs by kH^2 times a third derivative below 1 / k^2, and by rounding over kH.
      ASSERT_NEAR(greenness(p), weight, 1e-9) << text(p);
      ASSERT_NEAR(redness(p) + greenness(p), 1.0, kRounding);
    }
  }
}

TEST(SmoothUnion, OfThreeExponentialsMixesAllByTheirShares) {
  const Shape one = left();
  const Shape s = unite({red(one), green(one), green(one)}, Blend::exponential(0.3));
  EXPECT_NEAR(attribute(s, Attribute::Red, {0.2, 0.0, 0.0}), 1.0 / 3.0, kRounding);
  EXPECT_NEAR(attribute(s, Attribute::Green, {0.2, 0.0, 0.0}), 2.0 / 3.0, kRounding);
}

TEST(SmoothUnion, GivesTheMaterialOfTheShapeThatWeighsMore) {
  const Shape a = red(left()), b = green(below());
  const Shape s = unite(a, b, Blend::quadratic(0.4));
  ASSERT_EQ(s.materials, (std::vector{a.materials[0], b.materials[0]}));
  EXPECT_EQ(attribute(s, Attribute::MaterialId, {0.1, 0.2, 0.0}), 0.0);
  EXPECT_EQ(attribute(s, Attribute::MaterialId, {0.2, 0.1, 0.0}), 1.0);
}

// Balls in a row, ball i at x = i in material i, are united in groups that share materials in every order.
// Each ball's middle must show its own.
TEST(Union, FindsEachMaterialInTheCommonList) {
  std::vector<MaterialPtr> materials;
  for (int i = 0; i < 4; ++i) materials.push_back(makeMaterial({.color = Vec3E(i / 4.0)}));
  const auto row = [&](int first, const std::vector<int>& order) {
    std::vector<Shape> balls;
    for (std::size_t i = 0; i < order.size(); ++i)
      balls.push_back(ball(first + double(i), 0.0, 0.0, 0.4).paint(materials[order[i]]));
    return unite(balls);
  };
  const std::vector<std::vector<int>> groups{{1, 0}, {1, 0}, {2, 3}, {0, 3, 1, 2},
                                             {3},    {2, 1}, {0, 2}, {3, 1, 0, 2}};
  std::vector<int> expected;
  std::vector<Shape> rows;
  for (const std::vector<int>& order : groups) {
    rows.push_back(row(static_cast<int>(expected.size()), order));
    expected.insert(expected.end(), order.begin(), order.end());
  }
  Shape folded = rows[0];
  for (std::size_t i = 1; i < rows.size(); ++i) folded = rows[i] | folded;
  for (const Shape& s : {unite(rows), unite(rows, Blend::exponential(0.01)), folded,
                         morph(sphere(1.0), folded, 1.0), folded ^ ball(-9.0, 0.0, 0.0, 0.1)}) {
    std::set<MaterialPtr> distinct(s.materials.begin(), s.materials.end());
    EXPECT_EQ(distinct.size(), s.materials.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const glm::dvec3 middle(double(i), 0.0, 0.0);
      const auto place = static_cast<std::size_t>(attribute(s, Attribute::MaterialId, middle));
      ASSERT_LT(place, s.materials.size());
      EXPECT_EQ(s.materials[place], materials[expected[i]]) << i;
      EXPECT_NEAR(attribute(s, Attribute::Red, middle), expected[i] / 4.0, kRounding) << i;
    }
  }
}

TEST(Union, OfShapesPaintedAlikeAsksNothingToChoose) {
  for (const Blend& blend : {Blend::hard(), Blend::quadratic(0.2), Blend::exponential(0.2)}) {
    const Shape s =
        unite({ball(0.0, 0.0, 0.0, 1.0), ball(1.0, 0.0, 0.0, 1.0), ball(0.0, 1.0, 0.0, 1.0)}, blend);
    EXPECT_EQ(s.surface, sphere(1.0).surface);
    EXPECT_EQ(s.materials.size(), 1u);
  }
}

TEST(SmoothUnion, TakesASliderThatTouchesZeroWithoutNaN) {
  const Expr k = slider("k", 0.2, 0.0, 1.0);
  for (const Blend& blend : smoothBlends(k)) {
    SCOPED_TRACE(static_cast<int>(blend.kind));
    const Shape s = unite(red(ball(0.0, 0.0, 0.0, 1.0)), green(ball(0.5, 0.0, 0.0, 1.0)), blend);
    ASSERT_TRUE(s.ok());
    EXPECT_GT(s.bounds.max.x, 1.5 + depthAtTie(blend.kind, 1.0) - kRounding)
        << "bounds hold over the whole range";
    const Probe atZero(s.distance, {{"k", 0.0}}), colour(s.surface[0], {{"k", 0.0}});
    Points points(12);
    for (int i = 0; i < 1000; ++i) {
      const glm::dvec3 p = points.in(cube(2.0));
      ASSERT_TRUE(std::isfinite(atZero(p)) && std::isfinite(colour(p)));
    }
    EXPECT_TRUE(std::isfinite(atZero(0.25, 0.3, 0.0))) << "at a tie";
  }
}

TEST(Booleans, RefuseWhatCannotBeWithOneLine) {
  const Shape a = sphere(1.0);
  EXPECT_EQ(*unite(std::vector<Shape>{}).error, "union: needs at least one shape");
  EXPECT_EQ(*intersect(std::vector<Shape>{}).error, "intersection: needs at least one shape");
  EXPECT_EQ(*subtract(a, circle(1.0)).error,
            "difference: shape 2 is flat and others are solid; extrude or revolve it first");
  EXPECT_EQ(*exclude(circle(1.0), a).error,
            "xor: shape 1 is flat and others are solid; extrude or revolve it first");
  EXPECT_EQ(*unite(a, a, Blend::quadratic(0.0)).error, "union: k must be positive, got 0");
  EXPECT_EQ(*unite(a, a, Blend::cubic(-1.0)).error, "union: k must be positive, got -1");
  EXPECT_EQ(*unite(a, a, Blend::chamfer(std::nan(""))).error, "union: k must be a finite number, got nan");
  EXPECT_EQ(*unite(a, a, Blend::quadratic(kX)).error, "union: k must not depend on position");
}

TEST(Booleans, PassOnTheFirstFailure) {
  const Shape bad = Shape::failed("first"), worse = Shape::failed("second"), a = sphere(1.0);
  for (const Shape& s : {unite({a, bad, worse}), intersect({a, bad, worse}), subtract({a, bad, worse}),
                         exclude({a, bad, worse})})
    EXPECT_EQ(*s.error, "first");
}

TEST(Booleans, OfFlatShapesAreFlat) {
  EXPECT_EQ((circle(1.0) - rectangle(0.5, 0.5)).dimension, 2);
  EXPECT_TRUE((circle(1.0) | rectangle(0.5, 0.5)).ok());
}

TEST(Booleans, OfAFieldWithNoConstantStayAField) {
  const Shape wild = field(kX * kX * kX - kY);
  const Shape s = unite(wild, sphere(1.0), Blend::quadratic(0.1));
  EXPECT_EQ(s.claim.kind, ClaimKind::Field);
  EXPECT_EQ(s.claim.lipschitz, kInfinity);
}

}  // namespace booleans_test
}  // namespace sdf
