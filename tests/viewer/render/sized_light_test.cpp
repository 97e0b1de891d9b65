// Shadows of lights that have a size, settled, against the share of the light that geometry says is seen.
#include <glm/trigonometric.hpp>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace sized_light_test {

constexpr int kSide = 16, kSamples = kSide * kSide;

// How far a share may be off: n places of a low-discrepancy sequence miss it by about log(n) / n.
const double kMissed = std::log(kSamples) / kSamples;

std::vector<glm::vec4> draw(const Scene& scene, int samples = kSide) {
  GpuRenderOptions options;
  options.width = kWidth, options.height = kHeight;
  options.samples = samples;
  return renderOnGpu(scene, options);
}

const glm::vec4& at(const std::vector<glm::vec4>& pixels, int column, int row) {
  return pixels[static_cast<std::size_t>(row) * kWidth + column];
}

// Of the directions within an angle of an axis, the share whose tangent along one side is above a limit: ring
// by ring.
double shareBeyond(double limit, double angle) {
  constexpr int kRings = 10'000;
  double sum = 0.0, all = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double ring = angle * (i + 0.5) / kRings, weight = std::sin(ring);
    const double least = std::clamp(limit / std::tan(ring), -1.0, 1.0);
    sum += weight * std::acos(least) / std::numbers::pi;
    all += weight;
  }
  return sum / all;
}

// Under a thin plate at height 1 that ends at x = -2 stands a penumbra as wide as the light's tangent says.
TEST(SizedLight, FarAwayFadesThePenumbraOfAnEdgeAsItIsSeen) {
  const double degrees = 12.0, angle = glm::radians(degrees), edge = -2.0, thin = 1e-3;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add(
      "", translate(box(Vec3E(20.0, 40.0, thin)), Vec3E(edge - 20.0, 0.0, 1.0)).paint({.color = Vec3E(0.0)}));
  scene.lights = {sunTowards({0.0, 0.0, 1.0})};
  scene.lights[0].radius = degrees;
  scene.shadow = {.kind = Shadow::Kind::Soft, .reach = 10.0};
  const auto pixels = draw(scene);
  // Over a pixel, and by how far off edges are hit, the share moves by less than this.
  const double pixel = kAway / kHeight, slack = kMissed + 1e-2;
  int between = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const double x = onWall(column, row).x;
      if (x < edge * kAway / (kAway - 1.0) + pixel) continue;  // behind the plate
      const double share = shareBeyond(edge - x, angle);
      between += share > 0.1 && share < 0.9;
      ASSERT_NEAR(at(pixels, column, row).g, share, slack) << column << ", " << row;
    }
  EXPECT_GT(between, 3 * kHeight);
}

// A ball between a point of the wall and a larger one that shines covers a disc of its disc.
TEST(SizedLight, ABallIsCoveredByTheShareOfItsSolidAngle) {
  const double light = 0.8, high = 4.0, low = 1.0;
  Scene scene = darkScene();
  scene.camera.from = Vec3E(5.0, 0.0, 3.0);
  scene.camera.fov = 0.1;  // all pixels see one point
  scene.lights = {pointLight({0.0, 0.0, high}, glm::dvec3(1.0))};
  scene.lights[0].radius = light;
  scene.shadow.kind = Shadow::Kind::Improved;
  const auto away = [](double sine) { return 1.0 - std::sqrt(1.0 - sine * sine); };
  for (const double radius : {0.05, 0.1, 0.15, 0.25}) {
    scene.parts.clear();
    scene.add("", wall({.color = Vec3E(1.0)}));
    scene.add("", ball({0.0, 0.0, low}, radius, {}));
    const double seen = std::max(0.0, 1.0 - away(radius / low) / away(light / high));
    for (const glm::vec4& pixel : draw(scene)) ASSERT_NEAR(pixel.g, seen, kMissed + 1e-2) << radius;
  }
}

TEST(SizedLight, IsNotShadedByWhatIsInItsBall) {
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", ball({0.0, 0.0, 3.0}, 0.3, {.color = Vec3E(0.0)}));
  scene.camera.from = Vec3E(5.0, 0.0, 3.0);
  scene.camera.fov = 0.1;
  scene.lights = {pointLight({0.0, 0.0, 3.0}, glm::dvec3(1.0))};
  scene.shadow.kind = Shadow::Kind::Hard;
  for (const glm::vec4& pixel : draw(scene, 4)) ASSERT_EQ(pixel.g, 0.0f);
  scene.lights[0].radius = 0.35;
  for (const glm::vec4& pixel : draw(scene, 4)) ASSERT_NEAR(pixel.g, 1.0, 1e-3);
}

