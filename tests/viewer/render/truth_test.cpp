// Every renderer against what geometry says: light on surfaces, shadows, mirrors, fog, and the camera.
#include <glm/trigonometric.hpp>

#include "sdf/scene/fit.h"
#include "sdf/scene/patterns.h"
#include "sdf/shape/operators/booleans.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace truth_test {

constexpr double kShadowEpsilon = 1e-3;  // shadow rays hit this far from the surface
constexpr glm::dvec3 kBlack(0.0), kWhite(1.0), kRed(1.0, 0.0, 0.0);

// Around a ball's rim a pixel may go either way, and hits some `offset` before the surface lie far from it
// along the ray. This close to it, in radii, nothing is expected.
constexpr double kRim = 0.02;

// A hit is at most offset / cos before the surface along a ray that meets it at this angle.
double slide(double offset, double cosine) { return offset / cosine; }

// Of the unit ball at the origin: what its colour is at the true hit, and how fast that changes as the normal
// turns. The normal turns by the way along the surface that a hit is off.
Expectation onUnitBall(double rounding, double offset, double steepness,
                       const std::function<glm::dvec3(const glm::dvec3& n, const glm::dvec3& d)>& color) {
  return [=](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 d = rayThrough(column, row);
    const double miss = approach(kEye, d, glm::dvec3(0.0));
    if (std::abs(miss - 1.0) < kRim) return std::nullopt;
    if (miss > 1.0) return Expected{kBlack, rounding};
    const glm::dvec3 n = glm::normalize(kEye + enterSphere(kEye, d, glm::dvec3(0.0), 1.0) * d);
    const double cosine = -glm::dot(n, d), turn = slide(offset, cosine) * std::sqrt(1.0 - cosine * cosine);
    return Expected{color(n, d), rounding + steepness * turn};
  };
}

// Any grey from `low` to `high`.
Expected between(double low, double high, double slack) {
  return {glm::dvec3(0.5 * (low + high)), 0.5 * (high - low) + slack};
}

TEST_P(Truth, LambertsLawHoldsOnABall) {
  const glm::dvec3 color(0.9, 0.5, 0.2), sun = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
  Scene scene = darkScene();
  scene.add("", ball(kBlack, 1.0, {.color = Vec3E(color)}));
  scene.lights = {sunTowards(2.5 * sun)};
  const double steepness = 1.0;  // of the cosine, the colour being at most 1
  expectPicture(draw(scene), onUnitBall(rounding(), offset(), steepness, [&](const glm::dvec3& n, auto&) {
                  return color * std::max(0.0, glm::dot(n, sun));
                }));
}

// The light is placed so that the ball mirrors it into the eye in the middle of one pixel.
TEST_P(Truth, PhongsHighlightIsBrightestWhereTheBallMirrorsTheLightIntoTheEye) {
  const int column = 90, row = 37;
  const double shininess = 40.0;
  const glm::dvec3 view = -rayThrough(column, row);
  const glm::dvec3 n = kEye - enterSphere(kEye, -view, glm::dvec3(0.0), 1.0) * view;
  const glm::dvec3 light = glm::reflect(-view, n), color(0.9, 0.6, 0.3);
  Scene scene = darkScene();
  scene.add("", ball(kBlack, 1.0, {.color = Vec3E(0.0), .specular = Vec3E(color), .shininess = shininess}));
  scene.lights = {sunTowards(light)};
  // cos^k falls by less than sqrt(k) a radian; a mirror turns what it shows by twice its own turn.
  const double steepness = 2.0 * std::sqrt(shininess);
  const Picture picture = draw(scene);
  expectPicture(picture, onUnitBall(rounding() * steepness, offset(), steepness,
                                    [&](const glm::dvec3& at, const glm::dvec3& d) {
                                      const double aim = glm::dot(glm::reflect(d, at), light);
                                      return color * std::pow(std::max(0.0, aim), shininess);
                                    }));
  const glm::dvec3 peak = picture.color[picture.at(column, row)];
  EXPECT_LE(farthest(peak, color), rounding() + shininess * offset());
  for (const glm::dvec3& c : picture.color) EXPECT_LE(c.x, peak.x + rounding());
}

