// The debug views against what geometry, and the CPU's march, say of the same pixels.
#include <filesystem>
#include <tuple>

#include "sdf/script/script.h"
#include "support/samples.h"
#include "support/thorough.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace views_test {

using viewer::Method;
using viewer::View;

constexpr double kFloat = 0x1p-18;   // what positions up to 10 and some roundings of 2^-24 leave of a colour
constexpr double kNothing = 0.1;     // the grey where no ray hits
constexpr double kShadowHit = 1e-3;  // shadow rays hit this far from the surface

GpuRenderOptions viewOptions(View view) {
  GpuRenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.shader.view = view;
  return options;
}

std::vector<glm::vec4> drawView(const Scene& scene, View view) {
  return renderOnGpu(scene, viewOptions(view));
}

// How far from the surface a hit may be.
double off(const Scene& scene) { return hitThreshold(scene, viewOptions(View::Picture), kAway + 1.0); }

std::size_t at(int column, int row) { return static_cast<std::size_t>(row) * kWidth + column; }

double missOf(int column, int row) { return approach(kEye, rayThrough(column, row), glm::dvec3(0.0)); }

glm::dvec3 normalOfUnitBall(int column, int row) {
  const glm::dvec3 d = rayThrough(column, row);
  return kEye + enterSphere(kEye, d, glm::dvec3(0.0), 1.0) * d;
}

Scene unitBall(Material material = {}) {
  Scene scene = darkScene();
  scene.add("", ball(glm::dvec3(0.0), 1.0, std::move(material)));
  return scene;
}

// Of the unit ball's pixels those far enough from its rim to tell, with the greatest of `wrong`.
template <class Wrong>
void expectOfBall(const std::vector<glm::vec4>& picture, double tolerance, const Wrong& expected) {
  constexpr double kRim = 0.05;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const double miss = missOf(column, row);
      if (std::abs(miss - 1.0) < kRim) continue;
      const glm::dvec3 shown(picture[at(column, row)]);
      const bool hit = miss < 1.0;
      const glm::dvec3 wanted = hit ? expected(column, row) : glm::dvec3(kNothing);
      ASSERT_LE(farthest(shown, wanted), hit ? tolerance : kFloat) << "pixel " << column << ", " << row;
    }
}

TEST(Views, NormalsAreTheBallsOwn) {
  const Scene scene = unitBall();
  // A ray within the rim's share of the radius meets the ball at a cosine of at least 0.3; the normal is off
  // by the way along the surface, and shown at half its length.
  const double turn = 0.5 * off(scene) / 0.3;
  expectOfBall(drawView(scene, View::Normals), turn + kFloat,
               [](int column, int row) { return 0.5 + 0.5 * normalOfUnitBall(column, row); });
}

TEST(Views, MaterialIsTheDiffuseColorWithoutLight) {
  const glm::dvec3 color(0.8, 0.3, 0.1);
  expectOfBall(drawView(unitBall({.color = Vec3E(color)}), View::Material), kFloat,
               [&](int, int) { return color; });
}

TEST(Views, GradientIsGreenForExactDistancesBlueForShorterAndRedForLongerOnes) {
  const std::tuple<double, glm::dvec3> cases[] = {
      {1.0, {0.0, 1.0, 0.0}}, {0.5, {0.0, 0.5, 0.5}}, {1.5, {0.5, 0.5, 0.0}}};
  for (const auto& [slope, color] : cases) {
    const Vec3E p = position();
    Scene scene = darkScene();
    scene.add("", field(slope * (length(p) - 1.0), Box{glm::dvec3(-2.0), glm::dvec3(2.0)}, slope));
    expectOfBall(drawView(scene, View::Gradient), kFloat, [&, c = color](int, int) { return c; });
  }
}

// A slice through the unit ball, across the axis of sight, so tall that isolines a tenth apart lie several
// pixels apart.
class Slice : public testing::Test {
 protected:
  static constexpr int kSide = 401;
  static constexpr double kPixel = kAway / kSide, kIsolines = 0.1;
  // Lines fade over three quarters of a pixel to either side, the surface's white over twice that.
  static constexpr double kSurface = 2.0 * 0.75 * kPixel;

  void SetUp() override {
    GpuRenderOptions options;
    options.width = options.height = kSide;
    options.shader.view = View::Slice;
    picture = renderOnGpu(unitBall(), options);
  }
  // The pixel of a point of the slice, and the distance there.
  std::pair<glm::dvec3, double> read(double x, double y) const {
    const int column = static_cast<int>(std::floor(x / kPixel + 0.5 * kSide));
    const int row = static_cast<int>(std::floor(0.5 * kSide - y / kPixel));
    const glm::dvec2 middle((column + 0.5 - 0.5 * kSide) * kPixel, (0.5 * kSide - row - 0.5) * kPixel);
    return {glm::dvec3(picture[static_cast<std::size_t>(row) * kSide + column]), glm::length(middle) - 1.0};
  }
  std::vector<glm::vec4> picture;
};

