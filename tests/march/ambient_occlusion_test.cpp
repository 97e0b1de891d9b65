// Ambient occlusion against what geometry says and against many rays.
#include "sdf/march/ambient_occlusion.h"

#include <numbers>

#include "march/scenes.h"
#include "sdf/shape/operators/booleans.h"

namespace sdf {
namespace ambient_occlusion_test {

// Points on a floor at these distances from an endless wall, normals up.
struct Corner {
  MarchField field = marchField(plane(Vec3E(0, 1, 0), 0.0) | plane(Vec3E(1, 0, 0), 0.0)).value();
  Vectors points, normals;
  explicit Corner(int count = 40, double spacing = 0.01) {
    for (int i = 1; i <= count; ++i) {
      points.add({spacing * i, 0.0, 0.3});
      normals.add({0, 1, 0});
    }
  }
};

OcclusionRayOptions manyRays() {
  OcclusionRayOptions options;
  options.count = 1024;
  options.cutoff = 0.4;
  options.march.method = MarchMethod::AutoRelaxed;
  options.march.maxSteps = 10000;
  return options;
}

// Cosine-weighted directions are spread evenly over the unit disc; a wall at x hides those that lean by x /
// cutoff or more: a segment of the disc.
double wallSeen(double x, double cutoff) {
  const double q = std::min(1.0, x / cutoff);
  return 1.0 - (std::acos(q) - q * std::sqrt(1.0 - q * q)) / std::numbers::pi;
}

TEST(OcclusionByRays, IsWhatGeometrySaysInACorner) {
  const Corner corner;
  const OcclusionRayOptions options = manyRays();
  const Shade found = occlusionByRays(corner.field, corner.points, corner.normals, options).value();
  const double fourDeviations = 4.0 * 0.5 / std::sqrt(options.count);
  for (std::size_t i = 0; i < corner.points.size(); ++i) {
    EXPECT_EQ(found.status[i], RayStatus::Miss);
    EXPECT_NEAR(found.light[i], wallSeen(corner.points.x[i], options.cutoff), fourDeviations)
        << "seed " << options.seed << ", x " << corner.points.x[i];
  }
}

TEST(OcclusionByRays, IsDecidedByItsSeed) {
  const Corner corner;
  OcclusionRayOptions options = manyRays();
  options.count = 64;
  const auto first = occlusionByRays(corner.field, corner.points, corner.normals, options).value().light;
  EXPECT_EQ(first, occlusionByRays(corner.field, corner.points, corner.normals, options).value().light);
  options.seed = 99;
  EXPECT_NE(first, occlusionByRays(corner.field, corner.points, corner.normals, options).value().light);
}

TEST(OcclusionByRays, SaysWhenARayRanOutOfSteps) {
  const Corner corner(1);
  OcclusionRayOptions options = manyRays();
  options.march.maxSteps = 1;
  const Shade found = occlusionByRays(corner.field, corner.points, corner.normals, options).value();
  EXPECT_EQ(found.status[0], RayStatus::Budget);
}

TEST(Occlusion, OfAPlaneAloneIsNone) {
  const MarchField field = marchField(plane(Vec3E(0, 1, 0), 0.0)).value();
  Vectors points, normals;
  points.add({0.3, 0.0, 0.2});
  normals.add({0, 1, 0});
  EXPECT_EQ(occlusionByRays(field, points, normals, manyRays()).value().light[0], 1.0);
  const double rounding = 0x1p-24;  // of heights below 1, halved and more in the sum
  EXPECT_NEAR(occlusionByTaps(field, points, normals, {}).value()[0], 1.0, rounding);
}

TEST(OcclusionByTaps, IsNearerToManyRaysThanNoneAtAll) {
  const Corner corner;
  const auto rays = occlusionByRays(corner.field, corner.points, corner.normals, manyRays()).value().light;
  const auto taps = occlusionByTaps(corner.field, corner.points, corner.normals, {}).value();
  double tapError = 0.0, noneError = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    tapError += std::abs(taps[i] - rays[i]) / static_cast<double>(rays.size());
    noneError += (1.0 - rays[i]) / static_cast<double>(rays.size());
  }
  std::printf("corner, 5 taps over the rays' cutoff: mean error %.4f, without occlusion %.4f\n", tapError,
              noneError);
  EXPECT_LT(tapError, noneError);
}

TEST(OcclusionByTaps, IsEvansSum) {
  const MarchField field = marchField(plane(Vec3E(1, 0, 0), 0.0)).value();
  Vectors points, normals;
  points.add({0.1, 0.0, 0.0});
  normals.add({0, 1, 0});  // along the wall, always 0.1 from it
  double sum = 0.0;
  for (int i = 1; i <= 5; ++i) sum += (0.08 * i - 0.1) / std::pow(2.0, i);
  EXPECT_NEAR(occlusionByTaps(field, points, normals, {}).value()[0], 1.0 - sum, 0x1p-24);
}

// Over a floor at x from a wall, the distance at height h is min(h, x).
TEST(OcclusionByTaps, CountsTheMissingShareOfEachHeightWhereWeightsAreRelative) {
  const Corner corner;
  TapOptions options;
  options.weights = TapWeights::Relative;
  options.strength = 0.2;
  const std::vector<double> seen =
      occlusionByTaps(corner.field, corner.points, corner.normals, options).value();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    double sum = 0.0;
    for (int tap = 1; tap <= options.count; ++tap) {
      const double height = options.spacing * tap;
      sum += (height - std::min(height, corner.points.x[i])) / height;
    }
    const double rounding = options.count * 0x1p-24;  // of each share, which float gives from numbers below 1
    EXPECT_NEAR(seen[i], 1.0 - options.strength * sum, rounding) << "x " << corner.points.x[i];
  }
}

