// Light goes by how far things are, not by how far a ray may go.
#include <gtest/gtest.h>

#include <numbers>

#include "sdf/scene/patterns.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "viewer/reference/cpu_render.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace light_test {

constexpr double kAlike = 45.0;  // dB; what is seen at the edges of shadows that other steps lead to

// A box and a shape on a plate, under a low sun.
Scene besideABox(const Shape& shape) {
  Scene scene;
  scene.camera.from = Vec3E(3.0, 3.0, 5.0);
  scene.ambient = Vec3E(0.3);
  scene.lights = {sunTowards({1.0, 2.0, 1.5})};
  scene.shadow.kind = Shadow::Kind::Soft;
  scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
  scene.add("plate", translate(box(Vec3E(3.0, 0.1, 3.0)), Vec3E(0.0, -0.8, 0.0)));
  scene.add("box", translate(box(Vec3E(0.6)), Vec3E(-0.9, -0.1, 0.0)));
  scene.add("shape", shape);
  return scene;
}

std::vector<glm::dvec3> draw(const Scene& scene) {
  GpuRenderOptions options;
  options.width = 320;
  options.height = 180;
  options.samples = 2;
  return colors(renderOnGpu(scene, options));
}

const Box kAround{{0.1, -0.8, -0.8}, {1.7, 0.8, 0.8}};

// A ball by a formula whose slope nothing is known of.
Shape ballOfSlope(double slope, const Box& bounds) {
  const Vec3E p = position();
  return field(sqrt((p.x - 0.9) * (p.x - 0.9) + p.y * p.y + p.z * p.z) - 0.6, bounds, slope);
}

TEST(Light, DoesNotDependOnHowTightAStatedSlopeIs) {
  for (const Box& bounds : {kAround, Box::everything()}) {
    const auto tight = draw(besideABox(ballOfSlope(1.0, bounds)));
    EXPECT_GE(psnr(tight, draw(besideABox(ballOfSlope(3.0, bounds)))), kAlike);
    EXPECT_GE(psnr(tight, draw(besideABox(ballOfSlope(10.0, bounds)))), kAlike);
    const auto exact = draw(besideABox(translate(sphere(0.6), Vec3E(0.9, 0.0, 0.0))));
    EXPECT_GE(psnr(tight, exact), kAlike) << "what is known to be the distance";
  }
}

// The edges of parts and shadows aside, of which less than one pixel in a thousand may go the other way, by
// less than a third in the root mean square: 40 dB.
TEST(Light, IsTheCpusWhereSlopesDiffer) {
  const Scene scene = besideABox(ballOfSlope(10.0, kAround));
  GpuRenderOptions options;
  options.threshold = 0.0;
  const auto onGpu = colors(renderOnGpu(scene, options));
  EXPECT_GE(psnr(onGpu, encode(renderOnCpu(scene, {}).color, scene.gamma)), 40.0);
}

// What a steep part costs stays with it: rays that pass it take long steps, up to its bounds.
TEST(Light, OfALooseSlopeCostsLittleMoreReadings) {
  const auto readings = [](double slope) {
    return readingsOnGpu(besideABox(ballOfSlope(slope, kAround)), {});
  };
  const viewer::Readings tight = readings(1.0), loose = readings(10.0);
  EXPECT_LE(loose.primary, 2.5 * tight.primary);
  EXPECT_LE(loose.shadow, 2.5 * tight.shadow);
  // Where the slope is 1 the farthest tap may tell of all others.
  EXPECT_LE(loose.occlusion, AmbientOcclusion{}.count * tight.occlusion);
}

TEST(Light, DoesNotDependOnWhetherASlopeIsStatedOrDerived) {
  const Vec3E p = position();
  const double third = std::numbers::inv_sqrt3;
  const Expr octahedron = third * (abs(p.x - 0.9) + abs(p.y) + abs(p.z) - 0.8);
  // A polynomial within its bounds, of slope 1.2 there at most: how steep it is follows near the bounds only.
  const Expr bowl = 0.6 * ((p.x - 0.9) * (p.x - 0.9) + p.y * p.y + p.z * p.z - 0.5);
  const auto derived = draw(besideABox(field(octahedron, kAround)));
  EXPECT_GE(psnr(derived, draw(besideABox(field(octahedron, kAround, 1.0)))), kAlike);
  const auto near = draw(besideABox(field(bowl, kAround)));
  EXPECT_GE(psnr(near, draw(besideABox(field(bowl, kAround, 2.4)))), kAlike);
}

