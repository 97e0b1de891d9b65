// What truth_test.cpp cannot ask of every renderer: depth, normals, samples, encoding; and the figures by
// which pictures are compared.
#include <glm/geometric.hpp>
#include <stdexcept>

#include "sdf/scene/fit.h"
#include "sdf/script/script.h"
#include "viewer/render/psnr.h"
#include "viewer/render/truth.h"

namespace sdf::test {
namespace cpu_render_test {

Picture draw(const Scene& scene, int samples = 1) {
  return renderOnCpu(scene, {.width = kWidth, .height = kHeight, .samples = samples});
}

TEST(CpuRender, TellsDepthAndNormalOfEachPixel) {
  Scene scene = darkScene();
  scene.add("", ball(glm::dvec3(0.0), 1.0, {}));
  const Picture picture = draw(scene);
  const double epsilon = CpuRenderOptions{}.march.epsilon, rim = 0.02;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const std::size_t i = picture.at(column, row);
      const glm::dvec3 d = rayThrough(column, row);
      const double miss = approach(kEye, d, glm::dvec3(0.0));
      if (std::abs(miss - 1.0) < rim) continue;
      ASSERT_EQ(picture.hit(column, row), miss < 1.0) << column << ", " << row;
      if (miss > 1.0) {
        ASSERT_EQ(picture.depth[i], viewLengths(scene, std::nullopt).maxDistance);
        ASSERT_EQ(picture.normal[i], glm::dvec3(0.0));
        continue;
      }
      const double t = enterSphere(kEye, d, glm::dvec3(0.0), 1.0);
      const glm::dvec3 n = kEye + t * d;
      const double early = epsilon / -glm::dot(n, d), floatNormal = 0x1p-20;
      ASSERT_LE(std::abs(picture.depth[i] - t), early);
      ASSERT_LE(glm::length(picture.normal[i] - n), early + floatNormal);
    }
}

TEST(CpuRender, AveragesItsSamplesInLinearLight) {
  Scene scene = darkScene();
  scene.add("", ball(glm::dvec3(0.0), 1.0, {}));
  const Vec3E d = position();
  scene.background = {select(less(d.x, 0.0), 0.0, 1.0), 0.0, 0.0};
  scene.gamma = {};
  const Picture four = draw(scene, 4);
  const double half = four.color[four.at(kWidth / 2, 0)].x;  // the middle column lies on the edge
  EXPECT_EQ(half, 0.5);
  EXPECT_EQ(four.color[four.at(kWidth / 2 - 1, 0)].x, 0.0);
  EXPECT_EQ(four.color[four.at(kWidth / 2 + 1, 0)].x, 1.0);
}

TEST(CpuRender, DarkensAllLightByTheStepsOfAPlainMarch) {
  constexpr double kStrength = 0x1p-5;
  Scene scene = darkScene();
  scene.add("", wall({.color = Vec3E(0.0), .emission = Vec3E(1.0)}));
  scene.ambientOcclusion = {.kind = AmbientOcclusion::Kind::Steps, .strength = kStrength};
  const Picture picture = draw(scene);
  // Straight ahead the first step ends on the wall, the second reading says so, and the third is behind it.
  EXPECT_EQ(picture.color[picture.at(kWidth / 2, kHeight / 2)].x, 1.0 - 3.0 * kStrength);
  // Elsewhere the height is multiplied by 1 - cos each step, down to two epsilons, and one reading is behind.
  const double cosine = -rayThrough(0, 0).z, epsilon = CpuRenderOptions{}.march.epsilon;
  const double steps = 2.0 + std::ceil(std::log(2.0 * epsilon / kAway) / std::log(1.0 - cosine));
  EXPECT_EQ(picture.color[picture.at(0, 0)].x, 1.0 - steps * kStrength);
}

TEST(CpuRender, DrawsFieldsOfUnknownSlope) {
  const Vec3E p = position();
  Scene scene = darkScene();
  scene.add("", field(dot(p, p) - 1.0).paint({.color = Vec3E(0.0), .emission = Vec3E(1.0)}));
  ASSERT_FALSE(marchField(scene.whole())->hasSlope());
  scene.shadow.kind = Shadow::Kind::Soft;
  scene.lights = {sunTowards({0.0, 0.0, 1.0})};
  const Picture picture = draw(scene);
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column) {
      const double miss = approach(kEye, rayThrough(column, row), glm::dvec3(0.0));
      if (std::abs(miss - 1.0) < 0.001) continue;  // the field grows by 2 a unit here, hits are within 1e-6
      ASSERT_EQ(picture.hit(column, row), miss < 1.0) << column << ", " << row;
    }
}

