// check() itself: it must refute what is wrong, each clause of a claim by itself.
#include "accuracy/check.h"

#include <gtest/gtest.h>

#include "accuracy/solids/meshes.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace check_test {

constexpr std::uint64_t kPoints = 4096;
constexpr unsigned kSeed = 7;

ReferenceCase boxCase(Shape shape) {
  const std::vector<double> cuts{-1.0, 1.0};
  return {{cells({cuts, cuts, cuts}, [](const glm::ivec3&) { return true; }).mesh}, "box", std::move(shape)};
}

Shape unitBox() { return box({1.0, 1.0, 1.0}); }

TEST(Check, HoldsABoxToItsClaim) {
  const Checked found = check(boxCase(unitBox()), kPoints, kSeed);
  EXPECT_EQ(found.refuted, 0u) << found.worst;
  EXPECT_EQ(found.points, kPoints);
  EXPECT_EQ(found.tightness, 1.0);
}

// Larger than 4 ulps of any point within 3 of the centre.
constexpr double kBarelyWrong = 8 * 0x1p-22;

TEST(Check, RefutesASlightlyLargerBox) {
  EXPECT_GT(check(boxCase(box({1.0 + kBarelyWrong, 1.0, 1.0})), kPoints, kSeed).refuted, 0u);
}

TEST(Check, RefutesABoundThatPassesTheDistance) {
  Shape s = unitBox();
  s.distance = (s.distance * 1.01).claimLipschitz(1.01);
  s.claim = {ClaimKind::Bound, 1.01};
  EXPECT_GT(check(boxCase(s), kPoints, kSeed).refuted, 0u);
  s.claim.kind = ClaimKind::Field;
  EXPECT_EQ(check(boxCase(s), kPoints, kSeed).refuted, 0u) << "a field need only have the sign";
}

TEST(Check, TellsExactOutsideFromExact) {
  Shape s = unitBox();
  s.distance = max(s.distance, s.distance * 0.5);
  EXPECT_GT(check(boxCase(s), kPoints, kSeed).refuted, 0u);
  s.claim.kind = ClaimKind::ExactOutside;
  const Checked found = check(boxCase(s), kPoints, kSeed);
  EXPECT_EQ(found.refuted, 0u) << found.worst;
  EXPECT_NEAR(found.tightness, 0.5, 0.5 / 20) << "what is allowed is at most a twentieth of d";
}

TEST(Check, RefutesAWrongSign) {
  Shape s = unitBox();
  s.distance = abs(s.distance);
  s.claim.kind = ClaimKind::Field;
  EXPECT_GT(check(boxCase(s), kPoints, kSeed).refuted, 0u);
}

TEST(Check, RefutesASlopeAboveTheClaim) {
  Shape s = unitBox();
  s.claim.lipschitz = 0.99;
  EXPECT_GT(check(boxCase(s), kPoints, kSeed).refuted, 0u);
}

}  // namespace check_test
}  // namespace sdf::accuracy
