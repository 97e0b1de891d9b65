// Pictures through a lens, settled, against the discs that it makes of points out of focus.
#include "sdf/scene/fit.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace lens_test {

constexpr int kSide = 16, kSamples = kSide * kSide;
// n places of a low-discrepancy sequence miss a share by about log(n) / n.
const double kMissed = std::log(kSamples) / kSamples;

std::vector<glm::vec4> draw(const Scene& scene, int samples = kSide) {
  GpuRenderOptions options;
  options.width = kWidth, options.height = kHeight;
  options.samples = samples;
  return renderOnGpu(scene, options);
}

// A plate at z = 0 whose right half shines.
Scene edge() {
  Scene scene = darkScene();
  const Expr right = select(less(0.0, position().x), 1.0, 0.0);
  scene.add("", translate(box(Vec3E(40.0, 40.0, 0.5)), Vec3E(0.0, 0.0, -0.5))
                    .paint({.color = Vec3E(0.0), .emission = Vec3E(right)}));
  return scene;
}

// The share of a disc of radius 1 that lies to the left of x.
double shareOfDisc(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1.0 - x * x) + std::asin(x)) / std::numbers::pi;
}

// At distance z a lens of radius a that is focused at f spreads a point over a disc of radius a |1 - z / f|.
// The camera of the second row of cases is so far away that its rays start before the scene.
TEST(Lens, SpreadsWhatIsOutOfFocusOverADisc) {
  const struct {
    double away, aperture, focus;
  } cases[] = {
      {kAway, 0.3, 3.0}, {kAway, 0.5, 12.0}, {kAway, 0.2, 1.5}, {600.0, 0.4, 300.0}, {600.0, 1.0, 1200.0}};
  for (const auto& c : cases) {
    Scene scene = edge();
    scene.camera.from = Vec3E(0.0, 0.0, c.away);
    scene.camera.fov = 2.0 * std::atan(0.5 * kAway / c.away) * 180.0 / std::numbers::pi;
    scene.camera.aperture = c.aperture;
    scene.camera.focus = Expr(c.focus);
    scene.maxDistance = 2.0 * c.away;
    const double radius = c.aperture * std::abs(1.0 - c.away / c.focus), pixel = kAway / kHeight;
    const auto pixels = draw(scene);
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const double x = onWall(column, row).x, share = shareOfDisc(x / radius);
        // The middle of a pixel stands for its mean, which the curve's bend moves; corners are seen aslant.
        const double bend = pixel * pixel / (radius * radius);
        ASSERT_NEAR(pixels[row * kWidth + column].g, share, 2.0 * kMissed + bend)
            << column << ", " << row << " by " << c.aperture << ", " << c.focus;
      }
  }
}

TEST(Lens, SeesWhatIsInFocusAsAPinholeDoes) {
  const Vec3E p = position();
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.0),
                      .emission = {0.5 + 0.5 * sin(p.x), 0.5 + 0.5 * sin(p.y), 0.5 * sin(p.x + p.y) + 0.5}}));
  const auto sharp = draw(scene, 2);
  scene.camera.aperture = 0.4;  // focused on what it looks at
  const auto seen = draw(scene, 2);
  for (std::size_t i = 0; i < sharp.size(); ++i) ASSERT_LE(glm::length(sharp[i] - seen[i]), 1e-4f);
  scene.camera.focus = Expr(3.0);
  EXPECT_LT(psnr(colors(draw(scene, 2)), colors(sharp)), 40.0);
}

TEST(Lens, OfRadiusZeroIsAPinhole) {
  Scene scene = edge();
  const auto sharp = draw(scene, 2);
  scene.camera.aperture = scene.parameter("a", 0.0);
  EXPECT_GE(psnr(colors(draw(scene, 2)), colors(sharp)), 60.0);
}