// The light that arrives at pixels of a plate under a light that grazes it, past a ball.
TEST(Light, IsDarkWhereAShadowRunsOutOfSteps) {
  for (const auto kind :
       {Shadow::Kind::Hard, Shadow::Kind::Soft, Shadow::Kind::Improved, Shadow::Kind::Signed}) {
    Scene scene = darkScene();
    scene.add("", box(Vec3E(2.0, 2.0, 0.1)));
    scene.add("", ball({0.0, 0.0, 0.6}, 0.4, {}));
    scene.lights = {sunTowards({1.0, 0.0, 0.1})};
    scene.shadow.kind = kind;
    const auto pixels = [&](int steps, int samples) {
      scene.shadow.steps = steps;
      GpuRenderOptions options;
      options.shader.view = viewer::View::Shadow;
      options.samples = samples;
      return renderOnGpu(scene, options);
    };
    for (const int samples : {1, 3}) {
      const auto few = pixels(3, samples), enough = pixels(Shadow{}.steps, samples);
      int spent = 0, lit = 0;
      for (std::size_t i = 0; i < few.size(); ++i) {
        const bool isSpent = few[i].a != 1.0f;
        EXPECT_EQ(enough[i].a, 1.0f);
        EXPECT_EQ(few[i].a, isSpent ? 0.5f : 1.0f);
        // Of one sample nothing arrives, of several those that are not spent show what they show.
        const float most = isSpent && samples == 1 ? 0.0f : enough[i].r;
        EXPECT_LE(few[i].r, most + 1e-3f);
        if (!isSpent) {
          EXPECT_NEAR(few[i].r, enough[i].r, 1e-3f);
        }
        spent += isSpent;
        lit += isSpent && enough[i].r > 0.5f;
      }
      EXPECT_GT(spent, 100) << static_cast<int>(kind);
      EXPECT_GT(lit, 10) << static_cast<int>(kind) << ": more steps would have shown light";
    }
  }
}

Sky skyWithSunAt(const Expr& height) {
  Sky sky;
  sky.ground = Vec3E(0.2, 0.1, 0.05);
  sky.sun = {1.0, height, 0.5};
  sky.sunSize = 4.0;  // large enough to light the scene
  return sky;
}

// A ball on a floor under a sky, whose sun's height is a parameter.
Scene underASky() {
  Scene scene;
  scene.camera.from = Vec3E(3.0, 2.0, 4.0);
  scene.ambient = Vec3E(0.05, 0.0, 0.0);
  scene.background = skyColor(skyWithSunAt(scene.parameter("height", 1.0, -1.0, 1.0)));
  scene.backgroundLight = 0.8;
  scene.ambientOcclusion.kind = AmbientOcclusion::Kind::Taps;
  scene.add("floor", plane(Vec3E(0.0, 1.0, 0.0), -0.5).paint({.color = Vec3E(0.6), .reflectivity = 0.2}));
  scene.add("ball", ball({0.0, 0.1, 0.0}, 0.6, {.color = {0.8, 0.7, 0.6}}));
  return scene;
}

TEST(Light, OfTheBackgroundIsTheCpus) {
  Scene scene = underASky();
  GpuRenderOptions options;
  options.threshold = 0.0;
  const auto onGpu = colors(renderOnGpu(scene, options));
  EXPECT_GE(psnr(onGpu, encode(renderOnCpu(scene, {}).color, scene.gamma)), 40.0);
  scene.backgroundLight = 0.0;
  EXPECT_LT(psnr(onGpu, colors(renderOnGpu(scene, options))), 20.0);
  EXPECT_EQ(viewer::assemble(scene, {}).value().picture.text.find("backgroundLight"), std::string::npos);
}

TEST(Light, OfTheBackgroundFollowsItsParameters) {
  const Scene scene = underASky();
  GpuRenderOptions options;
  options.parameters["height"] = -0.5;
  const auto moved = renderOnGpu(scene, options);
  const auto before = renderOnGpu(scene, {});
  Scene low = underASky();
  low.background = skyColor(skyWithSunAt(-0.5));
  EXPECT_GE(psnr(colors(moved), colors(renderOnGpu(low, {}))), 60.0);
  EXPECT_LT(psnr(colors(moved), colors(before)), 40.0);
}

// One colour all around is ambient light of that colour.
TEST(Light, OfAGreyBackgroundIsAmbientLight) {
  Scene scene = underASky();
  scene.ambient = Vec3E(0.0);
  scene.background = {0.3, 0.4, 0.5};
  scene.backgroundLight = 1.0;
  const auto around = renderOnGpu(scene, {});
  scene.ambient = {0.3, 0.4, 0.5};
  scene.backgroundLight = 0.0;
  EXPECT_GE(psnr(colors(around), colors(renderOnGpu(scene, {}))), 80.0);
}

