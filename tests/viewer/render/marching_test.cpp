// Rays where marching is hard: along surfaces, past thin things, and far from the origin.
#include <algorithm>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "sdf/eval/function.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/pattern.h"
#include "sdf/shape/operators/place.h"
#include "viewer/reference/cpu_uniform.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace marching_test {

using viewer::Method;
using viewer::View;

constexpr Method kMethods[] = {Method::AutoRelaxed, Method::Plain};
const glm::dvec3 kPaint(1.0, 0.5, 0.0);  // nothing else has this colour

Material painted() { return {.color = Vec3E(kPaint)}; }

GpuRenderOptions materials(Method method, int width = 320, int height = 180) {
  GpuRenderOptions options;
  options.width = width;
  options.height = height;
  options.shader.view = View::Material;
  options.shader.method = method;
  // At an angle of a, a plain step leaves 1 - sin(a) of the distance.
  if (method == Method::Plain) options.maxSteps = 5000;
  return options;
}

bool isHit(const glm::vec4& pixel) { return farthest(glm::dvec3(pixel), kPaint) < 0x1p-10; }

// A unit above the ground, looking one degree down, so that the horizon lies above the picture's middle.
Scene overTheGround(Shape ground) {
  Scene scene = darkScene();
  const double down = glm::radians(1.0);
  scene.add("", std::move(ground).paint(painted()));
  scene.camera.from = Vec3E(0.0, 1.0, 0.0);
  scene.camera.to = Vec3E(0.0, 1.0 - std::sin(down), -std::cos(down));
  scene.maxDistance = 1000.0;
  return scene;
}

class Grazing : public testing::TestWithParam<Method> {
 protected:
  // Counts the pixels whose rays meet the ground within reach and show sky, and those that ran out of steps.
  static void expectNoHoles(const Scene& scene, double reach, const GpuRenderOptions& options) {
    const auto picture = renderOnGpu(scene, options);
    const glm::dvec3 from = uniform(scene.camera.eye()), forward = uniform(scene.camera.to) - from;
    const glm::dvec3 right(1.0, 0.0, 0.0), up = glm::cross(right, forward);
    int onGround = 0, holes = 0, spent = 0;
    for (int row = 0; row < options.height; ++row)
      for (int column = 0; column < options.width; ++column) {
        const double u = (column + 0.5 - 0.5 * options.width) / options.height;
        const double v = (0.5 * options.height - row - 0.5) / options.height;
        const glm::dvec3 d = glm::normalize(u * right + v * up + forward);
        if (d.y >= 0.0 || 1.0 / -d.y > reach) continue;
        const glm::vec4 pixel = picture[static_cast<std::size_t>(row) * options.width + column];
        ++onGround;
        holes += !isHit(pixel);
        spent += pixel.a == 0.0f;
      }
    EXPECT_GT(onGround, options.width * options.height / 3);
    EXPECT_EQ(holes, 0);
    EXPECT_EQ(spent, 0);
  }
};

TEST_P(Grazing, APlaneHasNoHolesUpToTheHorizon) {
  expectNoHoles(overTheGround(plane(Vec3E(0.0, 1.0, 0.0), 0.0)), 999.0, materials(GetParam()));
}

// The same ground as the top of a box, which rays have to march to.
TEST_P(Grazing, ABoxHasNoHolesUpToItsEdge) {
  expectNoHoles(overTheGround(translate(box(Vec3E(2000.0, 1.0, 2000.0)), Vec3E(0.0, -1.0, 0.0))), 999.0,
                materials(GetParam()));
}

