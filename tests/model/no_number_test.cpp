// Where distances are no numbers, and what is blamed for it.
#include "sdf/model/no_number.h"

#include <gtest/gtest.h>

#include "sdf/shape/solids/solids.h"

namespace sdf::no_number_test {

constexpr int kPlaces = 1000;
const Box kBox = Box::centred(glm::dvec3(1.0));
const Vec3E kAt = position();

TEST(NoNumber, IsFoundWhereItIs) {
  const auto found = findNoNumber(kAt.y - sqrt(kAt.x), kBox, {}, kPlaces);
  ASSERT_TRUE(found);
  EXPECT_LT(found->at.x, 0.0);
  EXPECT_NEAR(found->share, 0.5, 0.05);
}

TEST(NoNumber, IsNotWhereAllAreNumbers) {
  EXPECT_FALSE(findNoNumber(sphere(1.0).distance, kBox, {}, kPlaces));
  EXPECT_FALSE(findNoNumber(sqrt(max(kAt.x, 0.0)) + sin(kAt.y), kBox, {}, kPlaces));
  EXPECT_FALSE(findNoNumber(sqrt(kAt.x + 1.5), kBox, {}, kPlaces));
}

// A maximum hides it as an argument, a select where it chooses the other.
TEST(NoNumber, CountsWhereTheValueDependsOnIt) {
  const Expr root = sqrt(kAt.x);
  EXPECT_TRUE(findNoNumber(max(root, kAt.y), kBox, {}, kPlaces));
  EXPECT_TRUE(findNoNumber(max(kAt.y, root), kBox, {}, kPlaces));
  EXPECT_TRUE(findNoNumber(select(less(kAt.y, 0.0), root, 1.0), kBox, {}, kPlaces));
  EXPECT_FALSE(findNoNumber(select(less(0.0, kAt.x), root, 1.0), kBox, {}, kPlaces));
}

TEST(NoNumber, GoesByTheValuesOfInputs) {
  const Expr k = Expr::parameter({"k", 2.0, 0.0, 4.0});
  const Expr e = sqrt(kAt.x + k);
  EXPECT_FALSE(findNoNumber(e, kBox, {}, kPlaces));
  EXPECT_TRUE(findNoNumber(e, kBox, {{"k", 0.5}}, kPlaces));
}

}  // namespace sdf::no_number_test
