// sdf2gltf --animate.
#include <cstring>
#include <glm/gtc/quaternion.hpp>

#include "exported.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/script/script.h"

namespace sdf {
namespace animate_test {

/// A .glb file's JSON and data.
struct Glb {
  Json json;
  std::string data;

  explicit Glb(const std::string& file) {
    const std::string bytes = contents(file);
    std::uint32_t length = 0;
    bytes.copy(reinterpret_cast<char*>(&length), 4, 12);
    json = Json::parse(bytes.substr(20, length));
    data = bytes.substr(20 + length + 8);
  }

  /// The floats of an accessor.
  std::vector<float> floats(int index) const {
    const Json& accessor = json["accessors"][index];
    const Json& view = json["bufferViews"][accessor["bufferView"].get<int>()];
    std::vector<float> values(view["byteLength"].get<std::size_t>() / sizeof(float));
    std::memcpy(values.data(), data.data() + view.value("byteOffset", 0), values.size() * sizeof(float));
    return values;
  }

  int nodeOf(const std::string& name) const {
    for (std::size_t i = 0; i < json["nodes"].size(); ++i)
      if (json["nodes"][i]["name"] == name) return static_cast<int>(i);
    ADD_FAILURE() << "no node " << name;
    return 0;
  }

  /// The keys of a node's property; empty where it has none.
  std::vector<float> keys(const std::string& node, const std::string& path) const {
    if (!json.contains("animations")) return {};
    const Json& animation = json["animations"][0];
    for (const Json& channel : animation["channels"])
      if (channel["target"]["node"] == nodeOf(node) && channel["target"]["path"] == path)
        return floats(animation["samplers"][channel["sampler"].get<int>()]["output"]);
    return {};
  }

  /// Of the mesh that the node's only child holds, where that puts it.
  std::vector<glm::vec3> positions(const std::string& node) const {
    const Json& child = json["nodes"][json["nodes"][nodeOf(node)]["children"][0].get<int>()];
    const Json& by = child["translation"];
    const glm::vec3 shift(by[0], by[1], by[2]);
    std::vector<glm::vec3> all;
    for (const Json& primitive : json["meshes"][child["mesh"].get<int>()]["primitives"]) {
      const std::vector<float> v = floats(primitive["attributes"]["POSITION"]);
      for (std::size_t i = 0; i < v.size(); i += 3)
        all.push_back(shift + glm::vec3(v[i], v[i + 1], v[i + 2]));
    }
    return all;
  }
};

class Animate : public Export {
 protected:
  /// A block that moves and turns, one that rests, and a ball that grows.
  static constexpr const char* kScene =
      "directional_light { direction = {1, 2, 1} }"
      "part('floor', box(2, 0.1, 2):translate(0, -0.1, 0))\n"
      "part('mover', (box(0.5, 0.3, 0.2):round(0.05) | sphere(0.3):translate(0.5, 0.2, "
      "0)):paint(checkerboard(0.2, 0.8))"
      ":rotate(20, 80 * time, 10 * sin(time)):translate(time, 1 + sin(2 * time), 0))\n"
      "part('ball', sphere(0.3 + 0.05 * time):translate(-1, 1, 0))";