// Thinner than a hundredth of a pixel, so nothing but the plate's own distance can stop a ray.
TEST_P(Grazing, AThinPlateHasNoHolesAtAnyAngle) {
  for (const double degrees : {0.0, 45.0, 80.0, 89.0}) {
    const double angle = glm::radians(degrees);
    Scene scene = darkScene();
    scene.add("", rotate(box(Vec3E(1.0, 1.0, 1e-4)), Vec3E(0.0, angle, 0.0)).paint(painted()));
    const auto options = materials(GetParam(), kWidth, kHeight);
    const auto picture = renderOnGpu(scene, options);
    int inside = 0, holes = 0;
    const glm::dvec3 across(std::cos(angle), 0.0, -std::sin(angle)), n(std::sin(angle), 0.0, std::cos(angle));
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const glm::dvec3 d = rayThrough(column, row), q = kEye - glm::dot(kEye, n) / glm::dot(d, n) * d;
        if (std::abs(glm::dot(q, across)) > 0.99 || std::abs(q.y) > 0.99) continue;
        ++inside;
        holes += !isHit(picture[static_cast<std::size_t>(row) * kWidth + column]);
      }
    EXPECT_GT(inside, 0) << degrees;
    EXPECT_EQ(holes, 0) << degrees << " degrees";
  }
}

// Near its bounds |p|^2 - 1 is at most some eight times as steep as a distance, but steeper the farther away.
TEST_P(Grazing, ABallOfUnknownSlopeIsNotPassedFromAnyDistance) {
  const Vec3E p = position();
  for (const double away : {2.0, 5.0, 8.8, 40.0}) {
    const auto pictureOf = [&](const Shape& ball) {
      Scene scene = darkScene();
      scene.add("", ball.paint(painted()));
      scene.camera.from = Vec3E(0.0, 0.0, away);
      scene.camera.to = Vec3E(0.0);
      scene.camera.fov = 2.0 * glm::degrees(std::atan(1.5 / away));
      return renderOnGpu(scene, materials(GetParam(), kWidth, kHeight));
    };
    const auto field = pictureOf(sdf::field(dot(p, p) - 1.0, Box{glm::dvec3(-1.1), glm::dvec3(1.1)}));
    const auto exact = pictureOf(sphere(1.0));
    int apart = 0, hits = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      apart += isHit(field[i]) != isHit(exact[i]);
      hits += isHit(exact[i]);
    }
    // A hit is within a quarter of the pixel's cone by f / L, which is up to four times as far: a pixel's
    // rim.
    const double rim = 2.0 * std::sqrt(std::numbers::pi * hits);
    EXPECT_GT(hits, 0);
    EXPECT_LE(apart, rim) << away << " away";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Grazing, testing::ValuesIn(kMethods), [](const auto& info) {
  return info.param == Method::Plain ? "plain" : "autoRelaxed";
});

// A fan of wires, each a third of a pixel across.
Scene wires() {
  Scene scene = darkScene();
  std::vector<Shape> all;
  for (int i = 0; i < 12; ++i)
    all.push_back(rotate(capsule(Vec3E(-2.0, 0.0, 0.0), Vec3E(2.0, 0.0, 0.0), 0.01),
                         Vec3E(0.0, 0.1 * i, 0.26 * i + 0.05)));
  scene.add("", unite(all).paint(painted()));
  return scene;
}

// Tiles start where their whole cone is free: what a plain ray hits from the eye, a ray from its tile's start
// hits, too. Rounding decides whether a ray along a wire's rim hits it, hence the neighbours. A wire is 0.3
// pixels wide, and 110 pixels long or cut off at the picture's edge.
TEST(Cones, SkipNothing) {
  const Scene scene = wires();
  const auto cones = renderOnGpu(scene, materials(Method::AutoRelaxed, kWidth, kHeight));
  const auto plain = renderOnGpu(scene, materials(Method::Plain, kWidth, kHeight));
  const auto near = [&](const std::vector<glm::vec4>& picture, int column, int row) {
    for (int j = std::max(0, row - 1); j <= std::min(kHeight - 1, row + 1); ++j)
      for (int i = std::max(0, column - 1); i <= std::min(kWidth - 1, column + 1); ++i)
        if (isHit(picture[static_cast<std::size_t>(j) * kWidth + i])) return true;
    return false;
  };
  int hits = 0, apart = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * kWidth + column;
      hits += isHit(plain[i]);
      apart += isHit(plain[i]) != isHit(cones[i]);
      EXPECT_TRUE(!isHit(plain[i]) || near(cones, column, row)) << column << ", " << row;
      EXPECT_TRUE(!isHit(cones[i]) || near(plain, column, row)) << column << ", " << row;
    }
  EXPECT_GT(hits, 150);
  EXPECT_LE(apart, hits / 50);
}

