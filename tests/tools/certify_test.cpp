// sdf2gltf --certify.
#include "exported.h"

namespace sdf {
namespace certify_test {

class Certified : public Export {};

TEST_F(Certified, WritesTheProvenDistanceBesideTheMeasuredOne) {
  const std::string round = scene("part('ball', sphere(1)) part('other', sphere(1):translate(3, 0, 0))");
  const std::vector<std::string> words{round, "-o", out("a.glb"), "--voxel-size", "0.0625"};
  std::vector<std::string> certified = words;
  certified.push_back("--certify");
  const Json outputs = report(certified)["outputs"];
  const Json file = glbJson(out("a.glb"));
  double most = 0.0;
  for (int i = 0; i < 2; ++i) {
    const Json& part = outputs[0]["parts"][i];
    const double proven = part["proven_distance"], measured = part["max_distance"];
    EXPECT_GE(proven, measured);
    EXPECT_LE(proven, 3.0 * measured);
    EXPECT_EQ(file["nodes"][i]["extras"]["provenDistance"], proven);
    most = std::max(most, proven);
  }
  EXPECT_EQ(outputs[0]["total"]["proven_distance"], most);
  EXPECT_EQ(file["asset"]["extras"]["provenDistance"], most);
  EXPECT_NE(run(certified).out.find("  proven  "), std::string::npos);

  EXPECT_EQ(report(words)["outputs"][0]["parts"][0]["proven_distance"], nullptr);
  EXPECT_FALSE(glbJson(out("a.glb"))["nodes"][0]["extras"].contains("provenDistance"));
  EXPECT_EQ(run(words).out.find("proven"), std::string::npos);
}

}  // namespace certify_test
}  // namespace sdf
