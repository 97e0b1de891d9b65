// Shadows against marched hits and against a disc of light sampled with many rays.
#include "sdf/march/shadow.h"

#include <numbers>

#include "march/scenes.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"

namespace sdf {
namespace shadow_test {

using test::raysInward;

constexpr ShadowMethod kMethods[] = {ShadowMethod::Hard, ShadowMethod::Soft, ShadowMethod::Improved,
                                     ShadowMethod::Signed};
const char* name(ShadowMethod m) {
  const char* names[] = {"hard", "soft", "improved", "signed"};
  return names[static_cast<int>(m)];
}

Shade shade(const MarchField& field, const Rays& rays, const ShadowOptions& options) {
  Result<Shade> result = shadows(field, rays, options);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  return *result;
}

// Share of a disc of angular radius `angle` around the vertical that each point sees, from 1024 rays spread
// evenly (Vogel's spiral).
std::vector<double> discLight(const MarchField& field, const Vectors& points, double angle, double start,
                              double reach) {
  constexpr int kRays = 1024;
  constexpr double kGoldenAngle = 2.399963229728653;
  std::vector<double> seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Rays rays;
    for (int s = 0; s < kRays; ++s) {
      const double radius = std::sqrt((s + 0.5) / kRays) * std::tan(angle), turn = s * kGoldenAngle;
      const glm::dvec3 towards(radius * std::cos(turn), 1.0, radius * std::sin(turn));
      rays.add(points[i], glm::normalize(towards), start, reach);
    }
    double sum = 0.0;
    for (const double light : shade(field, rays, {}).light) sum += light;
    seen.push_back(sum / kRays);
  }
  return seen;
}

double meanError(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

// What a disc shows past a straight edge that covers it up to x radii from its centre, and the curve that
// Signed puts in its place.
double discPastEdge(double x) { return 1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / std::numbers::pi; }
double smoothPastEdge(double x) { return 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x); }

double largestCurveError() {
  double worst = 0.0;
  for (double x = -1.0; x <= 1.0; x += 0x1p-10)
    worst = std::max(worst, std::abs(discPastEdge(x) - smoothPastEdge(x)));
  return worst;
}

// Points below the edge of a round bar of radius 2, as far to either side as the penumbra goes. Towards the
// rim of the lamp the bar bulges by a little more than its edge.
TEST(Shadows, OfADiscLightComeOutAsTheirFormulasTell) {
  constexpr double kAngle = 5.0 * std::numbers::pi / 180.0, kHeight = 2.0, kStart = 0.05, kReach = 10.0;
  constexpr double kRadius = 2.0;
  const Shape bar = capsule(Vec3E(-kRadius, kHeight, -20.0), Vec3E(-kRadius, kHeight, 20.0), kRadius);
  const MarchField field = marchField(bar).value();
  Vectors points;
  const double width = kHeight * std::tan(kAngle);
  for (int i = -100; i <= 100; ++i) points.add({width * i / 100.0, 0.0, 0.0});
  const std::vector<double> truth = discLight(field, points, kAngle, kStart, kReach);
  const Rays rays = raysTowards(points, {0, 1, 0}, kStart, kReach);
  const auto error = [&](ShadowMethod method) {
    const double mean = meanError(shade(field, rays, {method, 1.0 / std::tan(kAngle)}).light, truth);
    std::printf("disc light past an edge: %-8s mean error %.4f\n", name(method), mean);
    return mean;
  };
  const double bulge = kRadius * (1.0 / std::cos(kAngle) - 1.0) / width;
  // A disc shows (1 - 1/3) / pi on the average of the dark half, where Hard shows nothing, and the same is
  // missing from the light half, where Hard shows all.
  EXPECT_NEAR(error(ShadowMethod::Hard), 2.0 / (3.0 * std::numbers::pi), bulge);
  EXPECT_LE(error(ShadowMethod::Signed), largestCurveError() + bulge);
  // Soft is dark too under the edge, and 1/2 on the average beside it: together 1/4 away from the disc,
  // whatever its curve. Improved is darker by up to 1 - sqrt(3) / 2 of Soft's mean of 1/4.
  const double soft = error(ShadowMethod::Soft), improved = error(ShadowMethod::Improved);
  EXPECT_NEAR(soft, 0.25, bulge);
  EXPECT_GE(improved, soft);
  EXPECT_LE(improved, soft + (1.0 - std::sqrt(3.0) / 2.0) * 0.25);
}

TEST(Shadows, HardAreWhereAMarcherHits) {
  const Shape shape = torus(1.0, 0.3);
  const Rays rays = raysInward(1000, 3.0, 8.0, 1);
  const Hits hits = test::trace(shape, rays, {});
  const Shade dark = shade(marchField(shape).value(), rays, {});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(dark.status[i], hits.status[i]) << test::describe(rays, i);
    ASSERT_EQ(dark.light[i], hits.status[i] == RayStatus::Miss ? 1.0 : 0.0) << test::describe(rays, i);
  }
}

