#include "sdf/gltf/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace view_test {

/// A dozen double operations on numbers of order 1 to 10.
constexpr double kRounding = 100 * std::numeric_limits<double>::epsilon();

const glm::dvec3 kAhead(0.0, 0.0, -1.0), kUp(0.0, 1.0, 0.0);

TEST(ViewCamera, LooksFromItsPlaceAtItsTarget) {
  Scene scene;
  scene.camera.from = Vec3E(1.0, 2.0, 3.0);
  scene.camera.to = Vec3E(-2.0, 2.0, 7.0);
  scene.camera.fov = 60.0;
  scene.maxDistance = 50.0;
  const auto camera = viewCamera(scene);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->placement.position, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_LT(glm::distance(camera->placement.rotation * kAhead, glm::dvec3(-0.6, 0.0, 0.8)), kRounding);
  EXPECT_LT(glm::distance(camera->placement.rotation * kUp, kUp), kRounding);
  EXPECT_NEAR(camera->verticalFov, std::numbers::pi / 3, kRounding);
  EXPECT_EQ(camera->far, 50.0);
  EXPECT_GT(camera->near, 0.0);
  EXPECT_LT(camera->near, camera->far);
}

// A scene that leaves the camera open: all of it is in view, in pictures of kPictureAspect.
TEST(ViewCamera, ShowsAllOfASceneOfAnySize) {
  for (const double s : {1e-6, 1.0, 1e6}) {
    Scene scene;
    scene.add("", translate(box(Vec3E(3.0 * s, s, s)), {10.0 * s, 0.0, 0.0}));
    const auto camera = viewCamera(scene);
    ASSERT_TRUE(camera);
    const double top = std::tan(0.5 * camera->verticalFov);
    double outermost = 0.0, farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 4 ? 13.0 : 7.0, corner & 2 ? 1.0 : -1.0, corner & 1 ? 1.0 : -1.0);
      const glm::dvec3 seen = glm::inverse(camera->placement.rotation) * (s * p - camera->placement.position);
      outermost = std::max({outermost, std::abs(seen.y) / (-seen.z * top),
                            std::abs(seen.x) / (-seen.z * top * kPictureAspect)});
      farthest = std::max(farthest, -seen.z);
      EXPECT_LT(camera->near, -seen.z);
    }
    EXPECT_NEAR(outermost, 1.0 / 1.05, kRounding) << "a twentieth is left";
    EXPECT_LT(farthest, camera->far);
    EXPECT_LT(camera->far, 100.0 * farthest);
  }
}

TEST(ViewCamera, TakesAnotherUpWhereItsOwnLiesAlongTheView) {
  for (const glm::dvec3& up :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, 1e-14, 1), glm::dvec3(0, -7, 0), glm::dvec3(0, 0, 0)}) {
    Scene scene;
    scene.camera.from = Vec3E(0.0, 5.0, 0.0);
    scene.camera.up = Vec3E(up);
    const auto camera = viewCamera(scene);
    ASSERT_TRUE(camera);
    EXPECT_LT(glm::distance(camera->placement.rotation * kAhead, -kUp), kRounding);
    EXPECT_NEAR(glm::length(camera->placement.rotation), 1.0, kRounding);
  }
}

TEST(ViewCamera, IsLeftOutWhereItsNumbersMakeNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto none = [](auto spoil) {
    Scene scene;
    spoil(scene);
    return !viewCamera(scene);
  };
  EXPECT_TRUE(none([](Scene& s) { s.camera.to = s.camera.eye(); }));
  EXPECT_TRUE(none([&](Scene& s) { s.camera.from = Vec3E(nan, 0.0, 0.0); }));
  EXPECT_TRUE(none([](Scene& s) { s.camera.fov = 180.0; }));
  EXPECT_TRUE(none([](Scene& s) { s.camera.fov = 0.0; }));
  EXPECT_TRUE(none([&](Scene& s) { s.camera.fov = nan; }));
  EXPECT_TRUE(none([](Scene& s) { s.maxDistance = kInfinity; }));
}

TEST(ViewLights, DirectionalLightsShineAwayFromWhereTheyAre) {
  Scene scene;
  Light light;
  light.vector = Vec3E(0.0, 4.0, 3.0);
  light.color = Vec3E(2.0, 1.0, 0.0);
  light.intensity = 3.0;
  scene.lights = {light};
  const auto lights = viewLights(scene, glm::dvec3(0.0));
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_LT(glm::distance(lights[0].placement.rotation * kAhead, glm::dvec3(0.0, -0.8, -0.6)), kRounding);
  EXPECT_EQ(lights[0].color, glm::dvec3(1.0, 0.5, 0.0));
  EXPECT_NEAR(lights[0].intensity, 6.0 * std::numbers::pi, 10 * kRounding);
}

TEST(ViewLights, PointLightsAreAsBrightAtTheCentreAsWithoutFallOff) {
  Scene scene;
  Light light;
  light.kind = Light::Kind::Point;
  light.vector = Vec3E(1.0, 2.0, 3.0);
  scene.lights = {light};
  const glm::dvec3 centre(1.0, 2.0, -1.0);
  const auto lights = viewLights(scene, centre);
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].placement.position, glm::dvec3(1.0, 2.0, 3.0));
  const double distance = 4.0;
  EXPECT_NEAR(lights[0].intensity / (distance * distance), std::numbers::pi, kRounding);
}

TEST(ViewLights, LeavesOutLightsThatDoNotShine) {
  Scene scene;
  Light black, flat, broken, negative;
  black.color = Vec3E(0.0);
  flat.vector = Vec3E(0.0);
  broken.intensity = std::numeric_limits<double>::quiet_NaN();
  negative.intensity = -1.0;
  scene.lights = {black, flat, broken, negative};
  EXPECT_TRUE(viewLights(scene, glm::dvec3(0.0)).empty());
}

}  // namespace view_test
}  // namespace sdf