  std::vector<std::string> animated(const std::string& text, int frames) {
    return {scene(text), "-o", out("a.glb"),   "--animate", "--frames", std::to_string(frames),
            "--fps",     "4",  "--voxel-size", "0.08"};
  }
};

TEST_F(Animate, WritesOneFileWithAMeshForWhatMovesAndOneForEachShapeOfWhatChanges) {
  const Json output = report(animated(kScene, 5))["outputs"][0];
  EXPECT_EQ(written(), (std::vector<std::string>{"a.glb", "report.json"}));
  const Glb file(out("a.glb"));
  EXPECT_EQ(file.json["meshes"].size(), 7u);
  for (const char* path : {"translation", "rotation", "scale"}) EXPECT_TRUE(file.keys("floor", path).empty());
  EXPECT_EQ(file.keys("mover", "translation").size(), 15u);
  EXPECT_EQ(file.keys("mover", "rotation").size(), 20u);
  EXPECT_TRUE(file.keys("mover", "scale").empty());
  for (int i = 0; i < 5; ++i) {
    const std::vector<float> scales = file.keys("ball " + std::to_string(i + 1), "scale");
    ASSERT_EQ(scales.size(), 15u);
    for (int k = 0; k < 15; ++k) EXPECT_EQ(scales[k], k / 3 == i ? 1.0f : 0.0f);
  }
  ASSERT_EQ(output["parts"].size(), 7u);
  ASSERT_EQ(output["frames"].size(), 5u);
  for (int i = 0; i < 5; ++i) {
    const Json& frame = output["frames"][i];
    EXPECT_EQ(frame["time"], i / 4.0);
    EXPECT_EQ(frame["meshes"].size(), 3u);
    EXPECT_EQ(output["parts"][frame["meshes"]["mover"].get<int>()]["name"], "mover");
    EXPECT_EQ(output["parts"][frame["meshes"]["ball"].get<int>()]["name"], "ball " + std::to_string(i + 1));
  }
}

TEST_F(Animate, WhatMovesLiesOnTheSurfaceOfEachFrame) {
  expectSuccess(run(animated(kScene, 9)));
  const Glb file(out("a.glb"));
  const std::vector<glm::vec3> mesh = file.positions("mover");
  const std::vector<float> at = file.keys("mover", "translation"), turn = file.keys("mover", "rotation");
  ASSERT_EQ(at.size(), 27u);
  double first = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const Scene then =
        runScene(kScene, "test.lua", {.time = static_cast<double>(i) / 4.0, .fixed = true}).value();
    const Tape distance({&then.parts[1].shape.distance, 1});
    const glm::dquat q(turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]);
    const glm::dvec3 t(at[3 * i], at[3 * i + 1], at[3 * i + 2]);
    double farthest = 0.0;
    for (const glm::vec3& p : mesh)
      farthest = std::max(farthest, std::abs(evaluate(distance, glm::normalize(q) * glm::dvec3(p) + t)));
    if (i == 0) first = farthest;
    // As far as where it was meshed, but for the rounding of keys and of points no farther out than 4, three
    // times.
    EXPECT_LE(farthest, first + 3 * 3 * 4 * 0x1p-24) << "frame " << i;
  }
  EXPECT_LT(first, 0.08) << "a voxel";
}

TEST_F(Animate, AShapeThatComesBackIsMeshedOnce) {
  const std::string blinking = scene(
      "part('lamp', sphere(0.5)) if value(time) % 0.5 < 0.1 then part('beam', box(1, 0.1, 0.1):translate(2, "
      "0, 0)) end");
  const Json output = report({blinking, "-o", out("a.glb"), "--animate", "--frames", "4", "--fps", "4",
                              "--voxel-size", "0.1"})["outputs"][0];
  EXPECT_EQ(output["parts"].size(), 2u);
  EXPECT_TRUE(output["frames"][0]["meshes"].contains("beam"));
  EXPECT_FALSE(output["frames"][1]["meshes"].contains("beam"));
  EXPECT_EQ(Glb(out("a.glb")).keys("beam", "scale"),
            (std::vector<float>{1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0}));
}

TEST_F(Animate, WhatMovesThroughTheBoundsIsCutAnewInEachFrame) {
  const std::string text = "bounds({-1, -1, -1}, {1, 1, 1}) return sphere(0.5):translate(0.4 * time, 0, 0)";
  const Json output = report({scene(text), "-o", out("a.glb"), "--animate", "--frames", "3", "--fps", "1",
                              "--voxel-size", "0.1"})["outputs"][0];
  // At 0 and 1 the ball is within; at 2 it is cut.
  EXPECT_EQ(output["parts"].size(), 2u);
  EXPECT_EQ(output["frames"][1]["meshes"]["part 1"], 0);
  EXPECT_EQ(output["frames"][2]["meshes"]["part 1"], 1);
}

