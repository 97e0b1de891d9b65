// Replacing coordinates and parameters: the values move with the point, and facts carry over only where they
// hold.
#include <gtest/gtest.h>

#include <cmath>

#include "expr/evaluate.h"
#include "number/adversary.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace remap_test {

const Expr kX = Expr::variable(Variable::X), kY = Expr::variable(Variable::Y),
           kZ = Expr::variable(Variable::Z);

TEST(Remap, EvaluatesAtTheMovedPoint) {
  const Expr f = sin(kX) * kY + sqrt(abs(kZ - kX)) - min(kY, kZ);
  const std::array<Expr, 3> map = {kX + 2.0 * kY, kZ - 1.0, kX * kY};
  const Expr g = remap(f, map, kInf);
  for (int trial = 0; trial < 100; ++trial) {
    Adversary adversary(trial);
    const double x = adversary.moderate(), y = adversary.moderate(), z = adversary.moderate();
    ASSERT_EQ(evaluateGraph(g, x, y, z), evaluateGraph(f, x + 2.0 * y, z - 1.0, x * y)) << "trial " << trial;
  }
}

TEST(Remap, ReplacesCoordinatesAtOnceNotOneAfterAnother) {
  EXPECT_EQ(remap(kX - kY, {kY, kX, kZ}, 1.0), kY - kX);
}

TEST(Remap, LeavesTheNormalAndParametersAlone) {
  const Expr k = Expr::parameter({"k", 0.5, 0.0, 1.0}), f = normal().x * k;
  EXPECT_EQ(remap(f, {kY, kX, kZ}, 1.0), f);
}

TEST(Remap, OfTheCoordinatesThemselvesIsTheSameNode) {
  const Expr f = sin(kX) * kY + kZ;
  EXPECT_EQ(remap(f, {kX, kY, kZ}, 1.0), f);
}

TEST(Remap, KeepsSharedPartsShared) {
  const Expr a = sin(kX) + 1.0, b = sin(kX) - 1.0;
  const std::array<Expr, 2> both = {a, b};
  const std::vector<Expr> moved = remap(both, {kX * 3.0, kY, kZ}, 3.0);
  EXPECT_EQ(moved[0].arg(0), moved[1].arg(0));
}

// A length whose claim no rule of the graph could derive.
Expr claimedLength() { return sqrt(square(kX) + square(kY) + square(kZ)).claimLipschitz(1.0); }

TEST(Remap, ClaimedSlopesAreMultipliedByTheStretch) {
  const Expr f = claimedLength();
  EXPECT_EQ(f.lipschitz(), 1.0);
  EXPECT_EQ((f - 3.0).lipschitz(), 1.0);
  const Expr rotated = remap(f - 3.0, {kX * 0.6 - kY * 0.8, kX * 0.8 + kY * 0.6, kZ}, 1.0);
  EXPECT_EQ(rotated.lipschitz(), 1.0);
  EXPECT_EQ(remap(f, {kX * 2.5, kY * 2.5, kZ * 2.5}, 2.5).lipschitz(), 2.5);
  EXPECT_EQ(remap(f, {kX * kX, kY, kZ}, kInf).lipschitz(), kInf);
}

TEST(Remap, ClaimsOnlyLower) {
  const Expr f = sin(kX * 2.0 + 0.125);
  const double derived = f.lipschitz();
  EXPECT_GE(derived, 2.0);
  EXPECT_LE(derived, 2.0 + 8.0 * kEpsilon);
  EXPECT_EQ(f.claimLipschitz(100.0).lipschitz(), derived);
  EXPECT_EQ(f.claimLipschitz(2.0).lipschitz(), 2.0);
}

TEST(Claim, DoesNotReachOthersWhoUseTheFormula) {
  // As two scenes in one process have it, in either order.
  for (const bool claimedFirst : {true, false}) {
    const double scale = claimedFirst ? 3.0 : 3.5;
    Expr claimed = claimedFirst ? sin(kX * scale).claimLipschitz(0.5) : Expr(0.0);
    const Expr plain = sin(kX * scale);
    if (!claimedFirst) claimed = sin(kX * scale).claimLipschitz(0.5);
    EXPECT_EQ(claimed.lipschitz(), 0.5);
    EXPECT_GE(plain.lipschitz(), scale);
    EXPECT_GE((plain + 1.0).lipschitz(), scale);
    EXPECT_EQ((claimed + 1.0).lipschitz(), 0.5);
    EXPECT_NE(claimed, plain);
    EXPECT_EQ(claimed.unclaimed(), plain);
    EXPECT_EQ(plain.claimLipschitz(0.25), claimed.claimLipschitz(0.25)) << "of two claims the lower counts";
  }
}

TEST(Rewrite, KeepsNodesThatDoNotChangeAndDropsClaimsOfThoseThatDo) {
  const Expr f = sin(kX).claimLipschitz(0.5) + cos(kY).claimLipschitz(0.25);
  const auto xToZ = [](const Expr& e, std::span<const Expr>) {
    return e == kX ? std::optional(kZ) : std::nullopt;
  };
  EXPECT_EQ(rewrite(f, xToZ), sin(kZ) + cos(kY).claimLipschitz(0.25));
  EXPECT_EQ(withoutClaims({&f, 1}).front(), sin(kX) + cos(kY));
}

TEST(Remap, NodesBuiltOnAClaimInheritIt) {
  const Expr f = claimedLength();
  EXPECT_LE((f * 3.0).lipschitz(), 3.0 + 8.0 * kEpsilon);
  EXPECT_EQ(min(f, abs(kX)).lipschitz(), 1.0);
  EXPECT_EQ((f + kX).lipschitz(), 2.0);
}

TEST(Facts, SwitchesByAParameterKeepTheSlope) {
  const Expr k = Expr::parameter({"k", 0.5, 0.0, 1.0});
  EXPECT_LE(select(less(k, 0.25), abs(kX), kY).lipschitz(), 1.0);
  EXPECT_EQ(select(less(kX, 0.25), abs(kX), kY).lipschitz(), kInf);
  EXPECT_EQ(floor(k * 10.0).lipschitz(), 0.0);
}

TEST(Facts, AParametersRangeHoldsItsPresentValueAndEitherOrderOfItsEnds) {
  EXPECT_TRUE(Expr::parameter({"k", 5.0, 0.0, 1.0}).range().contains(5.0));
  const Interval r = Expr::parameter({"k", 0.5, 1.0, 0.0}).range();
  EXPECT_TRUE(r.contains(0.0) && r.contains(1.0));
}

TEST(Facts, LengthsAreNeverSaidToBeNaN) {
  EXPECT_FALSE(length(position()).range().nan);
  EXPECT_GE(length(position()).range().lo, 0.0);
}

}  // namespace remap_test
}  // namespace sdf