TEST(Lens, IsTheCpus) {
  Scene scene = darkScene();
  scene.camera.from = Vec3E(3.0, 2.0, 5.0);
  scene.camera.aperture = 0.3;
  scene.camera.mirrored = true;
  scene.background = {0.5 + 0.5 * position().y, 0.4, 0.6};
  scene.add("", plane(Vec3E(0.0, 1.0, 0.0), -0.6).paint({.color = Vec3E(0.8), .reflectivity = 0.2}));
  scene.add("", ball({0.0, 0.0, 0.0}, 0.6, {.color = Vec3E(0.5), .shininess = 30.0, .reflectivity = 0.3}));
  scene.add("", ball({1.6, 0.0, 1.9}, 0.6, {.color = {0.5, 0.1, 0.7}}));
  scene.lights = {pointLight({-1.0, 3.0, 1.0}, {0.5, 0.4, 0.3})};
  scene.shadow.kind = Shadow::Kind::Soft;
  scene.glossyReflections = true;
  GpuRenderOptions options;
  options.samples = 3;
  options.threshold = 0.0;
  for (const double radius : {0.0, 0.6}) {
    scene.lights[0].radius = radius;
    const auto onCpu = encode(renderOnCpu(scene, {.samples = 3}).color, scene.gamma);
    EXPECT_GE(psnr(colors(renderOnGpu(scene, options)), onCpu), 40.0);
  }
}

// What the lens, the lights and a mirror choose does not hang together: a picture of 256 samples is that of
// as many by chance, of which 64 times as many are drawn.
TEST(Lens, ChoosesWithoutRegardToLightsAndMirrors) {
  Scene scene = darkScene();
  scene.camera.from = Vec3E(2.0, 1.5, 3.0);
  scene.camera.aperture = 0.2;
  scene.camera.focus = Expr(2.0);
  scene.background = Vec3E(0.3);
  scene.add(
      "",
      plane(Vec3E(0.0, 1.0, 0.0), -0.6).paint({.color = Vec3E(0.6), .shininess = 10.0, .reflectivity = 0.4}));
  scene.add("", ball({0.0, 0.0, 0.0}, 0.6, {.color = {0.9, 0.3, 0.2}}));
  scene.lights = {pointLight({-1.0, 2.0, 1.0}, {0.9, 0.8, 0.7})};
  scene.lights[0].radius = 0.7;
  scene.shadow.kind = Shadow::Kind::Hard;
  scene.glossyReflections = true;
  GpuRenderOptions options;
  options.width = 40, options.height = 24;
  options.samples = kSide;
  const auto settled = colors(renderOnGpu(scene, options));
  options.samples = 8 * kSide;
  const auto truth = colors(renderOnGpu(scene, options));
  EXPECT_GE(psnr(settled, truth), 45.0);
  options.samples = 2;
  EXPECT_LT(psnr(colors(renderOnGpu(scene, options)), truth), 40.0) << "or few samples would do";
}

TEST(Lens, IsInNoShaderThatHasNone) {
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, 0.0}, 0.6, {}));
  const auto text = [&](viewer::View view) {
    return viewer::assemble(scene, {.view = view}).value().picture.text;
  };
  EXPECT_EQ(text(viewer::View::Picture).find("aperture"), std::string::npos);
  scene.camera.aperture = 1.0;
  EXPECT_NE(text(viewer::View::Picture).find("aperture"), std::string::npos);
  EXPECT_EQ(text(viewer::View::Normals).find("aperture"), std::string::npos)
      << "they are looked at one by one";
}

TEST(Lens, IsInTheCamerasText) {
  viewer::Eye eye;
  EXPECT_EQ(viewer::textOf(eye).find("aperture"), std::string::npos);
  eye.aperture = 0.125;
  EXPECT_TRUE(viewer::textOf(eye).ends_with(", fov = 45, aperture = 0.125 }")) << viewer::textOf(eye);
  eye.focus = 3.0;
  EXPECT_TRUE(viewer::textOf(eye).ends_with(", aperture = 0.125, focus = 3 }")) << viewer::textOf(eye);
  eye = viewer::fitted(eye, Box::centred(glm::dvec3(1.0)), 1.0);
  EXPECT_EQ(eye.aperture, 0.125);
  EXPECT_FALSE(eye.focus) << "it looks at the box";
}

}  // namespace lens_test
}  // namespace sdf::test