double luminance(const glm::dvec3& c) { return c.x + c.y + c.z; }

TEST_F(Slice, IsWarmOutsideAndColdInside) {
  for (double y = -2.0; y <= 2.0; y += 0.13)
    for (double x = -2.0; x <= 2.0; x += 0.13) {
      const auto [c, distance] = read(x, y);
      if (std::abs(distance) < kPixel + kSurface) continue;
      EXPECT_EQ(c.x > c.z, distance > 0.0) << x << ", " << y;
    }
}

TEST_F(Slice, IsWhiteOnTheSurface) {
  for (double angle = 0.0; angle < 6.28; angle += 0.01) {
    const auto [c, distance] = read(std::cos(angle), std::sin(angle));
    EXPECT_GE(std::min({c.x, c.y, c.z}), 1.0 - std::abs(distance) / kSurface - kFloat) << angle;
  }
}

// Of a ring of pixels, which lie up to 0.7 of their side off it.
TEST_F(Slice, HasDarkLinesWhereTheDistanceIsAMultipleOfTheirSpacing) {
  const auto ring = [&](double distance) {
    double sum = 0.0;
    for (double angle = 0.0; angle < 6.28; angle += 0.01)
      sum += luminance(read((1.0 + distance) * std::cos(angle), (1.0 + distance) * std::sin(angle)).first);
    return sum / 628.0;
  };
  for (const double line : {-0.3, -0.2, 0.2, 0.3, 0.4, 0.5}) {
    EXPECT_LT(ring(line), ring(line - 0.5 * kIsolines)) << "line " << line;
    EXPECT_LT(ring(line), ring(line + 0.5 * kIsolines)) << "line " << line;
  }
}

// Rays to a far scene begin beside it; the slice lies before that.
TEST(Views, SliceIsSeenBetweenTheEyeAndAFarScene) {
  Scene scene = unitBall();
  scene.camera.from = Vec3E(0.0, 0.0, 1000.0);
  scene.camera.to = Vec3E(0.0, 0.0, 900.0);
  for (const glm::vec4& c : drawView(scene, View::Slice))
    ASSERT_GT(farthest(glm::dvec3(c), glm::dvec3(kNothing)), 0.1);
}

// Over a floor at x from a wall, as in truth_test.cpp: the distance at height h is min(h, x).
TEST(Views, OcclusionIsTheTapsShareAsGrey) {
  Scene scene = darkScene();
  scene.add("", wall({}));
  scene.add("", plane(Vec3E(1.0, 0.0, 0.0), -1.0));
  scene.ambientOcclusion = {
      .kind = AmbientOcclusion::Kind::Taps, .spacing = 0.2, .count = 6, .strength = 0.15};
  const AmbientOcclusion& o = scene.ambientOcclusion;
  const auto picture = drawView(scene, View::Occlusion);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const double x = onWall(column, row).x + 1.0;
      if (x < 0.1) continue;
      double sum = 0.0;
      for (int tap = 1; tap <= o.count; ++tap)
        sum += std::max(0.0, tap * *o.spacing - x) / (tap * *o.spacing);
      // Planes are met exactly; a tap's share is off by a position's rounding over the least height.
      ASSERT_LE(farthest(glm::dvec3(picture[at(column, row)]), glm::dvec3(1.0 - 0.15 * sum)),
                kFloat + 0.15 * o.count * 0x1p-20 / *o.spacing)
          << "pixel " << column << ", " << row;
    }
}

// Two suns, one of which a ball hides: its umbra is half as light. A third casts no shadows and is not asked.
TEST(Views, ShadowIsTheMeanShareOfTheLightsThatCastShadows) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(1.0, 0.4, 0.8)), other(-0.6, 0.0, 0.8),
                   center(0.7, 0.3, 1.2);
  const double radius = 0.6;
  Scene scene = darkScene();
  scene.add("", wall({}));
  scene.add("", ball(center, radius, {}));
  scene.lights = {sunTowards(sun), sunTowards(other), sunTowards({0.0, 0.0, 1.0})};
  scene.lights[2].castsShadow = false;
  scene.shadow = {.kind = Shadow::Kind::Hard, .steps = 500};
  const auto picture = drawView(scene, View::Shadow);
  const double edge = kShadowHit + 2.0 * off(scene), rim = 0.02;
  int compared = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const glm::dvec3 q = onWall(column, row);
      if (approach(kEye, rayThrough(column, row), center) < radius + rim) continue;
      double lit = 0.0;
      bool close = false;
      for (const glm::dvec3& l : {sun, other}) {
        const double past = approach(q, l, center);
        close = close || std::abs(past - radius) < edge;
        lit += past > radius ? 0.5 : 0.0;
      }
      if (close) continue;
      ++compared;
      ASSERT_EQ(picture[at(column, row)].x, lit) << "pixel " << column << ", " << row;
    }
  EXPECT_GT(compared, 0.7 * kWidth * kHeight);
}