Scene threeBalls(const glm::dvec3& where) {
  Scene scene = darkScene();
  scene.ambient = Vec3E(0.2);
  scene.lights = {sunTowards({1.0, 2.0, 1.5})};
  scene.shadow = {.kind = Shadow::Kind::Hard, .steps = 500};
  const glm::dvec3 colors[] = {{0.9, 0.2, 0.1}, {0.2, 0.8, 0.3}, {0.2, 0.3, 0.9}};
  for (int i = 0; i < 3; ++i)
    scene.add("", ball(where + glm::dvec3(1.5 * (i - 1), 0.3 * i, 0.5 * i), 1.0,
                       {.color = Vec3E(colors[i]), .specular = Vec3E(0.5)}));
  return scene;
}

double againstTheCpu(const Scene& scene) {
  GpuRenderOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.threshold = 0.0;
  options.epsilon = 1e-4;
  CpuRenderOptions onCpu;
  onCpu.width = kWidth;
  onCpu.height = kHeight;
  onCpu.march.epsilon = 1e-4;
  return psnr(colors(renderOnGpu(scene, options)), encode(renderOnCpu(scene, onCpu).color, scene.gamma));
}

// The eye sees the balls under the same angle from everywhere. Rays begin beside the scene, so that what
// rounding leaves does not grow with the distance: invisible, but at the edges of balls and shadows, of
// which less than one pixel in ten thousand may go the other way.
TEST(FarAway, AnEyeSeesTheSceneAsWellAsFromNearby) {
  constexpr double kBar = 50.0;
  for (const double away : {1e2, 1e3, 1e4, 1e5}) {
    Scene scene = threeBalls(glm::dvec3(0.0));
    scene.camera.from = Vec3E(away * glm::normalize(glm::dvec3(0.3, 0.4, 1.0)));
    scene.camera.fov = 2.0 * glm::degrees(std::atan(3.0 / away));
    scene.maxDistance = 2.0 * away;
    EXPECT_GE(againstTheCpu(scene), kBar) << away << " away";
  }
}

// Positions are floats: at 10^4 they are rounded to 2^-11, a hundredth of a pixel here, which moves the edges
// by as much: as if a hundredth of the edges' pixels, a twentieth of all, went the other way.
TEST(FarAway, ASceneIsDrawnFarFromTheOrigin) {
  constexpr double kOff = 1e4;
  const double pixel = 7.0 / kHeight, moved = 0x1p-11 / pixel, edges = 0.05;
  Scene scene = threeBalls({kOff, 0.0, -kOff});
  scene.camera.from = Vec3E(kOff, 2.0, 7.0 - kOff);
  scene.camera.to = Vec3E(kOff, 0.0, -kOff);
  EXPECT_GE(againstTheCpu(scene), -10.0 * std::log10(moved * edges));
}

// Far away the sum of exponentials is 0, and the distance infinite.
TEST(FarEnd, IsNotSeenWhereTheDistanceOverflows) {
  const auto far = [](double x) { return length(position() - Vec3E(Expr(x), Expr(0.0), Expr(0.0))) - 1.0; };
  Shape blend = sphere(2.0).paint(painted());
  blend.distance = (-0.1 * log(exp(-10.0 * far(-0.6)) + exp(-10.0 * far(0.6)))).claimLipschitz(1.0);
  blend.claim = {.kind = ClaimKind::Field, .lipschitz = 1.0};
  for (const bool bounded : {false, true}) {
    Scene scene = darkScene();
    blend.bounds = bounded ? Box::centred(glm::dvec3(2.0)) : Box::everything();
    scene.add("", blend);
    const auto hits = [&](Method method) {
      const auto picture = renderOnGpu(scene, materials(method));
      return static_cast<double>(std::count_if(picture.begin(), picture.end(), isHit));
    };
    EXPECT_GT(hits(Method::Plain), 1000.0);
    EXPECT_NEAR(hits(Method::AutoRelaxed), hits(Method::Plain), 0.01 * hits(Method::Plain)) << "edges";
  }
}

