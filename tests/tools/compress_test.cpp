// sdf2gltf --compress.
#include "exported.h"

namespace sdf {
namespace compress_test {

class Compress : public Export {};

TEST_F(Compress, TheLatticeTakesAQuarterAtMost) {
  const std::string lattice = SDF_SOURCE_DIR "/samples/lattice.lua";
  // It warns of walls thinner than its voxels.
  ASSERT_EQ(run({lattice, "-o", out("plain.glb"), "--voxel-size", "0.02"}).status, 0);
  ASSERT_EQ(run({lattice, "-o", out("small.glb"), "--voxel-size", "0.02", "--compress"}).status, 0);
  EXPECT_LE(4 * std::filesystem::file_size(out("small.glb")), std::filesystem::file_size(out("plain.glb")));
}

TEST_F(Compress, RoundingCountsInTheFiguresOfEveryPart) {
  const std::string twoParts = scene(kTwoParts);
  const Json plain = report({twoParts, "-o", out("a.glb"), "--voxel-size", "0.02"})["outputs"][0];
  const Json small =
      report({twoParts, "-o", out("a.glb"), "--voxel-size", "0.02", "--compress"})["outputs"][0];
  const Json file = glbJson(out("a.glb"));
  ASSERT_EQ(small["parts"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto added = [&](const char* figure) {
      return small["parts"][i][figure].get<double>() - plain["parts"][i][figure].get<double>();
    };
    const double rms = plain["parts"][i]["rms_distance"];
    // Half the diagonal of a step of 22 binary digits of coordinates below 4, where the mesh itself is exact.
    const double finest = std::sqrt(3.0) / 2.0 * 4.0 * 0x1p-22;
    EXPECT_GT(added("rms_distance"), 0.05 * rms);
    EXPECT_LE(added("rms_distance"), std::max(0.1 * rms, finest));
    // The same number was added to both: differences of doubles below 1.
    EXPECT_NEAR(added("max_distance"), added("rms_distance"), 1e-12);
    EXPECT_EQ(file["nodes"][i]["extras"]["maxDistance"], small["parts"][i]["max_distance"]);
    EXPECT_EQ(file["nodes"][i]["extras"]["rmsDistance"], small["parts"][i]["rms_distance"]);
  }
  EXPECT_EQ(file["asset"]["extras"]["maxDistance"], small["total"]["max_distance"]);
  EXPECT_GT(small["total"]["max_distance"].get<double>(), plain["total"]["max_distance"].get<double>());
}

TEST_F(Compress, RoundingIsWithinTheTolerance) {
  const Json output = report({scene("part('ball', sphere(1)) part('ring', torus(2, 0.3))"), "-o",
                              out("a.glb"), "--compress", "--tolerance", "0.004"})["outputs"][0];
  ASSERT_EQ(output["parts"].size(), 2u);
  for (const Json& part : output["parts"]) {
    EXPECT_EQ(part["tolerance"], 0.004);
    EXPECT_LE(part["max_distance"].get<double>(), 0.004);
    EXPECT_GT(part["max_distance"].get<double>(), 0.8 * 0.004);
  }
}

TEST_F(Compress, AnimationsAreCompressedToo) {
  const std::string moving = scene("part('ball', sphere(1):translate(time, 0, 0)) part('rest', sphere(0.5))");
  expectSuccess(run({moving, "-o", out("a.glb"), "--animate", "--frames", "3", "--compress"}));
  const Json file = glbJson(out("a.glb"));
  EXPECT_EQ(file["animations"].size(), 1u);
  EXPECT_EQ(file["meshes"].size(), 2u);
  for (const Json& mesh : file["meshes"]) {
    const Json position = file["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<int>()];
    EXPECT_TRUE(file["bufferViews"][position["bufferView"].get<int>()].contains("extensions"));
  }
}

TEST_F(Compress, TheFileIsTheSameForAnyNumberOfThreads) {
  for (const char* extension : {".glb", ".gltf"}) {
    std::vector<std::string> bytes;
    for (const char* threads : {"1", "2", "7"}) {
      const std::string name = out(std::string("t") + threads + extension);
      expectSuccess(run({scene(kTwoParts), "-o", name, "--compress", "--threads", threads}));
      bytes.push_back(contents(name));
    }
    EXPECT_FALSE(bytes[0].empty());
    EXPECT_TRUE(bytes[0] == bytes[1] && bytes[1] == bytes[2]) << extension;
  }
}

}  // namespace compress_test
}  // namespace sdf
