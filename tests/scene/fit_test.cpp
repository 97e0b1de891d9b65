// Cameras that show all of a scene, and the lengths of views that follow its size.
#include "sdf/scene/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace fit_test {

Scene sceneOf(const Shape& shape) {
  Scene scene;
  scene.add("", shape);
  return scene;
}

TEST(Fit, ShowsAllPartsOrWhatTheScenesBoundsLeaveOfThem) {
  Scene scene = sceneOf(box({1.0, 2.0, 3.0}));
  scene.add("", translate(sphere(1.0), {5.0, 0.0, 0.0}));
  scene.bounds = Box::centred(glm::dvec3(0.1));  // clips meshes, not pictures
  const auto inView = boundsInView(scene);
  ASSERT_TRUE(inView);
  EXPECT_EQ(inView->min, glm::dvec3(-1.0, -2.0, -3.0));
  EXPECT_EQ(inView->max, glm::dvec3(6.0, 2.0, 3.0));

  Scene ground = sceneOf(plane({0.0, 1.0, 0.0}, 0.0));
  EXPECT_FALSE(boundsInView(ground));
  ground.bounds = Box::centred(glm::dvec3(4.0));
  ASSERT_TRUE(boundsInView(ground));
  EXPECT_EQ(boundsInView(ground)->min, glm::dvec3(-4.0));
  ground.bounds = Box::centred(glm::dvec3(4.0, 4.0, kInfinity));
  EXPECT_FALSE(boundsInView(ground));
  ground.bounds = Box{{0.0, 1.0, 0.0}, {1.0, 2.0, 1.0}};
  EXPECT_FALSE(boundsInView(ground)) << "nothing is left";
}

/// How far out the corner of the box that is seen farthest out lies in the picture: 1 is its edge, infinite
/// what lies behind the camera.
double outermost(const Box& box, const glm::dvec3& from, const glm::dmat3& axes, double fov, double aspect) {
  double most = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 4 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 1 ? box.max.z : box.min.z);
    const glm::dvec3 seen = (p - from) * axes;
    if (!(seen.z > 0.0)) return kInfinity;
    const double up = std::abs(seen.y) / (seen.z * std::tan(0.5 * fov));
    const double right = std::abs(seen.x) / (seen.z * std::tan(0.5 * fov) * aspect);
    most = std::max({most, up, right});
  }
  return most;
}

// The margin is a twentieth; the rest is rounding.
TEST(Fit, LeavesAMarginOfATwentiethInPicturesOfAnyShape) {
  const Box box{{1.0, -2.0, 3.0}, {4.0, 0.5, 3.5}};
  for (const glm::dvec3& way : {glm::dvec3(0.0, -1.5, -6.0), {1.0, 0.1, 0.2}, {-0.3, -5.0, 0.4}})
    for (const double aspect : {0.2, 1.0, kPictureAspect, 8.0})
      for (const double fov : {0.05, 0.8, 2.0})
        for (const double scale : {1e-6, 1.0, 1e6}) {
          const glm::dvec3 forward = glm::normalize(way), up(0.0, 1.0, 0.0);
          const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
          const glm::dmat3 axes(right, glm::cross(right, forward), forward);
          const Box scaled{scale * box.min, scale * box.max};
          const glm::dvec3 from = scaled.centre() - fittingDistance(scaled, axes, fov, aspect) * forward;
          EXPECT_NEAR(outermost(scaled, from, axes, fov, aspect), 1.0 / 1.05, 1e-12)
              << aspect << " " << fov << " " << scale;
        }
}

TEST(Fit, LengthsThatASceneLeavesOpenFollowItsSize) {
  Scene scene = sceneOf(sphere(1.0));
  const ViewLengths placed = viewLengths(scene, std::nullopt), fitted = viewLengths(scene, 1e-3);
  EXPECT_EQ(placed.unit, 1.0);
  EXPECT_EQ(placed.maxDistance, 80.0);
  EXPECT_EQ(placed.shadowStart, 0.02);
  EXPECT_EQ(placed.shadowReach, 20.0);
  EXPECT_EQ(placed.tapSpacing, 0.08);
  EXPECT_EQ(fitted.unit, 0.5e-3);
  for (const auto length : {&ViewLengths::maxDistance, &ViewLengths::shadowStart, &ViewLengths::shadowReach,
                            &ViewLengths::tapSpacing})
    EXPECT_EQ(fitted.*length, placed.*length * fitted.unit);

  scene.maxDistance = 7.0;
  scene.shadow = {.kind = Shadow::Kind::Hard, .start = 0.5, .reach = 3.0};
  scene.ambientOcclusion.spacing = 0.25;
  for (const auto radius : {std::optional<double>(), std::optional(1e-3)}) {
    const ViewLengths stated = viewLengths(scene, radius);
    EXPECT_EQ(stated.maxDistance, 7.0);
    EXPECT_EQ(stated.shadowStart, 0.5);
    EXPECT_EQ(stated.shadowReach, 3.0);
    EXPECT_EQ(stated.tapSpacing, 0.25);
  }
}

}  // namespace fit_test
}  // namespace sdf