// Whether the distance is seen to be negative somewhere along the ray, near the origin.
bool isMet(const Tape& distance, const glm::dvec3& eye, const glm::dvec3& way) {
  constexpr double kReach = 2.5, kStep = 0.005;
  const double middle = glm::length(eye);
  for (double t = std::max(0.0, middle - kReach); t < middle + kReach; t += kStep)
    if (evaluate(distance, eye + t * way) < 0.0) return true;
  return false;
}

// Of every third pixel each way: those whose ray meets the solid, by signs of its distance in double; those
// of which the picture says otherwise; and those that ran out of steps.
struct AgainstSigns {
  int seen = 0, others = 0, spent = 0;
};
AgainstSigns againstSigns(const Shape& shape, const std::vector<glm::vec4>& picture) {
  const TapePtr distance = Function(shape.distance).at();
  AgainstSigns count;
  for (int row = 0; row < kHeight; row += 3)
    for (int column = 0; column < kWidth; column += 3) {
      const glm::vec4& pixel = picture[static_cast<std::size_t>(row) * kWidth + column];
      const bool isSolid = isMet(*distance, kEye, rayThrough(column, row));
      count.seen += isSolid;
      count.others += isSolid != isHit(pixel);
      count.spent += pixel.a == 0.0f;
    }
  return count;
}

Expr heart() {
  const Vec3E p = position();
  const Expr a = p.x * p.x + 2.25 * p.z * p.z + p.y * p.y - 1.0, cube = p.y * p.y * p.y;
  return a * a * a - p.x * p.x * cube - 0.1125 * p.z * p.z * cube;
}

// At y = 0 the heart is the third power of what is 0 at its rim: a hundredth away it is a millionth.
TEST(Steep, AFlatRimIsMetWhereItIs) {
  constexpr double kAway = 4.0, kHigh = 0.25;
  const Box bounds = Box::centred(glm::dvec3(1.4));
  Scene scene = darkScene();
  scene.add("", field(heart(), bounds).paint(painted()));
  scene.camera.from = Vec3E(1.0, 0.0, kAway);
  scene.camera.to = Vec3E(1.0, 0.0, 0.0);
  scene.camera.fov = 2.0 * glm::degrees(std::atan(0.5 * kHigh / kAway));
  const auto picture = renderOnGpu(scene, materials(Method::AutoRelaxed, kWidth, kHeight));
  const TapePtr distance = Function(heart()).at();
  const glm::dvec3 eye(1.0, 0.0, kAway);
  int seen = 0, others = 0;
  for (int row = 0; row < kHeight; row += 2)
    for (int column = 0; column < kWidth; column += 2) {
      const double pixel = kHigh / kHeight;
      const glm::dvec3 at(1.0 + (column + 0.5 - 0.5 * kWidth) * pixel, (0.5 * kHeight - row - 0.5) * pixel,
                          0.0);
      const bool isSolid = isMet(*distance, eye, glm::normalize(at - eye));
      seen += isSolid;
      others += isSolid != isHit(picture[static_cast<std::size_t>(row) * kWidth + column]);
    }
  EXPECT_GT(seen, kWidth * kHeight / 12);
  EXPECT_LE(others, 4);
}

