#include "sdf/shape/operators/pattern.h"

#include <numbers>

#include "claim_checks.h"
#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"
#include "support/bind.h"

namespace sdf {
namespace pattern_test {

constexpr double kPi = std::numbers::pi;

// No symmetry, exact outside; half-length below 0.5 in each axis, its middle off the origin.
Shape odd() {
  return translate(box(Vec3E(0.3, 0.15, 0.1)), Vec3E(0.1, 0.05, 0.0)) |
         translate(sphere(0.15), Vec3E(0.3, 0.2, 0.15));
}
// The same as a bound only.
Shape carved() { return odd() - translate(sphere(0.2), Vec3E(0.15, 0.2, 0.05)); }

std::size_t operations(const Shape& s) { return topologicalOrder(withoutClaims({&s.distance, 1})).size(); }

// Every copy written out; copies further than `span` cells from the middle are left away.
Shape written(const Shape& s, const glm::dvec3& cell, const glm::ivec3& count) {
  std::vector<Shape> copies;
  for (int i = 0; i < count.x; ++i)
    for (int j = 0; j < count.y; ++j)
      for (int k = 0; k < count.z; ++k) {
        const glm::dvec3 at(i - 0.5 * (count.x - 1), j - 0.5 * (count.y - 1), k - 0.5 * (count.z - 1));
        copies.push_back(translate(s, Vec3E(at * cell)));
      }
  return unite(copies);
}

void expectSame(const Shape& s, const Shape& reference, const Box& where, unsigned seed, int trials = 3000) {
  ASSERT_TRUE(s.ok()) << *s.error;
  const Probe f(s.distance), g(reference.distance);
  Points points(seed);
  for (int i = 0; i < trials; ++i) {
    const glm::dvec3 p = points.in(where);
    ASSERT_NEAR(f(p), g(p), kRounding) << "seed " << seed << ", at " << text(p);
  }
}

TEST(RepeatGrid, OfExactShapesIsTheUnionOfExplicitCopies) {
  const glm::dvec3 cell(1.0, 1.2, 0.9);
  for (const glm::ivec3& count :
       {glm::ivec3(3, 2, 1), glm::ivec3(1, 4, 3), glm::ivec3(2, 2, 2), glm::ivec3(5, 1, 1)}) {
    SCOPED_TRACE(text(glm::dvec3(count)));
    for (const Shape& one :
         {odd(), sphere(0.4), translate(box(Vec3E(0.4, 0.5, 0.3)), Vec3E(0.0, 0.3, 0.0))}) {
      const Shape s = repeatGrid(one, Vec3E(cell), count);
      expectSame(s, written(one, cell, count), cube(4.0), 1);
      EXPECT_EQ(s.claim.kind, one.claim.kind);
      EXPECT_EQ(s.distance.lipschitz(), 1.0);
      expectClaim(s, cube(4.0), 2);
    }
  }
}

TEST(RepeatGrid, WithoutEndIsTheUnionOfTheCopiesAround) {
  const glm::dvec3 cell(1.0, 1.2, 0.9);
  for (const Shape& one : {odd(), sphere(0.4)}) {
    const Shape s = repeatGrid(one, Vec3E(cell));
    expectSame(s, written(one, cell, glm::ivec3(7)), cube(2.0), 3);
    expectClaim(s, cube(2.0), 4);
    EXPECT_FALSE(s.bounds.finite());
  }
}

TEST(RepeatGrid, SeesNeighboursOfShapesLongerThanTheirCell) {
  for (const double length : {0.55, 0.8, 1.2, 1.5}) {
    SCOPED_TRACE(length);
    const Shape one = rotate(box(Vec3E(length, 0.1, 0.1)), Vec3E(0.0, 0.0, 0.1)) |
                      translate(sphere(0.2), Vec3E(length - 0.3, 0.2, 0.1));
    const double cell = std::max(1.0, one.bounds.size().x / 3.0);
    const Shape s = repeatGrid(one, Vec3E(cell, 0.0, 0.0), glm::ivec3(6, 1, 1));
    expectSame(s, written(one, glm::dvec3(cell, 0.0, 0.0), glm::ivec3(6, 1, 1)), cube(5.0), 5);
    EXPECT_EQ(s.claim.kind, ClaimKind::ExactOutside);
    expectClaim(s, cube(5.0), 6);
  }
}

TEST(RepeatGrid, AsksOneCopyOfAShapeThatIsItsOwnMirrorImage) {
  const std::size_t alone = operations(sphere(0.4));
  EXPECT_LE(operations(repeatGrid(sphere(0.4), Vec3E(1.0))), alone + 10)
      << "a rounding, a product and a sum an axis, and the cell";
  EXPECT_GT(operations(repeatGrid(odd(), Vec3E(1.0))), 2 * operations(odd()));
  // Moved or too long for its cell, it has neighbours again.
  EXPECT_GT(operations(repeatGrid(sphere(0.6), Vec3E(1.0))), 4 * alone);
  EXPECT_GT(operations(repeatGrid(translate(sphere(0.1), Vec3E(0.2)), Vec3E(1.0))), 4 * alone);
}

TEST(RepeatGrid, OfABoundKeepsSignAndStaysContinuous) {
  const glm::dvec3 cell(0.9, 0.8, 0.7);
  for (const Shape& one : {carved(), twist(odd(), 1.5), scale(odd(), Vec3E(1.0, 0.5, 0.8))}) {
    for (const glm::ivec3& count : {glm::ivec3(3, 4, 2), glm::ivec3(4, 1, 3)}) {
      const Shape s = repeatGrid(one, Vec3E(cell), count), reference = written(one, cell, count);
      EXPECT_EQ(s.claim.kind, one.claim.kind);
      EXPECT_EQ(s.claim.lipschitz, one.claim.lipschitz);
      expectSameSolid(s, Probe(reference.distance), cube(3.0), 7);
      expectClaim(s, cube(3.0), 8);
    }
    const Shape endless = repeatGrid(one, Vec3E(0.9, 0.0, 0.0));
    expectClaim(endless, cube(4.0), 9);
  }
}

// Outside of its bounds a field is no nearer than most of the way there: a window may drop its copies.
TEST(RepeatGrid, OfAFieldIsNoSteeperThanTheField) {
  const Expr x = Expr::variable(Variable::X);
  const Shape one = field(square(x) + x - 0.1, Box::centred(glm::dvec3(0.4)));
  const Shape s = repeatGrid(one, Vec3E(1.0));
  EXPECT_EQ(s.claim.lipschitz, one.claim.lipschitz);
  EXPECT_EQ(s.distance.lipschitz(), one.claim.lipschitz);
  const TapePtr many = Function(s.distance).at(), single = Function(one.distance).at();
  for (double at = -0.4; at <= 0.4; at += 0.01) {
    const glm::dvec3 p(at, 0.1, -0.2);
    EXPECT_EQ(evaluate(*many, p + glm::dvec3(3.0, -2.0, 0.0)) < 0.0, evaluate(*single, p) < 0.0) << at;
  }
}

TEST(RepeatGrid, RepeatsOnlyAlongTheAxesAsked) {
  const Shape s = repeatGrid(odd(), Vec3E(1.0, 0.0, 0.0));
  EXPECT_EQ(s.bounds.min.x, -kInfinity);
  EXPECT_EQ(s.bounds.max.y, odd().bounds.max.y);
  EXPECT_TRUE(repeatGrid(plane(Vec3E(0.0, 1.0, 0.0), 0.0), Vec3E(1.0), glm::ivec3(1)).ok());
}

TEST(RepeatGrid, ShowsTheColourOfTheNearestCopy) {
  Material m;
  m.color = Vec3E(Expr::variable(Variable::X), 0.0, 0.0);
  const Shape even = repeatGrid(sphere(0.4).paint(m), Vec3E(1.0, 0.0, 0.0));
  const Shape other = repeatGrid(translate(sphere(0.3), Vec3E(0.1, 0.0, 0.0)).paint(m), Vec3E(1.0, 0.0, 0.0));
  for (const Shape& s : {even, other}) {
    const Probe red(s.surface[0]);
    EXPECT_NEAR(red(2.2, 0.3, 0.0), 0.2, kRounding);
    EXPECT_NEAR(red(-1.1, 0.3, 0.0), -0.1, kRounding) << "colours are not mirrored though the distance is";
  }
}

TEST(RepeatGrid, BySlidersHoldsForEveryCell) {
  const Shape s = repeatGrid(odd(), Vec3E(slider("c", 1.0, 0.4, 2.0), 0.0, 0.0), glm::ivec3(4, 1, 1));
  for (const double c : {0.4, 0.7, 2.0}) {
    Shape now = s;
    now.distance = test::bind(s.distance, {{"c", c}});
    expectSame(now, written(odd(), glm::dvec3(c, 0.0, 0.0), glm::ivec3(4, 1, 1)), cube(4.0), 10);
    expectBounded(now, cube(5.0), 11);
  }
}

TEST(RepeatGrid, OfFlatShapesIgnoresZ) {
  const Shape s = repeatGrid(circle(0.3), Vec3E(1.0, 1.0, 1.0));
  EXPECT_EQ(s.dimension, 2);
  EXPECT_EQ(extrude(s, 0.1).claim.kind, ClaimKind::Exact);
  expectClaim(extrude(repeatGrid(circle(0.3), Vec3E(1.0, 0.8, 0.0), glm::ivec3(3, 2, 1)), 0.2), cube(2.0),
              12);
}

Shape around(const Shape& s, int count) {
  std::vector<Shape> copies;
  for (int i = 0; i < count; ++i) copies.push_back(rotate(s, Vec3E(0.0, 2.0 * kPi * i / count, 0.0)));
  return unite(copies);
}

TEST(PolarRepeat, OfExactShapesIsTheUnionOfExplicitCopies) {
  for (const int count : {2, 3, 4, 5, 8, 13, 24})
    for (const glm::dvec3& at :
         {glm::dvec3(1.2, 0.0, 0.0), glm::dvec3(-0.9, 0.2, 0.8), glm::dvec3(0.0, 0.0, 2.0)}) {
      SCOPED_TRACE(std::to_string(count) + " at " + text(at));
      for (const Shape& one : {translate(odd(), Vec3E(at)), translate(sphere(0.25), Vec3E(at))}) {
        const Shape s = polarRepeat(one, count);
        expectSame(s, around(one, count), cube(3.0), 13, 500);
        EXPECT_EQ(s.distance.lipschitz(), 1.0);
        EXPECT_LE(s.claim.kind, ClaimKind::ExactOutside);
      }
    }
  expectClaim(polarRepeat(translate(odd(), Vec3E(1.2, 0.0, 0.0)), 8), cube(3.0), 14);
  expectClaim(polarRepeat(translate(sphere(0.25), Vec3E(1.2, 0.0, 0.0)), 8), cube(3.0), 15);
  expectClaim(polarRepeat(translate(sphere(0.25), Vec3E(0.0, 0.0, 1.2)), 8), cube(3.0), 16);
}

TEST(PolarRepeat, AsksOneCopyOfAShapeThatIsItsOwnMirrorImage) {
  const Shape one = translate(sphere(0.1), Vec3E(1.0, 0.0, 0.0));
  EXPECT_EQ(operations(polarRepeat(one, 20)), operations(polarRepeat(one, 10)));
  EXPECT_EQ(polarRepeat(one, 20).claim.kind, ClaimKind::Exact);
  expectClaim(polarRepeat(one, 20), cube(2.0), 20);
}

TEST(PolarRepeat, CopiesOutSpokesThatReachTheHub) {
  const Shape spoke = translate(box(Vec3E(0.5, 0.05, 0.1)), Vec3E(0.5, 0.0, 0.0));
  const Shape s = polarRepeat(spoke, 12);
  expectSame(s, around(spoke, 12), cube(2.0), 17);
  EXPECT_EQ(*polarRepeat(spoke, 100).error,
            "polar_repeat: the shape reaches the y axis or spans more than 3 of the 100 sectors; move it "
            "outwards or use "
            "at most 64 copies");
}

TEST(PolarRepeat, OfABoundKeepsSignAndStaysContinuous) {
  for (const Shape& one :
       {translate(carved(), Vec3E(1.0, 0.0, 0.0)), translate(twist(odd(), 1.5), Vec3E(0.8, 0.0, 0.7))})
    for (const int count : {3, 5, 9, 16}) {
      SCOPED_TRACE(count);
      const Shape s = polarRepeat(one, count);
      EXPECT_EQ(s.claim.kind, one.claim.kind);
      EXPECT_EQ(s.claim.lipschitz, one.claim.lipschitz);
      expectSameSolid(s, Probe(around(one, count).distance), cube(2.0), 18);
      expectClaim(s, cube(2.5), 19);
    }
}

TEST(PolarRepeat, TurnsTheColourAlong) {
  Material m;
  m.color = Vec3E(Expr::variable(Variable::X), 0.0, Expr::variable(Variable::Z));
  for (const double z : {0.0, 0.05}) {  // one copy, a window of copies
    const Shape s = polarRepeat(translate(sphere(0.2), Vec3E(1.0, 0.0, z)).paint(m), 8);
    const double turn = 3.0 * 2.0 * kPi / 8.0, angle = turn + 0.1;
    EXPECT_NEAR(Probe(s.surface[0])(std::cos(angle), 0.0, std::sin(angle)), std::cos(0.1), kRounding);
    EXPECT_NEAR(Probe(s.surface[2])(std::cos(angle), 0.0, std::sin(angle)), std::sin(0.1), kRounding);
  }
}

TEST(Patterns, AreFiniteOnTheirAxesAndThresholds) {
  for (const Shape& s : {repeatGrid(odd(), Vec3E(1.0)), repeatGrid(sphere(0.3), Vec3E(1.0)),
                         polarRepeat(translate(odd(), Vec3E(1.0, 0.0, 0.0)), 5),
                         polarRepeat(translate(sphere(0.2), Vec3E(1.0, 0.0, 0.0)), 6),
                         polarRepeat(translate(carved(), Vec3E(1.0, 0.0, 0.0)), 7)}) {
    const Probe f(s.distance);
    for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0})
      for (const double z : {-1.0, -0.5, 0.0, 0.5, 1.0}) EXPECT_TRUE(std::isfinite(f(x, 0.5, z)));
  }
}