// A ball's parallel shadow on a plane is an ellipse: the points whose line to the sun comes nearer to the
// centre than the radius.
TEST_P(Truth, TheUmbraOfABallIsAnEllipse) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(1.0, 0.4, 0.8)), center(0.7, 0.3, 1.2);
  const double radius = 0.6;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", ball(center, radius, {.color = Vec3E(0.0), .emission = Vec3E(kRed)}));
  scene.lights = {sunTowards(sun)};
  scene.shadow = {.kind = Shadow::Kind::Hard, .steps = 500};
  const double edge = kShadowEpsilon + 2.0 * offset();  // the rays start a little beside the true point, too
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 d = rayThrough(column, row);
    const double miss = approach(kEye, d, center), past = approach(onWall(column, row), sun, center);
    if (std::abs(miss - radius) < kRim || std::abs(past - radius) < edge) return std::nullopt;
    if (miss < radius) return Expected{kRed, rounding()};
    return Expected{past < radius ? kBlack : kWhite * sun.z, rounding()};
  });
}

// How far the ball covers the sun as the soft formulas see it, without their gaps: the least k g / t.
double leastRatio(const glm::dvec3& q, const glm::dvec3& sun, const glm::dvec3& center, double radius,
                  const Scene& scene) {
  const double sharpness = uniformValue(scene.shadow.sharpness);
  double least = 1.0;
  const ViewLengths lengths = viewLengths(scene, std::nullopt);
  for (double t = lengths.shadowStart; t < lengths.shadowReach; t += 0x1p-6) {
    const glm::dvec3 p = q + t * sun;
    const double g = std::min(p.z, glm::length(p - center) - radius);
    least = std::min(least, sharpness * g / t);
  }
  return std::max(least, 0.0);
}

// The most that a reading can be where steps are as long as g. Of two readings to both sides of where the
// ball is nearest, the nearer one lies no farther from there than s with g(s) = 2 s, g = sqrt(past^2 + s^2) -
// r.
double sparseRatio(const glm::dvec3& q, const glm::dvec3& sun, const glm::dvec3& center, double radius,
                   const Scene& scene) {
  const double past = approach(q, sun, center), r = radius;
  const double s = (std::sqrt(16.0 * r * r + 12.0 * (past * past - r * r)) - 4.0 * r) / 6.0;
  const double t = glm::dot(center - q, sun) - s, g = 2.0 * s;
  if (t < viewLengths(scene, std::nullopt).shadowStart || t <= g) return 1.0;
  // Improved divides by up to sqrt(t^2 - g^2) instead of t.
  return std::min(1.0, uniformValue(scene.shadow.sharpness) * g / std::sqrt(t * t - g * g));
}

double signedCurve(double x) { return 0.25 * (1.0 + x) * (1.0 + x) * (2.0 - x); }

// Soft reads the ratio here and there. Improved supposes the worst between two readings, by sqrt(3) / 2
// darker than the truth. Signed shows half the sun at the umbra's edge (sdf/march/shadow.h).
TEST_P(Truth, SoftShadowsAreDarkInTheUmbraAndFadeAsTheBallIsPassedFartherOff) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(1.0, 0.4, 0.8)), center(0.7, 0.3, 1.2);
  const double radius = 0.6, worst = std::sqrt(3.0) / 2.0;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", ball(center, radius, {.color = Vec3E(0.0), .emission = Vec3E(kRed)}));
  scene.lights = {sunTowards(sun)};
  scene.lights[0].color = Vec3E(1.0 / sun.z);  // so that the wall is white
  for (const Shadow::Kind kind : {Shadow::Kind::Soft, Shadow::Kind::Improved, Shadow::Kind::Signed}) {
    scene.shadow = {.kind = kind, .start = 0.1, .reach = 4.0, .steps = 2000};
    // The ball is met at t > 1/2, where the ratio moves by this much with the point.
    const double edge = kShadowEpsilon + 2.0 * offset(), slack = rounding() + 8.0 * edge / 0.5;
    expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
      const double miss = approach(kEye, rayThrough(column, row), center);
      const glm::dvec3 q = onWall(column, row);
      const double past = approach(q, sun, center);
      if (std::abs(miss - radius) < kRim || std::abs(past - radius) < edge) return std::nullopt;
      if (miss < radius) return Expected{kRed, rounding()};
      const bool isSigned = kind == Shadow::Kind::Signed;
      if (past < radius) return between(0.0, isSigned ? 0.5 : 0.0, slack);
      const double least = leastRatio(q, sun, center, radius, scene);
      const double most = sparseRatio(q, sun, center, radius, scene);
      if (isSigned) return between(signedCurve(least), signedCurve(most), slack);
      return between(kind == Shadow::Kind::Improved ? worst * least : least, most, slack);
    });
  }
}