// A hit that is a pixel off lies where the gradient points elsewhere.
TEST(Steep, AFlatRimIsShadedAsWhatIsAroundIt) {
  Scene scene = darkScene();
  scene.add("", field(heart(), Box::centred(glm::dvec3(1.4))).paint(painted()));
  scene.camera.from = Vec3E(0.0, 0.0, 4.0);
  scene.camera.to = Vec3E(0.0);
  scene.camera.fov = 14.0;
  scene.lights = {sunTowards({0.3, 0.2, 1.0})};
  GpuRenderOptions options = materials(Method::AutoRelaxed, kWidth, kHeight);
  options.shader.view = View::Normals;
  const auto normals = renderOnGpu(scene, options);
  options.shader.view = View::Shadow;
  for (const auto kind : {Shadow::Kind::Hard, Shadow::Kind::Soft, Shadow::Kind::Improved}) {
    scene.shadow = {.kind = kind, .steps = 500};
    const auto light = renderOnGpu(scene, options);
    int turned = 0, dark = 0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = kWidth / 4; column < 3 * kWidth / 4; ++column) {  // away from the outline
        const std::size_t i = static_cast<std::size_t>(row) * kWidth + column;
        turned += 2.0 * normals[i].z - 1.0 < 0.5;
        dark += light[i].r < 0.5;
      }
    EXPECT_LE(turned, 2);
    EXPECT_LE(dark, 2) << static_cast<int>(kind);
  }
}

// The sun stands where it shines on most of what is seen.
Scene sunlit(const Shape& shape, Shadow::Kind kind) {
  Scene scene = darkScene();
  scene.add("", Shape(shape).paint(painted()));
  scene.camera.from = Vec3E(1.0, 1.5, 4.0);
  scene.camera.to = Vec3E(0.0);
  scene.camera.fov = 40.0;
  scene.lights = {sunTowards({-0.3, 1.0, 1.0})};
  scene.shadow = {.kind = kind, .steps = 500};
  return scene;
}

// Hits lie outside of the solid, and shadows go by how far it is, not by the formula's value.
TEST(Steep, WhatFacesTheLightIsLit) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.3, 1.0, 1.0));
  const Shape whole = field(heart(), Box::centred(glm::dvec3(1.4)));
  const Shape shapes[] = {whole, repeatGrid(whole, Vec3E(40.0, 0.0, 40.0))};
  for (const Shape& shape : shapes)
    for (const auto kind : {Shadow::Kind::Hard, Shadow::Kind::Soft, Shadow::Kind::Improved}) {
      const Scene scene = sunlit(shape, kind);
      GpuRenderOptions options = materials(Method::AutoRelaxed, kWidth, kHeight);
      options.shader.view = View::Normals;
      const auto normals = renderOnGpu(scene, options);
      options.shader.view = View::Shadow;
      const auto light = renderOnGpu(scene, options);
      options.shader.view = View::Material;
      const auto seen = renderOnGpu(scene, options);
      int facing = 0, dark = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const glm::dvec3 n = 2.0 * glm::dvec3(normals[i]) - 1.0;
        if (!isHit(seen[i]) || glm::dot(n, sun) < 0.3) continue;
        ++facing;
        dark += light[i].r < 0.85;
      }
      EXPECT_GT(facing, 1000);
      EXPECT_LE(dark, 2) << static_cast<int>(kind);
    }
}

std::vector<glm::dvec3> shadowOnFloor(const Shape& shape, Shadow::Kind kind) {
  Scene scene = sunlit(shape, kind);
  scene.add("floor", plane({0.0, 1.0, 0.0}, -1.2).paint(painted()));
  GpuRenderOptions options = materials(Method::AutoRelaxed);
  options.shader.view = View::Shadow;
  std::vector<glm::dvec3> light;
  for (const auto& pixel : renderOnGpu(scene, options)) light.emplace_back(pixel);
  return light;
}

// Rims of shadows go by distances that are estimated where the formula's value is none.
TEST(Steep, RimsOfShadowsAreThoseOfTheDistance) {
  const Vec3E p = position();
  const Expr square = p.x * p.x + p.y * p.y + p.z * p.z + (0.64 - 0.09);
  const Expr quartic = square * square - 2.56 * (p.x * p.x + p.z * p.z);
  const Shape formula = field(quartic, Box::centred({1.2, 0.4, 1.2})), exact = torus(0.8, 0.3);
  for (const auto& [kind, decibels] :
       {std::pair(Shadow::Kind::Soft, 42.0), std::pair(Shadow::Kind::Improved, 36.0)})
    EXPECT_GE(psnr(shadowOnFloor(formula, kind), shadowOnFloor(exact, kind)), decibels)
        << static_cast<int>(kind);
}

