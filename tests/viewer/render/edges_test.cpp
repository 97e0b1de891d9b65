// Edges seen sharply: beside them nothing is hit, and no pixel shows a side that is turned away.
#include "sdf/shape/operators/booleans.h"
#include "viewer/reference/cpu_camera.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace edges_test {

const glm::dvec3 kSky(0.1, 0.2, 0.1);

// Every surface shows its normal.
Scene shownByNormals(const Shape& shape, const glm::dvec3& from) {
  Scene scene = darkScene();
  const Vec3E n = normal();
  const Material material{.color = Vec3E(0.0),
                          .emission = {0.5 + 0.5 * n.x, 0.5 + 0.5 * n.y, 0.5 + 0.5 * n.z}};
  scene.add("", Shape(shape).paint(material));
  scene.background = Vec3E(kSky);
  scene.camera.from = Vec3E(from);
  return scene;
}

// The cube of half side 1, whose pocket of half side 0.4 and depth 0.8 opens in the face y = 1.
constexpr double kPocket = 0.4, kDepth = 0.8;
Shape cubeWithPocket() {
  return subtract(box(Vec3E(1.0, 1.0, 1.0)),
                  translate(box(Vec3E(kPocket, kPocket, kPocket)), Vec3E(0.0, 0.6, 0.0)));
}

// The sides of the cube and of the pocket that rays meet, by slabs.
std::optional<glm::dvec3> normalMet(const glm::dvec3& from, const glm::dvec3& d) {
  double enter = -HUGE_VAL, leave = HUGE_VAL;
  int side = 0;
  for (int i = 0; i < 3; ++i) {
    const double near = (-std::copysign(1.0, d[i]) - from[i]) / d[i],
                 far = (std::copysign(1.0, d[i]) - from[i]) / d[i];
    if (near > enter) enter = near, side = i;
    leave = std::min(leave, far);
  }
  if (enter > leave) return {};
  glm::dvec3 n(0.0);
  n[side] = -std::copysign(1.0, d[side]);
  const glm::dvec3 p = from + enter * d;
  if (n.y <= 0.0 || std::max(std::abs(p.x), std::abs(p.z)) >= kPocket) return n;
  const double toSide[] = {(std::copysign(kPocket, d.x) - p.x) / d.x, -kDepth / d.y,
                           (std::copysign(kPocket, d.z) - p.z) / d.z};
  side = static_cast<int>(std::min_element(toSide, toSide + 3) - toSide);
  n = glm::dvec3(0.0);
  n[side] = -std::copysign(1.0, d[side]);
  return n;
}

glm::dvec3 colorMet(const glm::dvec3& from, const glm::dvec3& d) {
  const auto n = normalMet(from, d);
  return n ? 0.5 + 0.5 * *n : kSky;
}

class Edges : public testing::TestWithParam<Renderer> {};
INSTANTIATE_TEST_SUITE_P(Of, Edges, testing::ValuesIn(renderers()),
                         [](const auto& renderer) { return renderer.param.name; });

// Rays look behind a film by up to eight times an eighth of a pixel, so a wall that begins there may show as
// the film: at the least angle here, a sine of a twelfth, that is within a tenth of a pixel of the edge.
TEST_P(Edges, EachPixelShowsTheSideThatItsRayMeets) {
  constexpr double kUnclear = 1.0 / 6.0;  // pixels
  for (const glm::dvec3 from :
       {glm::dvec3(2.4, 3.2, 3.6), glm::dvec3(3.0, 1.8, 4.0), glm::dvec3(-4.0, 3.5, 0.7)}) {
    const Scene scene = shownByNormals(cubeWithPocket(), from);
    const Picture picture = GetParam().render(scene, kWidth, kHeight);
    const Pinhole camera(scene.camera, kWidth, kHeight);
    int clear = 0, apart = 0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const auto met = [&](double x, double y) {
          return colorMet(from, camera.through(column + 0.5 + x, row + 0.5 + y));
        };
        const glm::dvec3 c = met(0.0, 0.0);
        if (met(kUnclear, kUnclear) != c || met(-kUnclear, kUnclear) != c || met(kUnclear, -kUnclear) != c ||
            met(-kUnclear, -kUnclear) != c)
          continue;
        ++clear;
        apart += farthest(picture.color[picture.at(column, row)], c) > GetParam().rounding;
      }
    EXPECT_GT(clear, kWidth * kHeight * 8 / 10);
    EXPECT_EQ(apart, 0) << from.x;
  }
}

}  // namespace edges_test
}  // namespace sdf::test
