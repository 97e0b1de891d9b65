// Balls that rays meet by a root: which operands are such, and their pictures against the same balls marched.
#include "viewer/shaders/solved.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sdf/expr/expr.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/shaders/plan.h"

namespace sdf::test {
namespace solved_test {

void expectBall(const Shape& shape, const glm::dvec3& centre, double radius) {
  const auto ball = viewer::ballOf(shape);
  ASSERT_TRUE(ball);
  EXPECT_NEAR(uniformValue(ball->centre.x), centre.x, 1e-12);
  EXPECT_NEAR(uniformValue(ball->centre.y), centre.y, 1e-12);
  EXPECT_NEAR(uniformValue(ball->centre.z), centre.z, 1e-12);
  EXPECT_NEAR(uniformValue(ball->squaredRadius), radius * radius, 1e-12);
}

Shape at(const Shape& shape, double x, double y, double z) {
  return translate(shape, Vec3E(glm::dvec3(x, y, z)));
}

TEST(Solved, BallsAreKnownHoweverTheyArePlaced) {
  expectBall(sphere(0.7), {0, 0, 0}, 0.7);
  expectBall(at(sphere(0.7), 1, -2, 0.3), {1, -2, 0.3}, 0.7);
  expectBall(scale(at(sphere(0.5), 1, 2, 3), 2.0), {2, 4, 6}, 1.0);
  expectBall(
      at(rotate(at(sphere(0.5), 0, 0, 1), Vec3E(glm::dvec3(0.0, 0.5 * std::numbers::pi, 0.0))), 0, 1, 0),
      {1, 1, 0}, 0.5);
  expectBall(round(at(sphere(0.5), 0, 1, 0), 0.25), {0, 1, 0}, 0.75);
  const Expr radius = Expr::parameter({"radius", 0.4, 0.1, 2.0});
  expectBall(at(sphere(radius), 0, 1, 0), {0, 1, 0}, 0.4);
}

TEST(Solved, OtherShapesAreNoBalls) {
  for (const Shape& shape :
       {box(Vec3E(Expr(1.0))), torus(1.0, 0.3), capsule(Vec3E(Expr(-1.0)), Vec3E(Expr(1.0)), 0.3),
        cylinder(0.5, 1.0), shell(sphere(1.0), 0.1), sphere(1.0) | at(sphere(1.0), 3, 0, 0),
        scale(sphere(1.0), Vec3E(glm::dvec3(1.0, 2.0, 1.0)))})
    EXPECT_FALSE(viewer::ballOf(shape)) << shape.bounds.max.x;
}

TEST(Solved, ABallWithoutARadiusIsNone) {
  Shape shrunk = sphere(1.0);
  shrunk.distance = shrunk.distance + Expr::parameter({"less", 1.5, 0.0, 2.0});
  const auto ball = viewer::ballOf(shrunk);
  ASSERT_TRUE(ball);
  EXPECT_LE(uniformValue(ball->squaredRadius), 0.0);
}

/// The same values, of a form that nothing is known of.
Shape marched(Shape shape) {
  shape.distance = min(shape.distance, shape.distance + 1.0);
  return shape;
}

Scene sceneOf(const std::string& settings) {
  auto scene = runScene(R"(
    part("floor", plane():paint{color=checkerboard(0.2, 0.6)})
    part("red", sphere(1):translate(-1.2, 1, 0):paint{color="#c04030", reflectivity=0.4})
    part("blue", sphere(0.5):translate(0.6, 1.4, 0.5):paint{color="#3050c0"})
    part("small", sphere(0.05):translate(1.2, 0.05, 1):paint{color="#30c050"})
    part("crate", box(0.4, 0.6, 0.4):rotate(0, 30, 0):translate(1.6, 0.6, -0.6))
    )" + settings,
                        "scene");
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

void expectAlike(const std::string& settings, double apart, double decibels) {
  SCOPED_TRACE(settings);
  const Scene solved = sceneOf(settings);
  Scene stepped = solved;
  for (Part& part : stepped.parts)
    if (part.name != "floor") part.shape = marched(part.shape);
  const auto plan = viewer::planOf(solved, {});
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->balls.size(), 3u);
  ASSERT_TRUE(viewer::planOf(stepped, {})->balls.empty());
  const auto ours = colors(renderOnGpu(solved, {})), theirs = colors(renderOnGpu(stepped, {}));
  EXPECT_LE(shareApart(ours, theirs, 0.05), apart);
  EXPECT_GE(psnr(ours, theirs), decibels);
}

constexpr const char* kCamera =
    "camera{from={1,3,6}, to={0,0.8,0}} directional_light{direction={1,1.5,0.6}}\n";

TEST(SolvedPicture, LooksAsIfItWereMarched) {
  const std::string camera = kCamera;
  expectAlike(camera, 0.002, 45.0);
  expectAlike(camera + "shadows{kind='soft', sharpness=6} ambient_occlusion{}", 0.002, 45.0);
  expectAlike(camera + "shadows{kind='hard'}", 0.004, 38.0);
  expectAlike(camera + "shadows{kind='signed'}", 0.002, 45.0);
  expectAlike(camera + "shadows{kind='soft'} reflections{bounces=2}", 0.004, 40.0);
  expectAlike(
      "camera{from={1,3,6}, to={0,0.8,0}} point_light{position={2,3,1.5}, radius=0.3} shadows{kind='soft'}",
      0.01, 35.0);
  expectAlike("camera{from={300,200,600}, to={0,0.8,0}, fov=0.5} directional_light{direction={1,1.5,0.6}}",
              0.002, 45.0);
}

TEST(SolvedPicture, ACameraMayBeInABall) {
  expectAlike("camera{from={-1.2,1,0.3}, to={0,0.8,0}} directional_light{direction={1,1.5,0.6}}", 0.0, 60.0);
}

TEST(SolvedPicture, ReadsNothingOfBallsAndAFloor) {
  const auto scene = runScene(R"(part("floor", plane()) part("ball", sphere(1):translate(0, 1, 0))
                                 camera{from={1,3,6}, to={0,0.8,0}} directional_light{direction={1,1.5,0.6}}
                                 shadows{kind="soft"})",
                              "scene");
  ASSERT_TRUE(scene);
  EXPECT_EQ(readingsOnGpu(*scene, {}).primary, 0.0);
}

}  // namespace solved_test
}  // namespace sdf::test