// Where a formula is deformed, cut or blended, its steps are no shorter than they must be.
TEST(Steep, FormulasAreMetAfterOperatorsToo) {
  const Box bounds = Box::centred(glm::dvec3(1.4));
  const Shape whole = field(heart(), bounds), small = scale(whole, Vec3E(0.4));
  const auto moved = [](const Shape& s) { return translate(s, Vec3E(0.6, 0.3, 0.0)); };
  const Blend blend{Blend::Kind::Quadratic, 0.1};
  const Shape shapes[] = {
      twist(whole, 0.7),
      bend(whole, 0.35),
      taper(whole, 0.3),
      subtract(whole, cylinder(0.3, 3.0)),
      exclude({whole, sphere(0.9)}, {}),
      unite(whole, moved(sphere(0.5)), blend),
      intersect(whole, moved(whole), blend),
      round(whole, 0.05),
      displace(whole, 0.03 * sin(20.0 * position().x)),
      rotate(repeatGrid(small, Vec3E(1.2, 0.0, 1.2), glm::ivec3(3, 1, 3)), Vec3E(0.4, 0.2, 0.0)),
      polarRepeat(translate(rotate(small, Vec3E(0.4, 0.3, 0.2)), Vec3E(1.3, 0.0, 0.0)), 5),
      subtract(repeatGrid(small, Vec3E(1.2, 1.2, 0.0), glm::ivec3(2, 2, 1)), cylinder(0.3, 3.0))};
  for (const Shape& shape : shapes) {
    Scene scene = darkScene();
    scene.add("", Shape(shape).paint(painted()));
    const auto place = std::to_string(&shape - shapes);
    const GpuRenderOptions options = materials(Method::AutoRelaxed, kWidth, kHeight);
    EXPECT_LE(readingsOnGpu(scene, options).primary, 12.0) << place;
    const auto [seen, others, spent] = againstSigns(shape, renderOnGpu(scene, options));
    EXPECT_GT(seen, 40) << place;
    EXPECT_LE(others, seen / 50 + 1) << place;
    EXPECT_LE(spent, seen / 100) << place;
  }
}

// Formulas that are far steeper at their bounds than at the surface.
TEST(Steep, FormulasAreMetInFewReadings) {
  const Vec3E p = position();
  const auto quartic = [&](double size) {
    return p.x * p.x * p.x * p.x + p.y * p.y * p.y * p.y + p.z * p.z * p.z * p.z - size;
  };
  const Expr ball = dot(p, p);
  const Expr waves =
      sin(4.0 * p.x) * cos(4.0 * p.y) + sin(4.0 * p.y) * cos(4.0 * p.z) + sin(4.0 * p.z) * cos(4.0 * p.x);
  const Box bounds = Box::centred(glm::dvec3(1.4));
  const Shape shapes[] = {field(heart(), bounds), field(quartic(1.0), bounds),
                          field((ball - 0.9) * (ball + 1.0), bounds),
                          intersect(field(waves * exp(p.x), bounds), sphere(1.3)),
                          field(max(quartic(1.0), -quartic(0.5) * 3.0 - p.x), bounds)};
  for (const Shape& shape : shapes) {
    Scene scene = darkScene();
    scene.add("", Shape(shape).paint(painted()));
    GpuRenderOptions options = materials(Method::AutoRelaxed, kWidth, kHeight);
    const viewer::Readings readings = readingsOnGpu(scene, options);
    const auto picture = renderOnGpu(scene, options);
    const auto place = std::to_string(&shape - shapes);
    options.shader.steps = Steps::BySlope;
    EXPECT_LE(readings.primary, 10.0) << place;
    EXPECT_LE(readings.primary, 0.5 * readingsOnGpu(scene, options).primary) << place;
    const auto [seen, others, spent] = againstSigns(shape, picture);
    EXPECT_GT(seen, 60) << place;
    EXPECT_LE(others, seen / 50) << place;
    EXPECT_EQ(spent, 0) << place;
  }
}

}  // namespace marching_test
}  // namespace sdf::test