// The mean of the samples is bent, not each of them: half of a pixel at 4 is 2.
TEST(Tone, BendsTheMeanOfLinearColours) {
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, -1000.0}, 1e-3, {}));
  const Expr x = position().x;
  scene.background = Vec3E(0.18);
  GpuRenderOptions options;
  options.width = 3;  // the middle pixel lies on both sides of x = 0
  options.height = 1;
  for (const auto gamma : {std::optional(1.0), std::optional(2.2), std::optional<double>()})
    for (const int samples : {1, 2}) {
      scene.gamma = gamma;
      options.samples = samples;
      scene.tone = Tone::Filmic;
      scene.background.y = samples == 1 ? Expr(2.0) : select(less(x, 0.0), 0.0, 4.0);
      const glm::dvec3 shown(renderOnGpu(scene, options)[1]);
      const glm::dvec3 bent = encode(toned(glm::dvec3(2.0, 2.0, 0.18), Tone::Filmic), gamma);
      EXPECT_NEAR(shown.y, bent.y, 1e-5);
      EXPECT_NEAR(shown.z, bent.z, 1e-5);
      scene.tone = Tone::Linear;
      EXPECT_NEAR(glm::min(renderOnGpu(scene, options)[1].y, 1.0f), 1.0, 1e-5) << "cut off";
    }
}

// By hand: Narkowicz's fraction.
TEST(Tone, FollowsItsFormula) {
  EXPECT_EQ(toned(glm::dvec3(-1.0, 0.0, 0.0), Tone::Filmic), glm::dvec3(0.0));
  EXPECT_NEAR(toned(glm::dvec3(1.0), Tone::Filmic).x, 2.54 / 3.16, 1e-15);
  EXPECT_EQ(toned(glm::dvec3(100.0), Tone::Filmic).x, 1.0);
  EXPECT_EQ(toned(glm::dvec3(-1.0, 0.5, 3.0), Tone::Linear), glm::dvec3(-1.0, 0.5, 3.0));
}

TEST(Tone, IsOfThePictureAlone) {
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, 0.0}, 1.0, {.color = Vec3E(0.5)}));
  const auto text = [&](viewer::View view) { return viewer::assemble(scene, {.view = view}).value(); };
  EXPECT_EQ(text(viewer::View::Picture).picture.text.find("filmic"), std::string::npos);
  scene.tone = Tone::Filmic;
  EXPECT_NE(text(viewer::View::Picture).picture.text.find("filmic"), std::string::npos);
  EXPECT_NE(text(viewer::View::Picture).background->text.find("filmic"), std::string::npos);
  EXPECT_EQ(text(viewer::View::Material).picture.text.find("filmic"), std::string::npos);
}

// A grey that lies between two bytes is the mix of both that comes nearest to it in every 8 by 8 pixels; one
// that is a byte's own is that byte throughout.
TEST(Dither, KeepsTheMeanOfWhatBytesCannotHold) {
  constexpr double kStep = 1.0 / 255.0;
  Scene scene = darkScene();
  scene.add("", ball({0.0, 0.0, -1000.0}, 1e-3, {}));
  for (const double grey : {100.0, 100.3, 100.5, 100.9}) {
    scene.background = Vec3E(grey * kStep);
    for (const int samples : {1, 2}) {
      GpuRenderOptions options;
      options.samples = samples;
      options.format = viewer::PixelFormat::Rgba8;
      const auto bytes = renderOnGpu(scene, options);
      for (int row = 0; row + 8 <= options.height; row += 8)
        for (int column = 0; column + 8 <= options.width; column += 8) {
          double sum = 0.0;
          for (int i = 0; i < 64; ++i) {
            const double shown = bytes[(row + i / 8) * options.width + column + i % 8].g / kStep;
            ASSERT_LT(std::abs(shown - grey), grey == 100.0 ? 1e-3 : 1.0);
            sum += shown / 64.0;
          }
          ASSERT_NEAR(sum, grey, 1.0 / 64.0) << samples;
        }
      EXPECT_EQ(bytes, renderOnGpu(scene, options));
      options.format = viewer::PixelFormat::Rgba32f;
      for (const glm::vec4& pixel : renderOnGpu(scene, options))
        ASSERT_NEAR(pixel.g, grey * kStep, 1e-6) << "not dithered";
    }
  }
}

}  // namespace light_test
}  // namespace sdf::test
