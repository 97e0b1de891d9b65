// Functions taken after a minimum instead of before: fewer of them, and the same values.
#include "sdf/expr/hoist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"
#include "shape/cases.h"
#include "support/evaluate.h"

namespace sdf {
namespace hoist_test {

int countOf(Op op, const Expr& e) {
  const auto order = topologicalOrder({&e, 1});
  return static_cast<int>(
      std::count_if(order.begin(), order.end(), [&](const Expr& n) { return n.op() == op; }));
}

Shape balls(int count, double radiusStep) {
  std::vector<Shape> all;
  for (int i = 0; i < count; ++i)
    all.push_back(
        translate(sphere(0.3 + radiusStep * i), Vec3E(Expr(0.7 * i), Expr(0.1 * i * i), Expr(-0.3 * i))));
  return unite(all);
}

// Both expressions give the same double, to the bit but for the sign of 0, at random points.
void expectSame(const Expr& a, const Expr& b, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-4.0, 4.0);
  const test::Evaluator f(a), g(b);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 p{coordinate(random), coordinate(random), coordinate(random)};
    ASSERT_EQ(f(p), g(p)) << "seed " << seed << ", point " << i;
  }
}

TEST(Hoist, TakesOneRootForBallsOfOneRadius) {
  const Expr before = balls(9, 0.0).distance, after = hoisted(before);
  EXPECT_EQ(countOf(Op::Sqrt, before), 9);
  EXPECT_EQ(countOf(Op::Sqrt, after), 1);
  expectSame(before, after, 1);
}

TEST(Hoist, LeavesBallsOfDifferentRadii) {
  const Expr before = balls(5, 0.01).distance;
  EXPECT_EQ(countOf(Op::Sqrt, hoisted(before)), 5);
  expectSame(before, hoisted(before), 2);
}

TEST(Hoist, FindsWhatBelongsTogetherAnywhereInAUnion) {
  std::vector<Shape> all;
  for (int i = 0; i < 90; ++i) {
    const Vec3E at(Expr(0.3 * i - 12.0), Expr(0.01 * i * i), Expr(0.1 * i));
    all.push_back(translate(i % 3 == 1 ? box(Vec3E(Expr(0.1))) : sphere(0.3), at));
  }
  const Expr before = unite(all).distance, after = hoisted(before);
  EXPECT_LT(countOf(Op::Sqrt, after), 35);  // 30 boxes, and a root for each of the lists that it is taken in
  expectSame(before, after, 3);
}

TEST(Hoist, KeepsWhatTurnsTheOrderRound) {
  const Vec3E p = position();
  const Expr turned = min(p.x * -2.0, p.y * -2.0), kept = min(p.x * 2.0, p.y * 2.0);
  EXPECT_EQ(hoisted(turned), turned);
  EXPECT_EQ(hoisted(kept), min(p.x, p.y) * 2.0);
  const Expr subtracted = min(1.0 - p.x, 1.0 - p.y);
  EXPECT_EQ(hoisted(subtracted), subtracted);
  EXPECT_EQ(hoisted(max(sqrt(abs(p.x)) - p.z, sqrt(abs(p.y)) - p.z)), sqrt(max(abs(p.x), abs(p.y))) - p.z);
}

TEST(Hoist, TakesOneRootForAPolygon) {
  const glm::dvec2 profile[] = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const Expr before = polygon(profile).distance, after = hoisted(before);
  EXPECT_EQ(countOf(Op::Sqrt, before), 8);
  EXPECT_EQ(countOf(Op::Sqrt, after), 1);
  expectSame(before, after, 4);
}

TEST(Hoist, GivesTheSameValuesForTheWholeCatalog) {
  unsigned seed = 10;
  for (const test::ShapeCase& c : test::primitiveCases()) {
    SCOPED_TRACE(c.name);
    if (c.shape.dimension != 3) continue;
    const Shape pair = unite(c.shape, translate(c.shape, Vec3E(Expr(0.4), Expr(0.2), Expr(0.1))));
    expectSame(pair.distance, hoisted(pair.distance), ++seed);
  }
}

TEST(IndexOfMin, ComparesWhatIsUnderCommonFunctions) {
  const std::vector<Expr> operands = {balls(1, 0.0).distance,
                                      translate(sphere(0.3), Vec3E(Expr(1.0))).distance,
                                      translate(sphere(0.3), Vec3E(Expr(-2.0))).distance};
  const std::vector<Expr> numbers = {Expr(10.0), Expr(20.0), Expr(30.0)};
  const Expr number = indexOfMin(operands, numbers);
  EXPECT_EQ(countOf(Op::Sqrt, number), 0);
  const test::Evaluator f(number);
  EXPECT_EQ(f({0.1, 0.0, 0.0}), 10.0);
  EXPECT_EQ(f({0.9, 1.2, 1.0}), 20.0);
  EXPECT_EQ(f({-3.0, -1.0, -2.0}), 30.0);
  EXPECT_EQ(f({0.5, 0.5, 0.5}), 20.0) << "the last of a tie";
}

TEST(IndexOfMin, TakesValuesOfAnyKind) {
  const std::vector<Expr> operands = {position().x, sphere(1.0).distance, -position().x};
  const std::vector<Expr> numbers = {Expr(0.0), Expr(1.0), Expr(2.0)};
  const test::Evaluator f(indexOfMin(operands, numbers));
  EXPECT_EQ(f({-2.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(f({0.0, 0.5, 0.0}), 1.0);
  EXPECT_EQ(f({2.0, 0.0, 0.0}), 2.0);
}

}  // namespace hoist_test
}  // namespace sdf
