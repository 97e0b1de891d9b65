// Forms of distances, found again in the graph.
#include "sdf/shape/calibrate/forms.h"

#include <gtest/gtest.h>

#include "sdf/base/box.h"
#include "sdf/shape/formula.h"
#include "support/evaluate.h"

namespace sdf {
namespace forms_test {

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

// The inner radius, 0 where the form has none.
double radiusAt(const Expr& e, const glm::dvec3& p) {
  const auto r = innerRadius(e);
  return r ? test::Evaluator(*r)(p) : 0.0;
}

TEST(InnerRadius, IsInfiniteForLengthsOfCoordinates) {
  EXPECT_EQ(radiusAt(length(kX, kY, kZ), {}), kInfinity);
  EXPECT_EQ(radiusAt(length(kX * 0.6 + kY * 0.8, kZ - 2.0), {}), kInfinity) << "turned and moved";
  EXPECT_EQ(radiusAt(norm(kX, beyond(kY, 1.0)), {}), kInfinity) << "a capsule's";
  EXPECT_EQ(radiusAt(norm(max(kX, 0.0), max(abs(kY) - 1.0, 0.0)), {}), kInfinity);
  EXPECT_EQ(radiusAt(boxDistance(abs(kX) - 1.0, abs(kY) - 2.0, abs(kZ) - 3.0), {}), kInfinity);
}

TEST(InnerRadius, IsThatOfTheLengthsWithin) {
  const Expr ring = norm(norm(kX, kZ) - 2.0, kY);
  EXPECT_EQ(radiusAt(ring, {3.0, 1.0, 4.0}), 5.0);
  EXPECT_EQ(radiusAt(boxDistance(norm(kX, kZ) - 2.0, abs(kY) - 1.0), {3.0, 1.0, 4.0}), 5.0);
}

TEST(InnerRadius, IsNotKnownOfOtherFunctions) {
  EXPECT_FALSE(innerRadius(kX));
  EXPECT_FALSE(innerRadius(sin(kX)));
  EXPECT_FALSE(innerRadius(norm(kX, kY) - 1.0)) << "the length itself is asked for";
  EXPECT_FALSE(innerRadius(length(kX, kX + kY))) << "not at right angles";
  EXPECT_FALSE(innerRadius(length(2.0 * kX, kY))) << "not of length 1";
  EXPECT_FALSE(innerRadius(length(square(kX), kY)));
  EXPECT_FALSE(innerRadius(norm(abs(kX) - 1.0, kY))) << "a kink at x = 0, where it is not 0";
}

}  // namespace forms_test
}  // namespace sdf
