// Pictures that are drawn in pieces are those that are drawn at once.
#include <gtest/gtest.h>

#include "sdf/script/script.h"
#include "viewer/headless_test.h"
#include "viewer/render/renderer.h"

namespace sdf::viewer {
namespace rows_test {

constexpr int kWidth = 100, kHeight = 75;

class Rows : public HeadlessTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(HeadlessTest::SetUp());
    scene = loadScene(SDF_SOURCE_DIR "/samples/" + std::string(GetParam()) + ".lua").value();
  }

  Renderer renderer() const { return Renderer::make(scene).value(); }
  static Target target() { return Target::create(kWidth, kHeight, {PixelFormat::Rgba8}).value(); }
  Frame frame(int samples) const {
    Frame frame = frameOf(LookFunction(scene));
    frame.samples = samples;
    return frame;
  }

  // Pieces of as many rows, and what is left.
  template <class Draw>
  static void inPieces(int rows, Draw draw) {
    for (int row = 0; row < kHeight; row += rows)
      ASSERT_TRUE(draw(viewer::Rows{row, std::min(rows, kHeight - row)}));
  }

  Scene scene;
};

TEST_P(Rows, MakeUpAPicture) {
  for (const int samples : {1, 2}) {
    Renderer whole = renderer(), piecewise = renderer();
    const Target expected = target(), made = target();
    ASSERT_TRUE(whole.draw(frame(samples), expected));
    for (const int rows : {7, 64, kHeight}) {
      made.clear(0, glm::vec4(0.0f));
      inPieces(rows, [&](const viewer::Rows& some) { return piecewise.draw(frame(samples), made, some); });
      ASSERT_EQ(made.picture()->bytes, expected.picture()->bytes) << samples << " by " << rows;
    }
  }
}

TEST_P(Rows, MakeUpASample) {
  Renderer whole = renderer(), piecewise = renderer();
  const Target expected = target(), made = target();
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(whole.refine(frame(2), i, expected));
    inPieces(13 + i, [&](const viewer::Rows& some) { return piecewise.refine(frame(2), i, made, some); });
    ASSERT_EQ(made.picture()->bytes, expected.picture()->bytes) << i;
  }
}

TEST_P(Rows, LeaveTheOthersAsTheyAre) {
  Renderer renderer = this->renderer();
  const Target made = target();
  made.clear(0, glm::vec4(1.0f, 0.0f, 1.0f, 0.25f));
  ASSERT_TRUE(renderer.draw(frame(1), made, viewer::Rows{0, 20}));
  ASSERT_TRUE(renderer.draw(frame(1), made, viewer::Rows{20, 10}));
  const Picture picture = made.picture().value();
  for (int i = 0; i < kWidth * kHeight; ++i)
    ASSERT_EQ(picture.bytes[4 * i + 3] != 64, i / kWidth >= kHeight - 30) << i % kWidth << ", " << i / kWidth;
}

// One that is marched whole, one in tiles, one with mirrors, and groups with and without a floor.
INSTANTIATE_TEST_SUITE_P(Of, Rows, testing::Values("pawn", "gear", "metals", "sunflower", "chess"));

}  // namespace rows_test
}  // namespace sdf::viewer