TEST(Patterns, RefuseWhatCannotBeWithOneLine) {
  const Shape s = sphere(0.5), half = plane(Vec3E(0.0, 1.0, 0.0), 0.0);
  EXPECT_EQ(*repeatGrid(s, Vec3E(0.0)).error, "repeat_grid: cell must not be 0 along every axis");
  EXPECT_EQ(*repeatGrid(s, Vec3E(1.0, -1.0, 1.0)).error, "repeat_grid: cell.y must be 0 or more, got -1");
  EXPECT_EQ(*repeatGrid(s, Vec3E(slider("c", 1.0, 0.0, 2.0), 0.0, 0.0)).error,
            "repeat_grid: cell.x must stay above 0 over its parameter's range");
  EXPECT_EQ(*repeatGrid(s, Vec3E(0.3)).error,
            "repeat_grid: the shape is 1 long in x, more than 3 cells of 0.3; use a larger cell");
  EXPECT_EQ(*repeatGrid(half, Vec3E(1.0)).error,
            "repeat_grid: the shape is unbounded in x; intersect it with a box first, or set cell.x to 0");
  EXPECT_EQ(*repeatGrid(s, Vec3E(1.0), glm::ivec3(2, 0, 1)).error,
            "repeat_grid: count.y must be at least 1, got 0");
  EXPECT_EQ(*polarRepeat(s, 0).error, "polar_repeat: count must be at least 1, got 0");
  EXPECT_EQ(*polarRepeat(circle(1.0), 3).error,
            "polar_repeat: the shape is flat; extrude or revolve it first");
}

TEST(Patterns, PassOnAFailure) {
  const Shape bad = Shape::failed("bad");
  EXPECT_EQ(*repeatGrid(bad, Vec3E(1.0)).error, "bad");
  EXPECT_EQ(*polarRepeat(bad, 3).error, "bad");
}

}  // namespace pattern_test
}  // namespace sdf