TEST(CpuRender, SaysWhatItCannotDraw) {
  Scene scene = darkScene();
  scene.add("", sphere(-1.0));
  EXPECT_THROW(draw(scene), std::runtime_error);
  Scene soft = darkScene();
  soft.add("", sphere(1.0));
  soft.lights = {sunTowards({0.0, 0.0, 1.0})};
  soft.shadow = {.kind = Shadow::Kind::Soft, .start = 0.0};
  EXPECT_THROW(draw(soft), std::runtime_error);
}

TEST(CpuRender, FollowsTheScenesTime) {
  const std::string text =
      "part('ball', sphere(0.2):translate(time, 0, 0))\n"
      "camera { from = {0, 0, 6}, to = {0, 0, 0} }\n";
  const auto isHitInTheMiddle = [&](double time) {
    ScriptOptions options;
    options.time = time;
    const Picture picture = draw(runScene(text, "moving", options).value());
    return picture.hit(kWidth / 2, kHeight / 2);
  };
  EXPECT_TRUE(isHitInTheMiddle(0.0));
  EXPECT_FALSE(isHitInTheMiddle(1.0));
}

TEST(Encode, FollowsSrgbOrAPower) {
  // IEC 61966-2-1: the curve is a line up to 0.0031308, and 1.055 c^(1 / 2.4) - 0.055 above.
  const glm::dvec3 shown = encode(glm::dvec3(0.002, 0.5, 1.0), {});
  EXPECT_NEAR(shown.x, 0.02584, 1e-15);            // some ulps of a product
  EXPECT_NEAR(shown.y, 0.735356983052449, 1e-14);  // ulps of pow
  EXPECT_NEAR(shown.z, 1.0, 1e-15);                // some ulps of 1
  EXPECT_EQ(encode(glm::dvec3(-1.0, 0.25, 3.0), 2.0), glm::dvec3(0.0, 0.5, 1.0));
  EXPECT_EQ(encode(glm::dvec3(0.1, 0.2, 0.3), 1.0), glm::dvec3(0.1, 0.2, 0.3));
}

TEST(Psnr, IsTwentyDecibelsForATenth) {
  const std::vector<glm::dvec3> dark(7, glm::dvec3(0.25)), light(7, glm::dvec3(0.35));
  EXPECT_NEAR(psnr(dark, light), 20.0, 1e-13);  // ulps of 20, and of 0.1 as a difference
  EXPECT_EQ(psnr(dark, dark), HUGE_VAL);
  std::vector<glm::dvec3> oneRed = dark;
  oneRed[3].x += 0.5;
  EXPECT_NEAR(psnr(dark, oneRed), 10.0 * std::log10(7.0 * 3.0 / 0.25), 1e-13);  // ulps of 20
}

TEST(ShareApart, CountsPixelsOfWhichOneColorIsFartherOffThanAsked) {
  const std::vector<glm::dvec3> dark(8, glm::dvec3(0.25));
  std::vector<glm::dvec3> other = dark;
  other[0].y += 0.25, other[5].z -= 0.125;
  EXPECT_EQ(shareApart(dark, other, 0.0625), 0.25);
  EXPECT_EQ(shareApart(dark, other, 0.125), 0.125);
  EXPECT_EQ(shareApart(dark, other, 0.25), 0.0);
}

}  // namespace cpu_render_test
}  // namespace sdf::test
