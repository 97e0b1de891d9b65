// Derivatives written as expressions against the dual reading of the same expression, over the whole catalog.
#include "sdf/expr/gradient.h"

#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>

#include "claims/tree.h"
#include "sdf/eval/scalar_reading.h"
#include "shape/cases.h"

namespace sdf::test {
namespace gradient_test {

constexpr int kPoints = 400;

// Both take the same steps in double; only factors of 0 and 1 are left out, and of a sum of products the tape
// compiler may choose the order. It is the last step or two that this rounds otherwise.
constexpr double kRoundings = 4.0;

void expectSameGradient(const Shape& shape) {
  const Vec3E g = gradientOf(shape.distance);
  const Tape tape(shape.distance), slopes(std::array{g.x, g.y, g.z});
  Sampler random(sampleRegion(shape), 11);
  int compared = 0;
  for (int i = 0; i < kPoints; ++i) {
    const glm::dvec3 p = random.orOnAnAxis();
    const ValueAndGradient expected = evaluateGradient(tape, p);
    const std::vector<double> got = evaluateAll(slopes, p);
    for (int k = 0; k < 3; ++k) {
      // What multiplies an infinite value by 0 is a number in one of them only.
      if (!std::isfinite(expected.gradient[k]) || !std::isfinite(got[k])) continue;
      ++compared;
      ASSERT_NEAR(got[k], expected.gradient[k],
                  kRoundings * DBL_EPSILON * (1.0 + std::abs(expected.gradient[k])))
          << "along axis " << k << " at " << text(p);
    }
  }
  EXPECT_GT(compared, kPoints * 3 * 9 / 10) << "too few slopes are numbers";
}

TEST(GradientOf, IsTheDualReadingsForEveryPrimitive) {
  for (const ShapeCase& c : primitiveCases()) {
    SCOPED_TRACE(c.name);
    expectSameGradient(c.shape);
  }
}

TEST(GradientOf, IsTheDualReadingsForEveryOperator) {
  constexpr unsigned kTrees = 10;
  for (const CatalogEntry& e : catalog()) {
    if (isPrimitive(e)) continue;
    for (unsigned seed = 0; seed < kTrees; ++seed) {
      const Tree tree = randomTree(seed, 2, e);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + textOf(tree));
      expectSameGradient(shapeOf(tree));
    }
  }
}

TEST(GradientOf, IsZeroWhereTheExpressionIsConstant) {
  const Expr a = Expr::parameter({"a", 2.0, 0.0, 4.0});
  for (const Expr& e : {Expr(3.0), sqrt(a), floor(position().x)}) {
    const Vec3E g = gradientOf(e);
    for (const Expr& slope : {g.x, g.y, g.z}) EXPECT_TRUE(slope.isConstant(0.0));
  }
}

}  // namespace gradient_test
}  // namespace sdf::test
