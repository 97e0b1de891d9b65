// Dynamic resolution.
#include <gtest/gtest.h>

#include "viewer/app/canvas.h"

namespace sdf::viewer {
namespace {

TEST(PaceTest, FastFramesHaveAllPixels) {
  Pace pace;
  EXPECT_EQ(pace.scale(), 1.0);
  pace.drew(Pace::kBudget, 1.0);
  EXPECT_EQ(pace.scale(), 1.0);
}

TEST(PaceTest, SlowFramesHaveAsManyAsFitTheBudget) {
  // Frames whose time is proportional to their pixels, beside a part that is not.
  for (const double whole : {0.05, 0.1, 0.3, 1.0}) {
    constexpr double kFixed = 0.005;
    Pace pace;
    double seconds = 0.0;
    for (int i = 0; i < 20; ++i) {
      const double rays = pace.scale() * pace.scale();
      seconds = kFixed + whole * rays;
      pace.drew(seconds, rays);
    }
    EXPECT_LE(seconds, 1.0 / 20.0) << whole << " s a whole frame";
    // A step of the scale is a factor of 2, and the fixed part can cost one more.
    EXPECT_GE(seconds, 0.25 * Pace::kBudget) << whole << " s a whole frame";
  }
}

TEST(PaceTest, NeverGetsCoarserThanItsLimit) {
  Pace pace;
  pace.drew(1e6, 1.0);
  EXPECT_EQ(pace.scale(), Pace::kCoarsest);
}

TEST(PaceTest, AnOutlierIsForgotten) {
  Pace pace;
  pace.drew(2.0, 1.0);
  for (int i = 0; i < 10; ++i) pace.drew(0.01 * pace.scale() * pace.scale(), pace.scale() * pace.scale());
  EXPECT_EQ(pace.scale(), 1.0);
}

}  // namespace
}  // namespace sdf::viewer