TEST(Shadows, StayBetweenNoneAndAll) {
  Rays rays = raysInward(5000, 3.0, 8.0, 2);
  std::fill(rays.tMin.begin(), rays.tMin.end(), 0.01);
  const Shape shape = box(Vec3E(0.9)) - sphere(1.1);
  for (const ShadowMethod method : kMethods)
    for (const double sharpness : {0.5, 8.0, 512.0}) {
      ShadowOptions options;
      options.method = method;
      options.sharpness = sharpness;
      const Shade result = shade(marchField(shape).value(), rays, options);
      for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_TRUE(result.light[i] >= 0.0 && result.light[i] <= 1.0)
            << name(method) << ' ' << result.light[i] << ", " << test::describe(rays, i);
    }
}

// The balls of a distance that grows faster than the ray goes do not meet: nothing is between the readings.
TEST(Shadows, ImprovedLightsWhatLeavesASurfaceSteeperThanADistance) {
  const Vec3E p = position();
  const Expr steep = (length(p) - 1.0) * 1.2;  // of which rays may go a third
  const MarchField field = marchField(steep, 3.6);
  Vectors points;
  for (double angle = 0.0; angle < 1.5; angle += 0.1) points.add({std::cos(angle), std::sin(angle), 0.0});
  Rays rays;
  for (std::size_t i = 0; i < points.size(); ++i)
    rays.add(points[i], {std::sqrt(0.5), std::sqrt(0.5), 0.0}, 0.05, 5.0);
  for (const double light : shade(field, rays, {ShadowMethod::Improved, 4.0}).light) EXPECT_GT(light, 0.9);
}

// The least k g / t along rays past a box's edges. Soft supposes one edge, corner or face where a box has
// several, and sees nothing before its first two readings. Improved supposes the worst between two balls:
// most where they are of one size, which makes d the height of a triangle with three equal sides.
TEST(Shadows, SoftErrLessThanImprovedToTheDark) {
  const unsigned seed = 3;
  const double step = 1e-3;
  Rays rays = raysInward(4000, 3.0, 6.0, seed);
  std::fill(rays.tMin.begin(), rays.tMin.end(), 0.5);
  const test::AnalyticScene scene = test::analyticScenes(6.0)[2];
  const MarchField field = marchField(scene.shape).value();
  const double k = 8.0;
  const std::vector<double> soft = shade(field, rays, {ShadowMethod::Soft, k}).light;
  const std::vector<double> improved = shade(field, rays, {ShadowMethod::Improved, k}).light;
  double softLight = 0.0, softDark = 0.0, improvedLight = 0.0, improvedDark = 0.0, improvedDarkest = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    double least = 1.0;
    for (double t = rays.tMin[i]; t < rays.tMax[i]; t += step)
      least = std::clamp(k * scene.distance(rays.at(i, t)) / t, 0.0, least);
    softDark += std::max(0.0, least - soft[i]);
    softLight = std::max(softLight, soft[i] - least);
    improvedLight = std::max(improvedLight, improved[i] - least);
    improvedDark += std::max(0.0, least - improved[i]);
    improvedDarkest = std::max(improvedDarkest, least - improved[i]);
  }
  softDark /= static_cast<double>(rays.size()), improvedDark /= static_cast<double>(rays.size());
  std::printf(
      "past a box, k 8: soft up to %.3f too light, %.2g too dark on average; improved %.3f and %.2g\n",
      softLight, softDark, improvedLight, improvedDark);
  EXPECT_LT(softDark, 0.25 * improvedDark);
  EXPECT_LE(improvedDarkest, 1.0 - std::sqrt(3.0) / 2.0);
  EXPECT_LT(improvedLight, 0.25 * softLight);
}

