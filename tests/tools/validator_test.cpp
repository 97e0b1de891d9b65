// Every sample becomes a file that Khronos' glTF validator accepts.
#include <set>

#include "sdf2gltf.h"
#include "support/samples.h"

namespace sdf {
namespace validator_test {

// Those whose tolerance takes little time; the others are meshed with voxels alone.
const std::set<std::string> kQuick{"dice", "metals", "s1_sphere"};

std::string voxelSizeOf(const std::string& sample) {
  if (sample == "composite" || sample == "v_parts") return "0.1";  // they are large
  if (sample == "mug") return "0.02";                              // its coffee is thin
  return "0.04";
}

class Validator : public Sdf2gltf, public testing::WithParamInterface<std::filesystem::path> {};

TEST_P(Validator, AcceptsTheSample) {
  std::vector<std::string> words{GetParam().string(), "-o", out("a.glb"), "--bake"};
  const std::string name = GetParam().stem();
  if (!kQuick.contains(name)) words.insert(words.end(), {"--voxel-size", voxelSizeOf(name)});
  const Outcome made = run(words);
  ASSERT_EQ(made.status, 0) << made.err;
  Command validate;
  validate.words = {"/usr/bin/env", "node", SDF_SOURCE_DIR "/tests/gltf/validate.js", SDF_VALIDATOR_MODULES,
                    out("a.glb")};
  const Outcome verdict = validate.run();
  EXPECT_EQ(verdict.status, 0) << verdict.out << verdict.err;
}

INSTANTIATE_TEST_SUITE_P(, Validator, testing::ValuesIn(test::allSamples()), test::stemOf);

}  // namespace validator_test
}  // namespace sdf