TEST_F(Animate, BeginsAtTheTimeAskedForAndKeysBeginAtZero) {
  std::vector<std::string> words = animated(kScene, 3);
  words.insert(words.end(), {"-t", "2"});
  const Json output = report(words)["outputs"][0];
  EXPECT_EQ(output["frames"][2]["time"], 2.5);
  const Glb file(out("a.glb"));
  const Json& sampler = file.json["animations"][0]["samplers"][0];
  EXPECT_EQ(file.floats(sampler["input"]), (std::vector<float>{0.0f, 0.25f, 0.5f}));
}

TEST_F(Animate, WarnsOfWhatCannotBeAnimated) {
  const std::string fading = scene(
      "camera { from = {0, 0, 5}, fov = 40 + time } directional_light { intensity = 1 + time }"
      "ambient_occlusion { kind = 'taps' } return sphere(0.5):translate(time, 0, 0)");
  const Outcome outcome = run({fading, "-o", out("a.glb"), "--animate", "--bake", "--frames", "2", "--fps",
                               "1", "--voxel-size", "0.1"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(
      outcome.err,
      "sdf2gltf: warning: the camera's field of view changes; the file has that of the first frame\n"
      "sdf2gltf: warning: light 1 changes its colour or intensity; the file has those of the first frame\n"
      "sdf2gltf: warning: --bake: each mesh has the light of the frame in which it is first seen; it does "
      "not "
      "follow what changes later\n");
}

TEST_F(Animate, WarnsOfAmbientLightThatChanges) {
  const auto told = [&](const std::string& ambient) {
    const std::string file = scene("ambient(" + ambient + ") return sphere(0.5)");
    return run({file, "-o", out("a.glb"), "--animate", "--bake", "--frames", "2", "--fps", "1",
                "--voxel-size", "0.1"})
        .err;
  };
  EXPECT_NE(told("0.1 + time").find("--bake: each mesh has the light of the frame"), std::string::npos);
  EXPECT_EQ(told("0.1"), "");
}

TEST_F(Animate, WarnsOfTheBackgroundsLightOnWhatMoves) {
  const auto told = [&](const std::string& settings, const std::string& ball) {
    const std::string file = scene("background(vertical_gradient(0, 1)) " + settings + " return " + ball);
    return run({file, "-o", out("a.glb"), "--animate", "--bake", "--frames", "2", "--fps", "1",
                "--voxel-size", "0.1"})
        .err;
  };
  const std::string still = "sphere(0.5)", turning = "box(0.5):rotate(90 * time, 0, 0)";
  const char* const rests = "--bake: each mesh has the light of the frame";
  EXPECT_EQ(told("background_light(1)", still), "");
  EXPECT_NE(told("background_light(1)", turning).find(rests), std::string::npos);
  EXPECT_NE(told("background_light(0.1 + time)", still).find(rests), std::string::npos);
  EXPECT_EQ(told("ambient(1)", turning), "");
}

TEST_F(Animate, GivesTheSameBytesForAnyNumberOfThreads) {
  std::vector<std::string> bytes;
  for (const char* threads : {"1", "3"}) {
    std::vector<std::string> words = animated(kScene, 3);
    words.insert(words.end(), {"--bake", "--threads", threads});
    expectSuccess(run(words));
    bytes.push_back(contents(out("a.glb")));
  }
  EXPECT_TRUE(bytes[0] == bytes[1]);
}

TEST_F(Animate, ALaterFrameThatFailsLeavesNoFile) {
  const std::string failing = "if value(time) > 0.3 then error('too late') end return sphere(1)";
  const Outcome outcome = run(animated(failing, 3));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("too late"), std::string::npos);
  EXPECT_EQ(written(), std::vector<std::string>{});
}

}  // namespace animate_test
}  // namespace sdf
