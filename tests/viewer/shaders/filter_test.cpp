// Patterns seen from so far that a pixel covers many of their squares.
#include <glm/trigonometric.hpp>

#include "sdf/scene/patterns.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace filter_test {

using viewer::View;

constexpr double kSide = 0.25;  // of a square
const glm::dvec3 kEven(1.0, 0.2, 0.0), kOdd(0.0, 0.6, 1.0), kMean = 0.5 * (kEven + kOdd);

Shape board() {
  return plane(Vec3E(0.0, 1.0, 0.0), 0.0)
      .paint({.color = Vec3E(0.0), .emission = checkerboard(Vec3E(kEven), Vec3E(kOdd), kSide)});
}

// From a unit above a floor, along it: the horizon is the picture's middle.
Scene alongTheFloor(Shape floor) {
  Scene scene = darkScene();
  scene.add("floor", std::move(floor));
  scene.camera.from = Vec3E(0.3, 1.0, 0.1);
  scene.camera.to = Vec3E(1.2, 1.0, -3.0);
  scene.maxDistance = 1e4;
  return scene;
}

std::vector<glm::vec4> drawFloor(const Scene& scene, bool filter = true) {
  GpuRenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.filter = filter;
  return renderOnGpu(scene, options);
}

// How far the pixels of the row so many below the horizon are from the two colours' mean.
double worstOfRow(const std::vector<glm::vec4>& picture, int below) {
  double worst = 0.0;
  for (int column = 0; column < kWidth; ++column) {
    const std::size_t row = kHeight / 2 + below;
    worst = std::max(worst, farthest(glm::dvec3(picture[row * kWidth + column]), kMean));
  }
  return worst;
}

// The row `below` the horizon meets the floor at kHeight / below, where a pixel is kHeight / below^2 long. Of
// a box w squares long at most half a square more is of one colour than of the other: a share of 1 / (2 w),
// times half of what the colours differ by, 1.
double unevenness(int below) {
  const double squares = kHeight / (below * below * kSide);
  return 0.25 / squares + 0x1p-10;  // the wave's integral is taken of positions as floats
}

TEST(Filter, AFloorTurnsIntoItsMeanColorTowardsTheHorizon) {
  const auto picture = drawFloor(alongTheFloor(board()));
  for (int below = 1; below <= 3; ++below) {
    EXPECT_LE(worstOfRow(picture, below), unevenness(below)) << below << " below";
  }
}

TEST(Filter, WithoutItRowsNearTheHorizonShowEitherColor) {
  EXPECT_GT(worstOfRow(drawFloor(alongTheFloor(board()), false), 2), 0.49);
}

TEST(Filter, MovesTurnsAndScalesWithItsPattern) {
  const Shape moved = translate(rotate(scale(board(), 0.5), Vec3E(0.0, 0.6, 0.0)), Vec3E(0.3, 0.0, 0.7));
  const auto picture = drawFloor(alongTheFloor(moved));
  for (int below = 1; below <= 3; ++below)
    EXPECT_LE(worstOfRow(picture, below), 2.0 * unevenness(below)) << below << " below";
}

// A mirror behind the floor's near part: what it shows is as far off as the way to it and back.
TEST(Filter, FollowsReflections) {
  Scene scene = alongTheFloor(board());
  scene.add("mirror", plane(Vec3E(0.0, 0.0, 1.0), -2.0).paint({.color = Vec3E(0.0), .reflectivity = 1.0}));
  scene.camera.to = Vec3E(0.3, 1.0, -3.0);
  scene.reflectionBounces = 1;
  const auto picture = drawFloor(scene);
  for (int below = 1; below <= 3; ++below)
    EXPECT_LE(worstOfRow(picture, below), 2.0 * unevenness(below)) << below << " below";
}

// Seen from above, most pixels lie within one square.
TEST(Filter, LeavesNearSquaresSharp) {
  Scene scene = darkScene();
  scene.camera.from = Vec3E(0.01, 2.0, 0.02);
  scene.camera.to = Vec3E(0.01, 0.0, 0.02);
  scene.camera.up = Vec3E(0.0, 0.0, -1.0);
  scene.add("floor", board());
  int mixed = 0;
  for (const glm::vec4& c : drawFloor(scene))
    mixed += std::min(farthest(glm::dvec3(c), kEven), farthest(glm::dvec3(c), kOdd)) > 0x1p-10;
  // A pixel is 2 / kHeight wide, and mixed if a side of a square runs through it, along x or z. Its
  // cone is wider than itself towards the picture's corners, by what is farther there: up to sqrt(2).
  const double crossing = 2.0 / kHeight / kSide, expected = 1.0 - (1.0 - crossing) * (1.0 - crossing);
  EXPECT_LE(mixed, std::numbers::sqrt2 * expected * kWidth * kHeight);
  EXPECT_GT(mixed, 0);
}

}  // namespace filter_test
}  // namespace sdf::test
