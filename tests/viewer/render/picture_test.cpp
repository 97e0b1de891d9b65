// The shaders' pictures of every sample against the CPU's.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "sdf/eval/scalar_reading.h"
#include "sdf/march/field.h"
#include "sdf/script/script.h"
#include "support/samples.h"
#include "viewer/reference/cpu_camera.h"
#include "viewer/render/gpu_render.h"
#include "viewer/render/psnr.h"
#include "viewer/render/renderers.h"

namespace sdf::test {
namespace picture_test {

constexpr int kPictureWidth = 160, kPictureHeight = 90;

bool countsSteps(const Scene& scene) { return scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps; }

// Where the eye and a checkerboard are in line, whole rows of rays meet the squares' sides, and rounding
// chooses the colour: this puts them out of line.
const Vec3E kAside(glm::dvec3(1.4e-3, 1.7e-3, 0.6e-3));

class PictureOf : public testing::TestWithParam<std::filesystem::path> {
 protected:
  void SetUp() override {
    auto loaded = loadScene(GetParam());
    ASSERT_TRUE(loaded) << loaded.error().message;
    scene = std::move(*loaded);
    scene.camera.from = scene.camera.eye() + kAside;
  }

  Picture drawOnCpu(double epsilon) const {
    CpuRenderOptions options;
    options.width = kPictureWidth;
    options.height = kPictureHeight;
    options.march.epsilon = epsilon;
    return renderOnCpu(scene, options);
  }

  std::vector<glm::dvec3> onCpu(double epsilon) const {
    return encode(drawOnCpu(epsilon).color, scene.gamma);
  }

  // The CPU's patterns are sharp.
  std::vector<glm::dvec3> onGpu(GpuRenderOptions options) const {
    options.filter = false;
    options.width = kPictureWidth;
    options.height = kPictureHeight;
    return colors(renderOnGpu(scene, options));
  }

  Scene scene;
};

// Both hit at one distance from the surface, so what differs is rounding: invisible, but where it decides
// which side of an edge a ray is on. That happens to less than one pixel in a thousand, and a colour then
// changes by less than a third in the root mean square: 10^-3 / 10 is 40 dB.
TEST_P(PictureOf, IsTheCpusWhereBothHitAtTheSameDistance) {
  constexpr double kBar = 40.0;
  // Positions are rounded to 2^-21 at most; rays that stop only there would take steps without end.
  constexpr double kEpsilon = 1e-5, kEpsilonOfSteps = 1e-4;
  GpuRenderOptions options;
  options.epsilon = countsSteps(scene) ? kEpsilonOfSteps : kEpsilon;
  options.threshold = 0.0;
  options.maxSteps = 5000;
  // Occlusion by steps counts how many it took to come so close.
  const double db =
      psnr(onCpu(countsSteps(scene) ? options.epsilon : CpuRenderOptions{}.march.epsilon), onGpu(options));
  RecordProperty("psnr", std::to_string(db));
  EXPECT_GE(db, kBar);
}

// How many times farther off the surface is at each pixel's hit than what is held to the threshold says, the
// greater of f and f / L: there it is f / |grad f| away, to first order. 1 where f is the distance, and where
// there is no hit.
std::vector<double> stretches(const Scene& scene, const Picture& picture) {
  const Shape whole = scene.whole();
  const Tape tape(whole.distance);
  const MarchField field = marchField(whole).value();
  const Pinhole camera(scene.camera, picture.width, picture.height);
  std::vector<double> result(picture.color.size(), 1.0);
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column) {
      if (!picture.hit(column, row)) continue;
      const std::size_t i = picture.at(column, row);
      const glm::dvec3 p = camera.from() + picture.depth[i] * camera.through(column + 0.5, row + 0.5);
      result[i] = std::min(field.lipschitz, 1.0) / glm::length(evaluateGradient(tape, p).gradient);
    }
  return result;
}

// The mean square that a picture changes by if its edges, each between two pixels, move by the greater of the
// pixels' shares of a pixel.
double changeByMovedEdges(const std::vector<glm::dvec3>& c, const std::vector<double>& shares) {
  double sum = 0.0;
  const auto add = [&](std::size_t i, std::size_t j) {
    sum += std::max(shares[i], shares[j]) * glm::dot(c[i] - c[j], c[i] - c[j]);
  };
  for (int row = 0; row < kPictureHeight; ++row)
    for (int column = 0; column < kPictureWidth; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * kPictureWidth + column;
      if (column + 1 < kPictureWidth) add(i, i + 1);
      if (row + 1 < kPictureHeight) add(i, i + kPictureWidth);
    }
  return sum / (3.0 * static_cast<double>(c.size()));
}

// A hit counts within `threshold` of a pixel's radius, so edges move outwards by half that share of a pixel,
// and by twice as much where they are cut or blended, since distances there are read as less than they are.
// Where distances are only bounds, a hit counts within half the threshold, but the surface is farther off by
// the stretch; half as much again is for colours and normals, which are read there, too.
TEST_P(PictureOf, HasItsEdgesMovedByTheThresholdOnly) {
  if (countsSteps(scene)) GTEST_SKIP() << "its light depends on the threshold";
  const GpuRenderOptions options;
  const Picture cpu = drawOnCpu(CpuRenderOptions{}.march.epsilon);
  const std::vector<glm::dvec3> truth = encode(cpu.color, scene.gamma);
  std::vector<double> shares = stretches(scene, cpu);
  for (double& s : shares) s = 0.5 * options.threshold * std::max(2.0, 1.5 * 0.5 * s);
  const double db = psnr(truth, onGpu(options)), bar = -10.0 * std::log10(changeByMovedEdges(truth, shares));
  RecordProperty("psnr", std::to_string(db));
  RecordProperty("bar", std::to_string(bar));
  EXPECT_GE(db, bar);
  EXPECT_GE(db, 39.0);  // reached by all
}

// Of the pixels that differ by what can be seen, all but a few show the edge of something: a neighbour in the
// plain picture has the colour of the fast one.
TEST_P(PictureOf, IsTheSameForEveryWayOfMarching) {
  GpuRenderOptions plain;
  plain.shader.method = viewer::Method::Plain;
  constexpr double kSeen = 1.0 / 16.0;
  const auto fast = onGpu({}), slow = onGpu(plain);
  int foreign = 0;
  for (int row = 1; row + 1 < kPictureHeight; ++row)
    for (int column = 1; column + 1 < kPictureWidth; ++column) {
      double nearest = 1.0;
      for (int j = row - 1; j <= row + 1; ++j)
        for (int i = column - 1; i <= column + 1; ++i) {
          const glm::dvec3 d = glm::abs(slow[static_cast<std::size_t>(j) * kPictureWidth + i] -
                                        fast[static_cast<std::size_t>(row) * kPictureWidth + column]);
          nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
        }
      foreign += nearest > kSeen;
    }
  EXPECT_LE(foreign, kPictureWidth * kPictureHeight / 1000);
}

TEST_P(PictureOf, IsInTheGallery) {
  std::ifstream file(SDF_SOURCE_DIR "/docs/gallery.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string picture = "gallery/" + GetParam().stem().string() + ".png";
  EXPECT_NE(page.find(picture), std::string::npos) << "run ./bootstrap gallery";
  EXPECT_TRUE(std::filesystem::exists(SDF_SOURCE_DIR "/docs/" + picture));
}

INSTANTIATE_TEST_SUITE_P(Samples, PictureOf, testing::ValuesIn(samples()), stemOf);

}  // namespace picture_test
}  // namespace sdf::test
