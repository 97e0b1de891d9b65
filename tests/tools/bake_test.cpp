// sdf2gltf --bake.
#include "exported.h"

namespace sdf {
namespace bake_test {

class Bake : public Export {
 protected:
  static constexpr const char* kStage =
      "ambient(0.5) ambient_occlusion { kind = 'taps' }"
      "part('floor', box(1, 0.1, 1):translate(0, -0.1, 0)) part('ball', sphere(0.4):translate(0, 0.4, 0))";
};

TEST_F(Bake, PutsAmbientLightIntoTheFileOnlyIfAskedTo) {
  expectSuccess(run({scene(kStage), "-o", out("a.glb"), "--voxel-size", "0.1"}));
  EXPECT_FALSE(glbJson(out("a.glb")).contains("textures"));
  const Json outputs =
      report({scene(kStage), "-o", out("a.glb"), "--voxel-size", "0.1", "--bake"})["outputs"];
  const Json file = glbJson(out("a.glb"));
  ASSERT_EQ(file["materials"].size(), 1u) << "both parts wear the same";
  EXPECT_TRUE(file["materials"][0].contains("emissiveTexture"));
  for (const Json& factor : file["materials"][0]["emissiveFactor"])
    EXPECT_FLOAT_EQ(factor, 0.4f);  // 0.5 * 0.8
  // A step of a 16-bit coordinate, in the half of the texture that it runs through.
  for (const Json& part : outputs[0]["parts"]) EXPECT_LT(part["ambient_error"], 2.0 / 65535);
  EXPECT_TRUE(outputs[0]["total"]["stage_seconds"].contains("occlusion"));
  EXPECT_EQ(file["nodes"][0]["extras"]["ambientError"], outputs[0]["parts"][0]["ambient_error"]);
}

TEST_F(Bake, LooksAtAllPartsEvenInOne) {
  const auto darkest = [&](std::vector<std::string> flags) {
    std::vector<std::string> words{scene(kStage), "-o", out("a.glb"), "--voxel-size", "0.1", "--bake"};
    words.insert(words.end(), flags.begin(), flags.end());
    expectSuccess(run(words));
    return glbJson(out("a.glb")).contains("textures");
  };
  EXPECT_TRUE(darkest({}));
  EXPECT_FALSE(darkest({"--only", "ball"})) << "a ball alone hides nothing from itself";
}

TEST_F(Bake, WarnsWhereOcclusionDependsOnWhoLooks) {
  const std::string steps = scene("ambient(0.5) ambient_occlusion { kind = 'steps' } return sphere(1)");
  const Outcome outcome = run({steps, "-o", out("a.glb"), "--bake", "--report", out("r.json")});
  EXPECT_EQ(outcome.status, 0);
  const std::string warning =
      "ambient_occlusion: what counts steps depends on who looks and is not baked; take kind = 'taps'";
  EXPECT_EQ(outcome.err, "sdf2gltf: warning: " + warning + "\n");
  EXPECT_EQ(Json::parse(contents(out("r.json")))["outputs"][0]["warnings"], Json{warning});
  expectSuccess(run({steps, "-o", out("a.glb")}));
}

TEST_F(Bake, WarnsWhereAmbientColoursAreMoreThanEmissionsHold) {
  // Red, green and blue by thirds: no two of them blend to the third.
  const std::string thirds = scene(
      "ambient(1) return sphere(1):paint { color = function(x, y, z)"
      " return {step(0.3, x), step(x, 0.3) * step(x, -0.3), step(-0.3, x) * step(x, 0.3)} end }");
  const Outcome outcome = run({thirds, "-o", out("a.glb"), "--voxel-size", "0.1", "--bake"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("sdf2gltf: warning: part 'part 1': the baked ambient light is off by up to "),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("materials of their own"), std::string::npos);
}

}  // namespace bake_test
}  // namespace sdf
