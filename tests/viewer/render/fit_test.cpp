// Pictures of scenes that leave the camera to the viewer.
#include <gtest/gtest.h>

#include "sdf/script/script.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"

namespace sdf::test {
namespace fit_test {

using viewer::Eye;
using viewer::LookFunction;

Scene sceneOf(const std::string& text) {
  auto scene = runScene(text, "fit.lua");
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

struct Drawing {
  const char* name;
  const char* text;  ///< of a scene of the size s
  bool sharing = true;
};

constexpr const char* kBalls =
    "local all = {}\n"
    "for i = 1, 300 do\n"
    "  local r = (0.08 + 0.02 * math.sin(i)) * s\n"
    "  all[i] = sphere(r):translate(s * math.sin(12.9898 * i), s * math.sin(78.233 * i),\n"
    "                               s * math.sin(37.719 * i))\n"
    "end\n"
    "return union(all)";

constexpr Drawing kDrawings[] = {
    {"a box", "return box(s, s, s)"},
    {"a blend", "return union(box(s, 0.6*s, 0.4*s), sphere(0.7*s):translate(0.6*s, 0, 0.5*s), {k = 0.2*s})"},
    {"shadow, occlusion and mirrors",
     "shadows{kind = 'soft'} ambient_occlusion{kind = 'taps'} directional_light{direction = {1, 2, 1.5}}\n"
     "local m = material{color = {0.7, 0.3, 0.2}, specular = 0.4, reflectivity = 0.3}\n"
     "return union(box(s, 0.6*s, 0.4*s), torus(0.7*s, 0.2*s):translate(0.6*s, 0, 0.5*s)):paint(m)"},
    {"balls, drawn in groups", kBalls},
    {"balls, whose normals are taken by differences", kBalls, false}};

std::vector<glm::dvec3> drawnAt(const Drawing& drawing, double size) {
  GpuRenderOptions options;
  options.shader.sharing = drawing.sharing;
  return colors(
      renderOnGpu(sceneOf("background(0) local s = " + number(size) + "\n" + drawing.text), options));
}

/// The pixels that differ from the one in the picture's corner.
double shownShare(const std::vector<glm::dvec3>& picture) {
  return shareApart(picture, std::vector(picture.size(), picture.front()), 0.0);
}

// One pixel of 160 x 90 that changes from black to white leaves 10 log10(160 90) = 41.6 dB. At other scales
// every number is rounded anew, which may move an edge over no more than a pixel's middle.
constexpr double kAPixel = 41.0;
// The root mean square of 2^-24, half a float's last bit, is -144 dB.
constexpr double kDriversRounding = 140.0;

TEST(Fit, PicturesOfAShapeAreTheSameAtAnySize) {
  for (const Drawing& drawing : kDrawings) {
    const auto one = drawnAt(drawing, 1.0);
    EXPECT_GT(shownShare(one), 0.1) << drawing.name;
    const auto expectAt = [&](double size, double leastPsnr) {
      EXPECT_GT(psnr(one, drawnAt(drawing, size)), leastPsnr) << drawing.name << " times " << number(size);
    };
    expectAt(0x1p-20, kDriversRounding);  // powers of two round nothing
    if (!drawing.sharing) continue;       // the driver takes seconds for a shader of all balls
    for (const double size : {1e-6, 1e-3, 1e3, 1e6}) expectAt(size, kAPixel);
  }
}

// Of a box the picture shows all but the margin, whichever of its sides is the tighter one.
TEST(Fit, AllOfAShapeIsInViewInPicturesOfAnyShape) {
  const Scene scene = sceneOf("background(0) return box(50, 20, 30):translate(500, 0, 0)");
  for (const auto& [width, height] : {std::pair(160, 90), {90, 90}, {30, 150}, {240, 30}}) {
    GpuRenderOptions options;
    options.width = width;
    options.height = height;
    const auto picture = colors(renderOnGpu(scene, options));
    int left = width, right = -1, top = height, bottom = -1;
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column)
        if (picture[row * width + column] != picture.front()) {
          left = std::min(left, column), right = std::max(right, column);
          top = std::min(top, row), bottom = std::max(bottom, row);
        }
    EXPECT_GT(std::min(left, top), 0) << width << " x " << height;
    EXPECT_LT(right, width - 1) << width << " x " << height;
    EXPECT_LT(bottom, height - 1) << width << " x " << height;
    // One side comes as near to its edge as the margin and a pixel allow.
    const double nearest = std::min({left / (0.5 * width), (width - 1 - right) / (0.5 * width),
                                     top / (0.5 * height), (height - 1 - bottom) / (0.5 * height)});
    EXPECT_LE(nearest, 0.05 + 2.0 / std::min(width, height)) << width << " x " << height;
  }
}

TEST(Fit, ACameraOfTheScenesOwnStays) {
  const LookFunction look(sceneOf("camera{fov = 30}\nreturn sphere(1000)"));
  for (const double aspect : {0.5, 2.0}) {
    const Eye eye = look.at({}, aspect).eye;
    EXPECT_EQ(eye.from, glm::dvec3(3.4, 2.6, 4.6));
    EXPECT_EQ(eye.to, glm::dvec3(0.0));
    EXPECT_FALSE(eye.fittedRadius);
  }
}

TEST(Fit, AnUnboundedSceneIsSeenByTheDefaultCamera) {
  const Eye eye = LookFunction(sceneOf("return plane({0, 1, 0}, 0)")).at({}).eye;
  EXPECT_EQ(eye, Eye{});
}

TEST(Fit, KeepsTheDirectionAndLooksAtTheMiddle) {
  Eye eye{{1.0, 2.0, 3.0}, {0.0, 2.0, 5.0}, {0.0, 0.0, 1.0}, 30.0, true};
  const Box box{{10.0, 10.0, 10.0}, {14.0, 12.0, 11.0}};
  const Eye moved = fitted(eye, box, 1.5);
  EXPECT_EQ(moved.to, box.centre());
  constexpr double kRounding = 1e-15;
  const auto way = [](const Eye& e) { return glm::normalize(e.to - e.from); };
  EXPECT_LT(glm::distance(way(moved), way(eye)), 8.0 * kRounding);
  EXPECT_EQ(moved.up, eye.up);
  EXPECT_EQ(moved.fov, eye.fov);
  EXPECT_TRUE(moved.mirrored);
}

// A fitted camera sees the scene from however far it is moved; one that the scene places sees as far as the
// scene says.
TEST(Fit, AFittedCameraSeesTheSceneFromAnyDistance) {
  Scene scene = sceneOf("max_distance(7)\nreturn sphere(1)");
  const viewer::Extent extent(scene);
  Eye eye = LookFunction(scene).at({}).eye;
  EXPECT_EQ(extent.lengths(eye).maxDistance, 7.0) << "which is enough";
  eye.from *= 1000.0;
  EXPECT_GT(extent.lengths(eye).maxDistance, glm::length(eye.from) + 1.0);
  eye.fittedRadius.reset();
  EXPECT_EQ(extent.lengths(eye).maxDistance, 7.0);
}

}  // namespace fit_test
}  // namespace sdf::test
