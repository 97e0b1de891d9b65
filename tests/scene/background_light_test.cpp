// The background's light against the mean, weighted by the cosine, that it stands for.
#include "sdf/scene/background_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sdf/eval/scalar_reading.h"
#include "sdf/scene/patterns.h"

namespace sdf {
namespace background_light_test {

Scene under(const Vec3E& background, const Expr& strength = 1.0) {
  Scene scene;
  scene.background = background;
  scene.backgroundLight = strength;
  return scene;
}

const glm::dvec3 kNormals[] = {{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0},   {1.0, 0.0, 0.0},  {0.0, 0.0, -1.0},
                               {0.6, 0.0, 0.8}, {0.48, -0.64, 0.6}, {-0.6, 0.8, 0.0}, {-0.36, 0.48, -0.8}};

// By brute force: rings about the normal, each as far from the next in the square of the sine.
glm::dvec3 meanOver(const Scene& scene, const glm::dvec3& n) {
  constexpr int kRings = 400, kTurns = 800;
  const auto tape = backgroundRadiance(scene).at();
  const glm::dvec3 aside = std::abs(n.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(n, aside)), up = glm::cross(n, across);
  glm::dvec3 sum(0.0);
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kTurns; ++k) {
      const double square = (i + 0.5) / kRings, turn = 2.0 * std::numbers::pi * (k + 0.5) / kTurns;
      const glm::dvec3 d =
          std::sqrt(1.0 - square) * n + std::sqrt(square) * (std::cos(turn) * across + std::sin(turn) * up);
      const auto seen = evaluateAll(*tape, d);
      sum += glm::dvec3(seen[0], seen[1], seen[2]);
    }
  return sum / static_cast<double>(kRings * kTurns);
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance);
}

// What is quadratic in the direction, but for the sum over directions that stands for an integral.
TEST(BackgroundLight, IsExactForQuadraticBackgrounds) {
  const Vec3E d = position();
  const Scene scene = under({2.0 + d.x * d.y + 0.5 * d.z, 3.0 + d.x - d.y * d.z + d.z * d.z, 1.5});
  const BackgroundLight light = backgroundLight(scene);
  for (const glm::dvec3& n : kNormals) {
    // A cosine leaves 2/3 of what is linear and 1/4 of what is quadratic and has no mean.
    const glm::dvec3 exact(
        2.0 + 0.25 * n.x * n.y + 0.5 * 2.0 / 3.0 * n.z,
        3.0 + 2.0 / 3.0 * n.x - 0.25 * n.y * n.z + 1.0 / 3.0 + 0.25 * (n.z * n.z - 1.0 / 3.0), 1.5);
    expectNear(light.at(n), exact, 2e-5);
    expectNear(meanOver(scene, n), exact, 1e-4);  // the brute force, in rings
  }
}

// A sky of two halves is exact, too: what is odd about the horizon has no second order, and what the fourth
// would add to its linear part is 0.
TEST(BackgroundLight, OfASkyIsNearTheMeanOfWhatASurfaceFaces) {
  Sky sky;
  sky.ground = Vec3E(0.1, 0.08, 0.05);
  const Scene skies[] = {under(skyColor(sky)), under(verticalGradient({0.1, 0.2, 0.3}, {1.0, 0.9, 0.7})),
                         under({select(less(position().y, 0.0), 0.0, 1.0), 0.5, 0.2})};
  for (const Scene& scene : skies) {
    const BackgroundLight light = backgroundLight(scene);
    for (const glm::dvec3& n : kNormals) expectNear(light.at(n), meanOver(scene, n), 0.02);
  }
}

// A sixteenth too bright where it is faced, and 3/32 or less from behind.
TEST(BackgroundLight, OfASunIsAsFarOffAsItSays) {
  Sky sky;
  sky.horizon = sky.zenith = Vec3E(0.0);
  sky.sun = Vec3E(0.0, 1.0, 0.0);
  sky.sunColor = Vec3E(257.0);
  sky.sunSize = 256.0;
  const BackgroundLight light = backgroundLight(under(skyColor(sky)));
  const double whole = 2.0;  // the integral of cos^256 over pi, times the colour
  expectNear(light.at({0.0, 1.0, 0.0}), glm::dvec3(17.0 / 16.0 * whole), 0.02 * whole);
  expectNear(light.at({0.0, -1.0, 0.0}), glm::dvec3(1.0 / 16.0 * whole), 0.02 * whole);
  expectNear(light.at({1.0, 0.0, 0.0}), glm::dvec3(3.0 / 32.0 * whole), 0.02 * whole);
}

TEST(BackgroundLight, FollowsItsStrengthAndIsNothingWithout) {
  Scene scene = under({0.5, 0.25, 1.0});
  scene.backgroundLight = scene.parameter("light", 2.0, 0.0, 4.0);
  expectNear(backgroundLight(scene).at({0.0, 1.0, 0.0}), {1.0, 0.5, 2.0}, 1e-4);
  const auto half = backgroundRadiance(scene).at({{"light", 0.5}});
  expectNear(backgroundLight(*half).at({0.0, 1.0, 0.0}), {0.25, 0.125, 0.5}, 1e-4);
  EXPECT_EQ(backgroundLight(under({0.5, 0.25, 1.0}, 0.0)), BackgroundLight{});
}

TEST(BackgroundLight, TakesNoLightFromWhatIsNone) {
  const Expr y = position().y;
  const BackgroundLight light = backgroundLight(under({y - 2.0, sqrt(y - 2.0), log(y * 0.0)}));
  EXPECT_EQ(light, BackgroundLight{});
  for (const glm::dvec3& n : kNormals)
    EXPECT_GE(backgroundLight(under({select(less(0.9, y), 1.0, 0.0), 0.0, 0.0})).at(n).x, 0.0);
}

}  // namespace background_light_test
}  // namespace sdf