// Beside a wire the least k f / t is known: k times the sine of the angle between the ray and the way to it.
// Readings alone miss it, here more and there less: bands. The parabola through three of them finds it.
TEST(Shadows, SoftHaveNoBandsBesideAWire) {
  const double k = 6.0, start = 0.02, reach = 20.0, half = 1e-5;
  const glm::dvec3 light = glm::normalize(glm::dvec3(1.0, 2.0, 0.0)), wire(1.5, 3.0, 0.0);
  const MarchField field = marchField(translate(box(Vec3E(half, half, 50.0)), Vec3E(wire))).value();
  Vectors points;
  for (double x = -1.0; x < 1.0; x += 1.0 / 256.0) points.add({x, 0.0, 0.0});
  const std::vector<double> soft =
      shade(field, raysTowards(points, light, start, reach), {ShadowMethod::Soft, k}).light;
  double naiveError = 0.0, error = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 way = wire - points[i];
    const double truth = k * glm::length(glm::cross(glm::normalize(way), light));
    if (!(truth > 0.1 && truth < 1.0)) continue;
    double naive = 1.0;
    for (double t = start; t < reach; t += glm::length(t * light - way))
      naive = std::min(naive, k * glm::length(t * light - way) / t);
    naiveError = std::max(naiveError, naive / truth - 1.0);
    error = std::max(error, std::abs(soft[i] / truth - 1.0));
  }
  std::printf("beside a wire: readings alone up to %.4f too light, soft %.4f off\n", naiveError, error);
  EXPECT_GT(naiveError, 0.003);
  EXPECT_LT(error, 0.1 * naiveError);
}

TEST(Shadows, SignedLeakThroughThinSolids) {
  const MarchField plate = marchField(translate(box(Vec3E(5.0, 0.1, 5.0)), Vec3E(0.0, 2.0, 0.0))).value();
  Vectors points;
  points.add({0, 0, 0});
  ShadowOptions options;
  options.method = ShadowMethod::Signed;
  options.sharpness = 4.0;  // 2 t / k = 1, five times the thickness
  EXPECT_GT(shade(plate, raysTowards(points, {0, 1, 0}, 0.05, 10.0), options).light[0], 0.0);
  options.sharpness = 40.0;
  EXPECT_EQ(shade(plate, raysTowards(points, {0, 1, 0}, 0.05, 10.0), options).light[0], 0.0);
}

TEST(Shadows, EndAtAPointLight) {
  const MarchField field = marchField(translate(sphere(0.5), Vec3E(0.0, 3.0, 0.0))).value();
  Vectors points;
  points.add({0, 0, 0});
  for (const ShadowMethod method : kMethods) {
    ShadowOptions options;
    options.method = method;
    options.sharpness = 64.0;
    EXPECT_EQ(shade(field, raysToPoint(points, {0, 2, 0}, 0.02), options).light[0], 1.0) << name(method);
    EXPECT_EQ(shade(field, raysToPoint(points, {0, 5, 0}, 0.02), options).light[0], 0.0) << name(method);
    EXPECT_EQ(shade(field, raysToPoint(points, {0, 0, 0}, 0.02), options).light[0], 1.0) << name(method);
  }
}