TEST(OcclusionByTaps, DoesNotDependOnHowTightTheSlopeIsKnown) {
  const Corner corner;
  const Expr distance = min(position().x, position().y);
  const auto seen = [&](double lipschitz) {
    return occlusionByTaps(marchField(distance, lipschitz), corner.points, corner.normals, {}).value();
  };
  const std::vector<double> tight = seen(1.0), loose = seen(10.0);
  EXPECT_LT(tight[0], 0.9);
  for (std::size_t i = 0; i < tight.size(); ++i) EXPECT_NEAR(tight[i], loose[i], 0x1p-24) << "rounding";
}

// Three times the distance to the floor and to a wall: the floor's taps, which say more than their heights,
// make up for nothing that the wall hides.
TEST(OcclusionByTaps, CountsNoTapAsFartherThanItsHeight) {
  const Vec3E p = position();
  Vectors points, normals;
  points.add({0.05, 0.0, 0.0});
  normals.add({0, 1, 0});
  const TapOptions options{2, 0.1, 0.5, TapWeights::Relative};  // 0.15 to the wall at 0.1 and at 0.2
  const MarchField steep = marchField(3.0 * min(p.x, p.y), 3.0);
  EXPECT_NEAR(occlusionByTaps(steep, points, normals, options).value()[0], 1.0 - 0.5 * 0.25, 1e-6);
}

TEST(OcclusionBySteps, DarkensWithEachStepDownToBlack) {
  const int steps[] = {0, 10, 100};
  EXPECT_EQ(occlusionBySteps(steps, 0.0625).value(), (std::vector<double>{1.0, 0.375, 0.0}));
}

TEST(Occlusion, RefusesWrongOptionsAndRows) {
  const Corner corner(1);
  const auto taps = [&](TapOptions options) {
    return occlusionByTaps(corner.field, corner.points, corner.normals, options).error().message;
  };
  EXPECT_EQ(taps({0}), "ambient occlusion: count must be at least 1");
  EXPECT_EQ(taps({5, 0.0}), "ambient occlusion: spacing must be positive and finite");
  EXPECT_EQ(taps({5, 0.1, -1.0}), "ambient occlusion: strength must be finite and at least 0");
  const auto rays = [&](int count, double cutoff, double start) {
    OcclusionRayOptions options;
    options.count = count, options.cutoff = cutoff, options.start = start;
    return occlusionByRays(corner.field, corner.points, corner.normals, options).error().message;
  };
  EXPECT_EQ(rays(0, 1.0, 0.0), "ambient occlusion: count must be at least 1");
  EXPECT_EQ(rays(1, 1.0, -0.1), "ambient occlusion: start must be finite and at least 0");
  EXPECT_EQ(rays(1, 0.1, 0.1), "ambient occlusion: cutoff must be finite and above start");
  EXPECT_EQ(occlusionByTaps(corner.field, corner.points, {}, {}).error().message,
            "ambient occlusion: the rows of points and of normals differ in length");
  Vectors longNormal;
  longNormal.add({0, 2, 0});
  EXPECT_EQ(occlusionByRays(corner.field, corner.points, longNormal, {}).error().message,
            "ambient occlusion: normal 0 must have length 1");
  EXPECT_EQ(occlusionBySteps({}, -1.0).error().message,
            "ambient occlusion: strength must be finite and at least 0");
}

}  // namespace ambient_occlusion_test
}  // namespace sdf