// Where nothing is in the way a size changes nothing, and where everything is, neither; a radius of 0 is
// none.
TEST(SizedLight, ChangesPenumbraeAlone) {
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.7), .specular = Vec3E(0.2)}));
  scene.add("", ball({0.0, 0.0, 1.0}, 0.8, {}));
  scene.lights = {pointLight({1.0, 0.5, 4.0}, {0.2, 0.5, 1.0}), sunTowards({0.1, 0.2, 1.0})};
  scene.lights[0].intensity = scene.lights[1].intensity = 0.4;
  for (const Shadow::Kind kind : {Shadow::Kind::None, Shadow::Kind::Hard}) {
    scene.shadow.kind = kind;
    scene.lights[0].radius = scene.lights[1].radius = 0.0;
    const auto points = draw(scene, 2);
    scene.lights[0].radius = 0.1, scene.lights[1].radius = 1.0;
    const auto sized = draw(scene, 2);
    int same = 0;
    for (std::size_t i = 0; i < points.size(); ++i) same += glm::length(points[i] - sized[i]) < 1e-5f;
    if (kind == Shadow::Kind::None)
      EXPECT_EQ(same, kWidth * kHeight);
    else
      EXPECT_GT(same, 0.9 * kWidth * kHeight);
  }
  scene.shadow.kind = Shadow::Kind::Soft;
  scene.lights[1].radius = scene.lights[0].radius = scene.parameter("r", 0.0);
  const auto none = draw(scene, 2);
  scene.lights[1].radius = scene.lights[0].radius = 0.0;
  EXPECT_EQ(none, draw(scene, 2));
}

// One light that has a size and one that has none: as if each were alone.
TEST(SizedLight, StandsBesideOneWithoutASize) {
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.7)}));
  scene.add("", ball({0.0, 0.0, 1.0}, 0.8, {}));
  Light sized = pointLight({1.0, 0.5, 4.0}, {0.2, 0.5, 0.3}), point = sunTowards({-0.4, 0.2, 1.0});
  sized.radius = 0.5;
  point.intensity = 0.4;
  for (const Shadow::Kind kind :
       {Shadow::Kind::Hard, Shadow::Kind::Soft, Shadow::Kind::Improved, Shadow::Kind::Signed}) {
    scene.shadow.kind = kind;
    scene.lights = {sized, point};
    const auto both = draw(scene, 3);
    scene.lights = {sized};
    const auto first = draw(scene, 3);
    scene.lights = {point};
    const auto second = draw(scene, 3);
    for (std::size_t i = 0; i < both.size(); ++i)
      ASSERT_LE(glm::length(glm::vec3(both[i] - first[i] - second[i])), 1e-5f);
  }
}

TEST(SizedLight, IsInTheViewOfShadows) {
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(1.0)}));
  scene.add("", ball({0.0, 0.0, 1.0}, 0.8, {}));
  scene.lights = {sunTowards({0.0, 0.4, 1.0})};
  scene.lights[0].radius = 10.0;
  scene.lights[0].color = Vec3E(1.0 / glm::normalize(glm::dvec3(0.0, 0.4, 1.0)).z);  // the wall is white
  scene.shadow.kind = Shadow::Kind::Soft;
  GpuRenderOptions options;
  options.width = kWidth, options.height = kHeight, options.samples = 4;
  options.shader.view = viewer::View::Shadow;
  const auto shown = renderOnGpu(scene, options), lit = draw(scene, 4);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      if (approach(kEye, rayThrough(column, row), {0.0, 0.0, 1.0}) < 0.9) continue;
      ASSERT_NEAR(at(shown, column, row).g, at(lit, column, row).g, 1e-5);
    }
}

// Sample by sample: edges aside both draw the same.
TEST(SizedLight, IsTheCpus) {
  Scene scene = darkScene();
  scene.camera.from = Vec3E(3.0, 2.0, 5.0);
  scene.add("", plane(Vec3E(0.0, 1.0, 0.0), -0.6).paint({.color = Vec3E(0.8), .reflectivity = 0.2}));
  scene.add("", ball({0.0, 0.0, 0.0}, 0.6, {.color = Vec3E(0.5), .shininess = 30.0, .reflectivity = 0.3}));
  scene.lights = {pointLight({-1.0, 3.0, 1.0}, {0.5, 0.4, 0.3}), sunTowards({2.0, 1.5, 1.0})};
  scene.lights[0].radius = 0.5, scene.lights[1].radius = 4.0;
  scene.lights[1].intensity = 0.4;
  scene.shadow.kind = Shadow::Kind::Soft;
  for (const bool glossy : {false, true}) {
    scene.glossyReflections = glossy;
    GpuRenderOptions options;
    options.samples = 3;
    options.threshold = 0.0;
    const auto onCpu = encode(renderOnCpu(scene, {.samples = 3}).color, scene.gamma);
    EXPECT_GE(psnr(colors(renderOnGpu(scene, options)), onCpu), 40.0);
  }
}

TEST(SizedLight, IsInNoShaderThatHasNone) {
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, 0.0}, 0.6, {}));
  scene.lights = {sunTowards({0.0, 0.0, 1.0}), sunTowards({1.0, 0.0, 1.0})};
  scene.shadow.kind = Shadow::Kind::Soft;
  const auto text = [&] { return viewer::assemble(scene, {}).value().picture.text; };
  EXPECT_EQ(text().find("lightSize"), std::string::npos);
  scene.lights[0].radius = 1.0;
  EXPECT_NE(text().find("lightSize"), std::string::npos);
  EXPECT_NE(text().find("sharpness *"), std::string::npos) << "the other's";
  scene.lights[1].radius = 1.0;
  EXPECT_EQ(text().find("sharpness *"), std::string::npos);
}

}  // namespace sized_light_test
}  // namespace sdf::test
