// Pictures of what floats are too coarse for: scenes far from the origin, and hashes of large numbers.
#include <gtest/gtest.h>

#include "sdf/script/script.h"
#include "viewer/gpu/context.h"
#include "viewer/reference/cpu_render.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"

namespace sdf::test {
namespace far_test {

using viewer::Eye;
using viewer::originFor;

Scene farScene(const std::string& text) {
  auto scene = runScene(text, "far.lua");
  if (!scene) throw std::runtime_error(scene.error().message);
  return std::move(*scene);
}

struct FarDrawing {
  const char* name;
  const char* text;  ///< of a scene moved by at(shape), where points are moved by (x, y, z)
};

constexpr FarDrawing kDrawings[] = {
    {"a fitted view",
     "part('thing', at((box(1, 0.5, 1):round(0.1) - sphere(0.7):translate(0, 0.6, 0)):rotate(0, 20, 10)))"},
    {"lamps, a camera of its own, a slider and paint",
     "local d = param('d', 0.25, {min = 0, max = 1})\n"
     "camera{from = {x + 2, y + 2, z + 3}, to = {x, y, z}}\n"
     "point_light{position = {x + 1, y + 2, z + 1}} shadows{kind = 'soft'}\n"
     "part('ground', at(plane({0, 1, 0}, -0.5)))\n"
     "part('ball', at(sphere(0.5):translate(d, 0, 0):paint(function(x, y, z)\n"
     "  return 0.5 + 0.5 * sin(20 * x), 0.5, 0.2 end)))"},
    {"many operands, and a repeated one",
     "local all = {}\n"
     "for i = 1, 40 do all[i] = sphere(0.1):translate(math.sin(13 * i), math.sin(78 * i), math.sin(38 * i)) "
     "end\n"
     "part('balls', at(union(all)))\n"
     "part('pins', at(cylinder(0.05, 0.2):repeat_grid({0.5, 0, 0.5}, {5, 1, 5}):translate(0, -1, 0)))"}};

std::vector<glm::dvec3> drawnAt(const FarDrawing& drawing, const std::string& x, const std::string& y,
                                const std::string& z) {
  return colors(
      renderOnGpu(farScene("local x, y, z = " + x + ", " + y + ", " + z +
                           "\nlocal function at(s) return s:translate(x, y, z) end\n" + drawing.text),
                  {}));
}

// One pixel of 160 x 90 that changes from black to white leaves 41.6 dB: an edge over no more than a pixel's
// middle moves by rounding.
TEST(FarPictures, AreThoseAtTheOrigin) {
  for (const FarDrawing& drawing : kDrawings) {
    const auto near = drawnAt(drawing, "0", "0", "0");
    EXPECT_GT(shareApart(near, std::vector(near.size(), near.front()), 0.0), 0.1) << drawing.name;
    EXPECT_GT(psnr(near, drawnAt(drawing, "6455808", "2408", "1920960")), 40.0) << drawing.name;
    EXPECT_GT(psnr(near, drawnAt(drawing, "-1e8", "0.3", "70000.1")), 40.0) << drawing.name;
  }
}

// Shaders are made anew only where the eye has gone far from what they are relative to.
TEST(FarPictures, OriginsAreKeptWhileTheyDo) {
  const Eye usual;
  EXPECT_EQ(originFor(usual), glm::dvec3(0.0));
  Eye far{.from = {6455812.0, 2408.0, 1920964.0}, .to = {6455808.0, 2408.0, 1920960.0}};
  const glm::dvec3 origin = originFor(far);
  EXPECT_EQ(origin, far.to);
  far.from += glm::dvec3(100.0, 20.0, -50.0);
  far.to += glm::dvec3(100.0, 20.0, -50.0);
  EXPECT_EQ(originFor(far, origin), origin);
  EXPECT_EQ(originFor(usual, origin), usual.to);
}

// Towers on a grid, each as high, and as red, as a hash of its cell says.
constexpr const char* kTowers = R"(
camera{from = {4, 14, 9}, to = {0, 0, 0}} background(0) directional_light{direction = {1, 3, 2}}
local function hash(i, k) return fract(sin(i * 12.9898 + k * 78.233) * 43758.5453) end
local city = field(function(x, y, z)
  local ix, iz = floor(x / 2 + 0.5), floor(z / 2 + 0.5)
  local qx, qz, qy = abs(x - 2 * ix) - 0.6, abs(z - 2 * iz) - 0.6, abs(y) - 1 - 3 * hash(ix, iz)
  return length(max(qx, 0), max(qy, 0), max(qz, 0)) + min(max(qx, qy, qz), 0)
end, {lipschitz = 8})
part("city", (city & box(5, 5, 5)):paint(function(x, y, z)
  return hash(floor(z / 2 + 0.5), floor(x / 2 + 0.5)), 0.5, 0.5 end)))";

TEST(HashedPictures, AreThoseOfTheFormulaInDouble) {
  const Scene scene = farScene(kTowers);
  const auto cpu = encode(renderOnCpu(scene, {}).color, scene.gamma);
  const auto gpu = colors(renderOnGpu(scene, {}));
  if (!viewer::hasDoubles()) GTEST_SKIP() << "the driver has no doubles";
  EXPECT_GT(psnr(cpu, gpu), 35.0);
}

// What shaders cannot compute in double is said, once for each part.
TEST(HashedPictures, WhatTheyCannotShowIsSaid) {
  const Scene scene = farScene(kTowers);
  const auto doubtful = [&](const viewer::ShaderOptions& options) {
    return viewer::assemble(scene, options).value().plan.doubtful;
  };
  EXPECT_TRUE(doubtful({}).empty());
  const auto said = doubtful({.doubles = false});
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("part 'city': its formula needs more digits"), std::string::npos) << said[0];
  EXPECT_EQ(doubtful({.es = true}), said);
}

}  // namespace far_test
}  // namespace sdf::test