TEST_P(Truth, APointLightsShadowEndsWhereItsRaysTouchTheBall) {
  const glm::dvec3 first(-1.5, 0.5, 3.0), second(1.0, 1.0, 2.5), center(-0.3, 0.2, 0.9);
  const double radius = 0.4;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", ball(center, radius, {.color = Vec3E(0.0), .emission = Vec3E(kRed)}));
  scene.lights = {pointLight(first, {0.0, 0.8, 0.0}), pointLight(second, {0.0, 0.0, 0.7})};
  scene.lights[1].castsShadow = false;
  scene.shadow = {.kind = Shadow::Kind::Hard, .steps = 500};
  const double edge = kShadowEpsilon + 2.0 * offset();
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 q = onWall(column, row), way = glm::normalize(first - q);
    const double miss = approach(kEye, rayThrough(column, row), center), past = approach(q, way, center);
    if (std::abs(miss - radius) < kRim || std::abs(past - radius) < edge) return std::nullopt;
    if (miss < radius) return Expected{kRed, rounding()};
    const double lit = past < radius ? 0.0 : 0.8 * way.z;
    // Directions to a light more than 1 away turn by less than the point moves, by at most twice the offset.
    return Expected{{0.0, lit, 0.7 * glm::normalize(second - q).z}, rounding() + 2.0 * offset()};
  });
}

TEST_P(Truth, TwoPointLightsAddUp) {
  const glm::dvec3 positions[] = {{-1.0, 0.5, 1.5}, {2.0, -1.0, 2.0}},
                   colors[] = {{0.5, 0.1, 0}, {0, 0.4, 1}};
  const double intensities[] = {0.8, 0.6};
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  for (int i = 0; i < 2; ++i) scene.lights.push_back(pointLight(positions[i], colors[i], intensities[i]));
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 q = onWall(column, row);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 2; ++i) sum += colors[i] * intensities[i] * glm::normalize(positions[i] - q).z;
    return Expected{sum, rounding() + 2.0 * offset()};
  });
}

// As if a second ball stood behind the mirror.
TEST_P(Truth, AMirrorShowsABallWhereItsImageIs) {
  const glm::dvec3 center(2.0, 1.0, 1.0), image(2.0, 1.0, -1.0), glow(0.2, 0.9, 0.5);
  const double radius = 0.25;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.0), .reflectivity = 1.0}));
  scene.add("", ball(center, radius, {.color = Vec3E(0.0), .emission = Vec3E(glow)}));
  const double edge = 4.0 * offset() + rounding();  // of the image, which moves twice as far as the mirror
  int mirrored = 0;
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 d = rayThrough(column, row);
    const double miss = approach(kEye, d, center), past = approach(kEye, d, image);
    if (std::abs(miss - radius) < kRim || std::abs(past - radius) < edge) return std::nullopt;
    if (miss > radius && past < radius) ++mirrored;
    return Expected{std::min(miss, past) < radius ? glow : kBlack, rounding()};
  });
  const double imageRadius = radius / (kAway + 1.0) * kHeight;  // in pixels; at least half of it is seen
  EXPECT_GT(mirrored, 0.5 * std::numbers::pi * imageRadius * imageRadius);
}

// Two mirrors face each other with the eye between them; each bounce shows the other's glow, the last one
// all of it.
TEST_P(Truth, MirrorsFacingEachOtherShowAsManyBouncesAsAsked) {
  const glm::dvec3 glow[] = {{0.8, 0.0, 0.2}, {0.0, 0.6, 0.4}};
  const double weight = 0.5;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.0), .reflectivity = weight, .emission = Vec3E(glow[0])}));
  scene.add("", plane(Vec3E(0.0, 0.0, -1.0), -2.0 * kAway)
                    .paint({.color = Vec3E(0.0), .reflectivity = weight, .emission = Vec3E(glow[1])}));
  for (int bounces = 0; bounces <= 4; ++bounces) {
    scene.reflectionBounces = bounces;
    glm::dvec3 expected = glow[bounces % 2];
    for (int k = bounces - 1; k >= 0; --k) expected = (1.0 - weight) * glow[k % 2] + weight * expected;
    EXPECT_LE(farthest(middle(draw(scene)), expected), rounding()) << bounces << " bounces";
  }
}

