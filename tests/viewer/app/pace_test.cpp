// Dynamic resolution.
#include <gtest/gtest.h>

#include <utility>

#include "viewer/app/canvas.h"

namespace sdf::viewer {
namespace pace_test {

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

TEST(PiecesTest, BeginsWithFewRows) { EXPECT_EQ(Pieces().rows(1280, 720, Pieces::kBudget), 16); }

TEST(PiecesTest, HasAsManyRowsAsFitTheTime) {
  for (const auto& [ray, height] : {std::pair(1e-8, 10'000), {1e-6, 300}, {1e-5, Pieces::kMost}}) {
    Pieces pieces;
    double seconds = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double rays = 1000.0 * pieces.rows(1000, height, Pieces::kBudget);
      seconds = ray * rays;
      pieces.drew(rays, seconds);
    }
    EXPECT_LE(seconds, Pieces::kBudget * 1.001) << ray;  // rounding
    EXPECT_GE(seconds, 0.4 * Pieces::kBudget) << ray << ": a whole number of rows";
    EXPECT_LE(pieces.rows(1000, height, 0.5 * Pieces::kBudget), pieces.rows(1000, height, Pieces::kBudget));
    EXPECT_LE(pieces.rows(36'000, height, Pieces::kBudget), pieces.rows(1000, height, Pieces::kBudget));
  }
}

TEST(PiecesTest, HasARowAtLeastAndForgetsAnOutlier) {
  Pieces pieces;
  pieces.drew(16'000.0, 100.0);  // compiling, say
  EXPECT_EQ(pieces.rows(1000, Pieces::kMost, Pieces::kBudget), 1);
  EXPECT_EQ(pieces.rows(1000, Pieces::kMost, -1.0), 1);
  for (int i = 0; i < 30; ++i) pieces.drew(1000.0, 1e-4);
  EXPECT_GT(pieces.rows(1000, 1000, Pieces::kBudget), 400);
}

// On a busy machine a piece waits longer than it may take, however few its rows.
TEST(PiecesTest, AreNotManyWhereEachHasACostOfItsOwn) {
  constexpr int kHeight = 480;
  Pieces pieces;
  int count = 0;
  for (int row = 0; row < kHeight; ++count) {
    const int rows = pieces.rows(640, kHeight, Pieces::kBudget);
    pieces.drew(640.0 * rows, 2.0 * Pieces::kBudget + 1e-5 * rows);
    row += rows;
  }
  EXPECT_LE(count, Pieces::kMost);
}

}  // namespace pace_test
}  // namespace sdf::viewer