// Past a ball whose distance is said to be ten times as steep as it is. Shorter steps read closer to where
// the ray is dimmed most: of k d / t the tight ones miss up to a tenth near a ball (it is tangents of angles
// that they compare).
TEST(Shadows, DoNotDependOnHowTightTheSlopeIsKnown) {
  constexpr double kSeen = 0.1;
  Rays rays = raysInward(2000, 3.0, 6.0, 5);
  std::fill(rays.tMin.begin(), rays.tMin.end(), 0.5);
  const Expr distance = length(position()) - 0.7;
  for (const ShadowMethod method : {ShadowMethod::Hard, ShadowMethod::Soft, ShadowMethod::Signed}) {
    const ShadowOptions options{.method = method, .maxSteps = 100'000};
    const Shade tight = shade(marchField(distance, 1.0), rays, options);
    const Shade loose = shade(marchField(distance, 10.0), rays, options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      SCOPED_TRACE(std::string(name(method)) + ", " + test::describe(rays, i));
      // Signed ends where a reading says that all is dark.
      if (method != ShadowMethod::Signed) {
        ASSERT_EQ(tight.status[i], loose.status[i]);
      }
      EXPECT_NEAR(loose.light[i], tight.light[i], method == ShadowMethod::Hard ? 0.0 : kSeen);
    }
  }
}

TEST(Shadows, SayWhenTheirStepsRunOutOrTheDistanceIsNotANumber) {
  const MarchField broken = marchField(sqrt(position().x), 1.0);
  Rays rays = raysInward(1, 3.0, 8.0, 4), left;
  rays.tMin[0] = 0.1;
  left.add({-1, 0, 0}, {0, 1, 0}, 0.1, 8.0);
  for (const ShadowMethod method : kMethods) {
    ShadowOptions options;
    options.method = method;
    options.maxSteps = 1;
    const Shade spent = shade(marchField(sphere(1.0)).value(), rays, options);
    EXPECT_EQ(spent.status[0], RayStatus::Budget) << name(method);
    EXPECT_EQ(spent.light[0], 0.0) << name(method) << ": nothing says that light arrives";
    const Shade undefined = shade(broken, left, options);
    EXPECT_EQ(undefined.status[0], RayStatus::Undefined) << name(method);
    EXPECT_EQ(undefined.light[0], 0.0) << name(method);
  }
}

TEST(Shadows, RefuseWrongOptionsAndRays) {
  const Expr y = position().y;
  const MarchField field = marchField(sphere(1.0)).value();
  const auto refusal = [&](const MarchField& f, ShadowOptions options) {
    Rays rays;
    rays.add({0, 0, 3}, {0, 1, 0}, 0.0, 1.0);
    const Result<Shade> result = shadows(f, rays, options);
    return result ? std::string() : result.error().message;
  };
  const ShadowMethod soft = ShadowMethod::Soft;
  EXPECT_EQ(refusal(field, {soft, 0.0}), "shadows: sharpness must be positive and finite");
  EXPECT_EQ(refusal(field, {soft, 8.0, 0.0}), "shadows: epsilon must be positive and finite");
  EXPECT_EQ(refusal(field, {soft, 8.0, 1e-4, 0}), "shadows: maxSteps must be at least 1");
  EXPECT_EQ(refusal(field, {soft}), "shadows: ray 0: soft shadows divide by t; start above 0");
  EXPECT_EQ(refusal(field, {}), "");
  EXPECT_EQ(
      refusal(marchField(sdf::field(y * y - 1.0)).value(), {}),
      "shadows: the shape's slope has no known bound; state one with field's lipschitz, or march by segments "
      "or bisection");
}

}  // namespace shadow_test
}  // namespace sdf