TEST(Views, ShadowAndOcclusionAreWhiteWhereThereAreNone) {
  for (const View view : {View::Shadow, View::Occlusion})
    expectOfBall(drawView(unitBall(), view), 0.0, [](int, int) { return glm::dvec3(1.0); });
}

// How many readings a pixel's heat stands for.
int readingsOf(const glm::vec4& heat, int maxSteps) {
  int best = 0;
  double least = kInfinity;
  for (int n = 0; n <= maxSteps; ++n) {
    const double share = std::log2(1.0 + n) / std::log2(1.0 + maxSteps);
    const glm::dvec3 c = glm::clamp(1.5 - glm::abs(4.0 * share - glm::dvec3(3.0, 2.0, 1.0)), 0.0, 1.0);
    const double apart = farthest(c, glm::dvec3(heat));
    if (apart < least) least = apart, best = n;
  }
  EXPECT_LE(least, kFloat);
  return best;
}

TEST(Views, StepsAreMoreWhereRaysGrazeTheBall) {
  GpuRenderOptions options = viewOptions(View::Steps);
  options.shader.method = Method::Plain;
  options.maxSteps = 100;
  const auto picture = renderOnGpu(unitBall(), options);
  const int middle = readingsOf(picture[at(kWidth / 2, kHeight / 2)], options.maxSteps);
  EXPECT_EQ(middle, 3);  // head on: one from the eye, one there, one behind
  int grazing = 0;
  for (int column = 0; column < kWidth; ++column)
    grazing = std::max(grazing, readingsOf(picture[at(column, kHeight / 2)], options.maxSteps));
  EXPECT_GT(grazing, 3 * middle);
}

// The CPU's plain march stops at the same distance, and so runs out of steps at the same pixels, but for rays
// that come as close to that distance as rounding is.
TEST(Views, PixelsThatRanOutOfStepsAreMagentaAndTheirAlphaIsZero) {
  GpuRenderOptions options = viewOptions(View::Steps);
  options.shader.method = Method::Plain;
  options.maxSteps = 9;
  options.epsilon = 1e-3;
  options.threshold = 0.0;
  CpuRenderOptions onCpu;
  onCpu.width = kWidth;
  onCpu.height = kHeight;
  onCpu.march = {.method = MarchMethod::Plain, .epsilon = options.epsilon, .maxSteps = options.maxSteps};
  const Scene scene = unitBall();
  const Picture expected = renderOnCpu(scene, onCpu);
  const auto steps = renderOnGpu(scene, options);
  options.shader.view = View::Picture;
  const auto picture = renderOnGpu(scene, options);
  int spent = 0, apart = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool ranOut = expected.status[i] == RayStatus::Budget;
    const bool magenta = steps[i] == glm::vec4(1.0f, 0.0f, 1.0f, 0.0f);
    spent += ranOut;
    apart += magenta != ranOut;
    EXPECT_EQ(picture[i].a, magenta ? 0.0f : 1.0f);
    EXPECT_EQ(steps[i].a, magenta ? 0.0f : 1.0f);
  }
  EXPECT_GT(spent, 10);
  EXPECT_LE(apart, spent / 20);
}

class EveryView : public testing::TestWithParam<int> {};

// At a few pixels: that every shader compiles, and draws numbers. Compiling is what takes long: each view
// draws every third sample, another third than the next view, unless all are asked for.
TEST_P(EveryView, OfEverySampleCanBeDrawn) {
  int number = GetParam();
  for (const std::filesystem::path& file : samples()) {
    if (number++ % 3 != 0 && !isThorough()) continue;
    const auto scene = loadScene(file);
    ASSERT_TRUE(scene) << scene.error().message;
    GpuRenderOptions options = viewOptions(static_cast<View>(GetParam()));
    options.width = 16;
    options.height = 9;
    for (const glm::vec4& c : renderOnGpu(*scene, options))
      for (int i = 0; i < 3; ++i) ASSERT_TRUE(c[i] >= 0.0f && c[i] < INFINITY) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Views, EveryView, testing::Range(0, static_cast<int>(View::Count)));

}  // namespace views_test
}  // namespace sdf::test