// Straight on a metal's mirror has the tint of its highlight; what it mirrors more at grazing angles is
// white.
TEST_P(Truth, AMirrorIsTintedByTheHighlightButAtItsRim) {
  Scene scene = darkScene();
  const glm::dvec3 gold(0.8, 0.4, 0.2);
  scene.add("", ball(glm::dvec3(0.0), 1.0,
                     {.color = Vec3E(0.0),
                      .specular = Vec3E(gold),
                      .reflectivity = 0.5,
                      .fresnelPower = 5.0,
                      .fresnelBias = 1.0}));
  scene.background = Vec3E(1.0);
  const Picture picture = draw(scene);
  EXPECT_LE(farthest(middle(picture), 0.5 * gold / 0.8), rounding());
  const int column = static_cast<int>(kWidth / 2 + 0.97 * kHeight / std::sqrt(kAway * kAway - 1.0));
  const glm::dvec3 rim = picture.color[picture.at(column, kHeight / 2)];
  const glm::dvec3 more = rim - middle(picture);
  const double miss = approach(kEye, rayThrough(column, kHeight / 2), glm::dvec3(0.0));
  const double cosine = std::sqrt(1.0 - miss * miss), slope = 2.5 * std::pow(1.0 - cosine, 4.0);
  EXPECT_NEAR(more.x, 0.5 * std::pow(1.0 - cosine, 5.0), rounding() + slope * offset() / cosine);
  EXPECT_LE(farthest(more, glm::dvec3(more.x)), 2.0 * rounding());
}

// Phong's lobe of exponent n about the way straight up: where the sky is white for cosines above c and black
// below, a mirror seen straight on shows 1 - c^(n + 1) of it. The samples' places fill the square evenly, and
// n samples miss a share by a few times log(n) / n.
TEST(Glossy, AMirrorShowsTheShareOfItsLobe) {
  Scene scene = darkScene();
  const double exponent = 20.0, cosine = 0.95;
  scene.add("", wall({.color = Vec3E(0.0), .shininess = exponent, .reflectivity = 1.0}));
  const Vec3E d = position();
  scene.background = Vec3E(select(less(cosine, d.z), 1.0, 0.0));
  scene.camera.fov = 0.1;  // all rays go straight on
  scene.glossyReflections = true;
  GpuRenderOptions options;
  options.width = options.height = 8;
  options.samples = 16;
  const double expected = 1.0 - std::pow(cosine, exponent + 1.0);
  for (const glm::vec4& pixel : renderOnGpu(scene, options)) ASSERT_NEAR(pixel.x, expected, 6.0 / 256.0);
  scene.glossyReflections = false;
  for (const glm::vec4& pixel : renderOnGpu(scene, options)) ASSERT_NEAR(pixel.x, 1.0, 1e-3);
}

// Under a white sky a black mirror is as bright as its weight.
TEST_P(Truth, FresnelsWeightIsTheBiasHeadOnAndGrowsAtGrazingAngles) {
  const double reflectivity = 0.7, power = 4.0, bias = 0.2;
  Scene scene = darkScene();
  scene.background = Vec3E(1.0);
  scene.add(
      "",
      wall({.color = Vec3E(0.0), .reflectivity = reflectivity, .fresnelPower = power, .fresnelBias = bias}));
  for (const double degrees : {0.0, 60.0, 85.0}) {
    const double angle = glm::radians(degrees);
    scene.camera.from = Vec3E(kAway * std::sin(angle), 0.0, kAway * std::cos(angle));
    const double expected = reflectivity * (bias + std::pow(1.0 - std::cos(angle), power));
    EXPECT_LE(farthest(middle(draw(scene)), glm::dvec3(expected)), rounding()) << degrees << " degrees";
  }
}

TEST_P(Truth, FogKeepsTheShareThatItsDepthSays) {
  const glm::dvec3 glow(0.9, 0.3, 0.1), fog(0.1, 0.4, 0.8);
  const double density = 0.2;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.0), .emission = Vec3E(glow)}));
  scene.fog = {.color = Vec3E(fog), .density = density};
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const double cosine = -rayThrough(column, row).z, depth = kAway / cosine;
    return Expected{glm::mix(fog, glow, std::exp(-density * depth)),
                    rounding() + density * slide(offset(), cosine)};
  });
}

TEST_P(Truth, FogLeavesTheBackgroundAsItIs) {
  const glm::dvec3 sky(0.3, 0.6, 0.9);
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, 2.0 * kAway}, 1.0, {}));  // behind the eye
  scene.background = Vec3E(sky);
  scene.fog = {.color = Vec3E(1.0), .density = 1.0};
  expectPicture(draw(scene), [&](int, int) -> std::optional<Expected> { return Expected{sky, rounding()}; });
}

TEST_P(Truth, TheBackgroundIsAFormulaOfTheRaysDirection) {
  const Vec3E d = position();
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, 2.0 * kAway}, 1.0, {}));  // behind the eye
  scene.background = {0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y, d.z * d.z};
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec3 ray = rayThrough(column, row);
    return Expected{{0.5 + 0.5 * ray.x, 0.5 + 0.5 * ray.y, ray.z * ray.z}, rounding()};
  });
}

