// The dense march itself, against roots that are known.
#include "sdf/march/oracle.h"

#include "march/scenes.h"

namespace sdf {
namespace oracle_test {

using namespace test;

constexpr double kReach = 8.0;
constexpr double kStep = 1e-3;
constexpr double kRounding = 1e-12;  // of the analytic roots, sums of a few squares below 100

TEST(DenseMarch, BracketsTheFirstRootWithinAStep) {
  const unsigned seed = 1;
  const Rays rays = raysInward(100, 3.0, kReach, seed);
  for (const AnalyticScene& scene : analyticScenes(kReach)) {
    const MarchField field = marchField(scene.shape).value();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto found = marchDensely(field, rays, i, kStep);
      const auto root = scene.firstRoot(rays.origin[i], rays.direction[i]);
      SCOPED_TRACE(std::string(scene.name) + ", seed " + std::to_string(seed) + ", " + describe(rays, i));
      ASSERT_EQ(found.has_value(), root && *root <= kReach);
      if (!found) continue;
      EXPECT_LE(found->before, *root + kRounding);
      EXPECT_GE(found->after, *root - kRounding);
      EXPECT_LE(found->after - found->before, kStep * (1.0 + kRounding));
    }
  }
}

TEST(DenseMarch, StepsShorterThroughASteeperField) {
  const MarchField steep = marchField(4.0 * (length(position()) - 1.0), 4.0);
  Rays rays;
  rays.add({0, 0, -3}, {0, 0, 1}, 0.0, 5.0);
  const auto found = marchDensely(steep, rays, 0, kStep);
  ASSERT_TRUE(found);
  EXPECT_LE(found->after - found->before, kStep / 4.0 * (1.0 + kRounding));
}

TEST(DenseMarch, BeginsAtTMinWithinTheSolid) {
  Rays rays;
  rays.add({0, 0, 0}, {0, 0, 1}, 0.5, 5.0);
  const auto found = marchDensely(marchField(sphere(1.0)).value(), rays, 0, kStep);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->before, 0.5);
  EXPECT_EQ(found->after, 0.5);
}

}  // namespace oracle_test
}  // namespace sdf
