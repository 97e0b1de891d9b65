// The distances that an offset is found to have, where they are known.
#include "sdf/model/offset_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::offset_check_test {

const Vec3E kAt = position();

OffsetFigures checked(const Shape& s, const Expr& offset, double amount, bool out = true, bool in = false) {
  const auto found = checkOffset({s.distance, offset, amount, s.bounds, out, in});
  EXPECT_TRUE(found);
  return found.value_or(OffsetFigures{});
}

TEST(OffsetCheck, FindsExactOffsetsExact) {
  for (const Shape& s : {sphere(1.0), box(Vec3E(1.0, 0.5, 0.25)), torus(1.0, 0.3), cylinder(0.5, 0.7)}) {
    const OffsetFigures both = checked(s, abs(s.distance) - 0.1, 0.1, true, true);
    EXPECT_NEAR(both.least, 0.1, 0.002);
    EXPECT_NEAR(both.most, 0.1, 0.002);
    EXPECT_FALSE(both.wrong());
  }
}

TEST(OffsetCheck, FindsWhatIsOffByHowMuch) {
  // A ball's distance, twice as steep on one half.
  const Shape ball = sphere(1.0);
  const Expr uneven = select(less(kAt.x, 0.0), 1.0, 2.0) * ball.distance;
  const Shape s = field(uneven, Box::centred(glm::dvec3(1.0)), 2.0);
  const OffsetFigures found = checked(s, uneven - 0.2, 0.2);
  EXPECT_NEAR(found.least, 0.1, 0.002);
  EXPECT_NEAR(found.most, 0.2, 0.002);
  EXPECT_TRUE(found.wrong());
}

TEST(OffsetCheck, FindsEdges) {
  const Expr most = max(abs(kAt.x), max(abs(kAt.y), abs(kAt.z))) - 1.0;
  const Shape s = field(most, Box::centred(glm::dvec3(1.0)));
  const OffsetFigures found = checked(s, most - 0.1, 0.1);
  EXPECT_NEAR(found.least, 0.1, 0.002);
  EXPECT_GE(found.most, 0.1 * std::sqrt(2.0) - 0.002);
  EXPECT_LE(found.most, 0.1 * std::sqrt(3.0) + 0.002);
}

TEST(OffsetCheck, ReadsTheValuesOfParameters) {
  const Expr k = Expr::parameter({"steep", 1.0, 0.5, 8.0});
  const Expr f = sphere(1.0).distance * k;
  const OffsetToCheck offset{f, f - 0.1, 0.1, Box::centred(glm::dvec3(1.0))};
  EXPECT_NEAR(checkOffset(offset)->most, 0.1, 0.002);
  EXPECT_NEAR(checkOffset(offset, {{"steep", 4.0}})->most, 0.025, 0.002);
}

TEST(OffsetCheck, SaysNothingOfWhatHasNoSurface) {
  EXPECT_FALSE(checkOffset({Expr(1.0) + kAt.x * 0.0, kAt.x, 0.1, Box::centred(glm::dvec3(1.0))}));
}

}  // namespace sdf::offset_check_test
