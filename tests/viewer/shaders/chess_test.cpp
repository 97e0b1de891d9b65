// A set of 32 large pieces: what they share.
#include <gtest/gtest.h>

#include <algorithm>

#include "sdf/script/script.h"
#include "viewer/shaders/assemble.h"

namespace sdf::test {
namespace chess_test {

Scene chess(double shadows) {
  ScriptOptions script;
  script.values = {{"shadows", shadows}};
  auto scene = loadScene(SDF_SOURCE_DIR "/samples/chess.lua", script);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(*scene);
}

TEST(ChessSet, HasAShortShader) {
  for (const double shadows : {0.0, 1.0}) {
    const auto shaders = viewer::assemble(chess(shadows), {});
    ASSERT_TRUE(shaders) << shaders.error().message;
    EXPECT_LE(shaders->bytes(), 150000u);
  }
}

// A pawn and a king have one stem.
TEST(ChessSet, SharesWhatItsPiecesHaveInCommon) {
  const auto shaders = viewer::assemble(chess(1.0), {});
  ASSERT_TRUE(shaders) << shaders.error().message;
  const auto& [many, others] = *shaders->plan.kinds;
  EXPECT_TRUE(std::ranges::any_of(many, [](const OperandKind& kind) { return kind.singles.size() == 28; }));
  EXPECT_LT(others.size(), 10u);
}

}  // namespace chess_test
}  // namespace sdf::test