// Seen from above, so that squares are squares. Within a pixel of their sides a picture may be filtered.
TEST_P(Truth, ACheckerboardHasItsColorsInItsSquares) {
  const glm::dvec3 even(0.9, 0.2, 0.1), odd(0.1, 0.3, 0.8);
  const double side = 0.8, pixel = kAway / kHeight;
  Scene scene = darkScene();
  scene.camera.from = Vec3E(0.0, kAway, 0.0);
  scene.camera.up = Vec3E(0.0, 0.0, -1.0);
  scene.ambient = Vec3E(1.0);
  scene.add("",
            plane(Vec3E(0.0, 1.0, 0.0), 0.0).paint({.color = checkerboard(Vec3E(even), Vec3E(odd), side)}));
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const glm::dvec2 at = kAway * onScreen(column, row) * glm::dvec2(1.0, -1.0) / side;
    const glm::dvec2 off = glm::abs(at - glm::round(at)) * side;
    if (std::min(off.x, off.y) < pixel)
      return Expected{0.5 * (even + odd), 0.5 * farthest(even, odd) + rounding()};
    const int square = static_cast<int>(std::floor(at.x)) + static_cast<int>(std::floor(at.y));
    return Expected{square % 2 == 0 ? even : odd, rounding()};
  });
}

// Over a floor at x from a wall, the distance at height h is min(h, x).
TEST_P(Truth, OcclusionTapsCountTheMissingShareOfTheirHeights) {
  Scene scene = darkScene();
  scene.ambient = Vec3E(0.9);
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", plane(Vec3E(1.0, 0.0, 0.0), -1.0).paint({.color = Vec3E(0.0)}));
  scene.ambientOcclusion = {
      .kind = AmbientOcclusion::Kind::Taps, .spacing = 0.2, .count = 6, .strength = 0.15};
  const AmbientOcclusion& o = scene.ambientOcclusion;
  expectPicture(draw(scene), [&](int column, int row) -> std::optional<Expected> {
    const double x = onWall(column, row).x + 1.0;
    if (std::abs(x) < slide(offset(), 0.1)) return std::nullopt;
    if (x < 0.0) return Expected{kBlack, rounding()};
    double sum = 0.0, slope = 0.0;
    for (int tap = 1; tap <= o.count; ++tap) {
      const double h = tap * *o.spacing;
      sum += (h - std::min(h, x)) / h;
      slope += 1.0 / h;
    }
    return Expected{glm::dvec3(0.9 * (1.0 - 0.15 * sum)), rounding() + 0.15 * slope * 2.0 * offset()};
  });
}

// Eye at (3, 0, 0), looking along -x with a vertical field of view of 90 degrees: the point (0, 1, -1.5) is a
// quarter of the picture's height to the right of the middle, and a sixth above it.
TEST_P(Truth, AKnownPointIsSeenInItsPixel) {
  const double radius = 0.2;
  Scene scene = darkScene();
  scene.add("", ball({0.0, 1.0, -1.5}, radius, {.color = Vec3E(0.0), .emission = Vec3E(1.0)}));
  scene.camera.from = Vec3E(3.0, 0.0, 0.0);
  scene.camera.fov = 90.0;
  for (const bool mirrored : {false, true}) {
    scene.camera.mirrored = mirrored;
    const Picture picture = draw(scene);
    glm::dvec2 sum(0.0);
    double weight = 0.0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const double c = picture.color[picture.at(column, row)].x;
        sum += c * glm::dvec2(column + 0.5, row + 0.5);
        weight += c;
      }
    const glm::dvec2 expected(0.5 * kWidth + (mirrored ? -0.25 : 0.25) * kHeight, kHeight / 3.0);
    // The middle of a ball's image lies farther out than the image of its middle by this share (Hahn).
    const double eccentric = radius * radius / (9.0 - radius * radius), kHalfPixel = 0.5;
    ASSERT_GT(weight, 0.0);
    EXPECT_LE(std::abs(sum.x / weight - expected.x), kHalfPixel + 0.25 * kHeight * eccentric);
    EXPECT_LE(std::abs(sum.y / weight - expected.y), kHalfPixel + kHeight / 6.0 * eccentric);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Truth, testing::ValuesIn(renderers()),
                         [](const auto& info) { return info.param.name; });

}  // namespace truth_test
}  // namespace sdf::test
