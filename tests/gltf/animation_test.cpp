#include "sdf/gltf/animation.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "gltf/read_back.h"
#include "gltf/synthetic.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "support/folder.h"

namespace sdf {
namespace animation_test {

constexpr std::size_t kFrames = 4;

AnimatedMesh still(ExportPart part) { return {std::move(part), {kFrames, RigidMotion{}}}; }

/// Of the mesh that moves.
const glm::vec3 kMiddle(3.0f, 1.0f, 0.0f);

glm::dquat aboutY(double angle) { return glm::angleAxis(angle, glm::dvec3(0.0, 1.0, 0.0)); }

/// Four frames of half a second, from time 1: a part that rests, one that moves and turns, and one of two
/// shapes.
Animation example() {
  Animation animation{{1.0, 1.5, 2.0, 2.5}, std::vector<Scene>(kFrames), {}};
  AnimatedMesh moving = still(part("moving", sphere(3, 4, kMiddle)));
  for (std::size_t i = 0; i < kFrames; ++i)
    moving.motions[i] = {aboutY(2.0 * static_cast<double>(i)), {1.0 * i, 0.0, -1.0}};
  AnimatedMesh first = still(part("changing", sphere(3, 4))), second = still(part("changing", sphere(4, 5)));
  first.motions[2] = first.motions[3] = second.motions[0] = second.motions[1] = std::nullopt;
  second.motions[3]->translation.y = 2.0;
  animation.parts.push_back({"resting", {still(part("resting", sphere(3, 4)))}});
  animation.parts.push_back({"moving", {std::move(moving)}});
  animation.parts.push_back({"changing", {std::move(first), std::move(second)}});
  return animation;
}

tinygltf::Model writtenAs(const std::string& name, const Animation& animation) {
  const Folder folder;
  const Status status = writeAnimation(folder / name, animation);
  EXPECT_TRUE(status) << status.error().message;
  return load(folder / name);
}

int nodeOf(const tinygltf::Model& model, const std::string& name) {
  const auto node = std::ranges::find(model.nodes, name, &tinygltf::Node::name);
  EXPECT_NE(node, model.nodes.end()) << name;
  return static_cast<int>(node - model.nodes.begin());
}

/// The keys of a node's property; empty where it has none.
template <class T>
std::vector<T> keysOf(const tinygltf::Model& model, const std::string& node, const std::string& path,
                      const std::string& interpolation) {
  if (model.animations.empty()) return {};
  const tinygltf::Animation& animation = model.animations[0];
  for (const tinygltf::AnimationChannel& channel : animation.channels)
    if (channel.target_node == nodeOf(model, node) && channel.target_path == path) {
      const tinygltf::AnimationSampler& sampler = animation.samplers.at(channel.sampler);
      EXPECT_EQ(sampler.interpolation, interpolation);
      EXPECT_EQ(elements<float>(model, sampler.input), (std::vector<float>{0.0f, 0.5f, 1.0f, 1.5f}));
      return elements<T>(model, sampler.output);
    }
  return {};
}

std::vector<glm::vec3> translations(const tinygltf::Model& model, const std::string& node) {
  return keysOf<glm::vec3>(model, node, "translation", "LINEAR");
}
std::vector<glm::vec4> rotations(const tinygltf::Model& model, const std::string& node) {
  return keysOf<glm::vec4>(model, node, "rotation", "LINEAR");
}
std::vector<glm::vec3> scales(const tinygltf::Model& model, const std::string& node) {
  return keysOf<glm::vec3>(model, node, "scale", "STEP");
}

TEST(Animation, APartThatRestsHasNoKeys) {
  const tinygltf::Model model = writtenAs("a.glb", example());
  EXPECT_TRUE(translations(model, "resting").empty());
  EXPECT_TRUE(rotations(model, "resting").empty());
  EXPECT_TRUE(scales(model, "resting").empty());
}

TEST(Animation, APartThatMovesHasOneMeshAndAKeyForEachFrame) {
  for (const char* name : {"a.glb", "a.gltf"}) {
    const tinygltf::Model model = writtenAs(name, example());
    ASSERT_EQ(model.animations.size(), 1u);
    const auto moved = translations(model, "moving");
    const auto turned = rotations(model, "moving");
    ASSERT_EQ(moved.size(), kFrames);
    ASSERT_EQ(turned.size(), kFrames);
    for (std::size_t i = 0; i < kFrames; ++i) {
      const RigidMotion motion{aboutY(2.0 * static_cast<double>(i)), {1.0 * i, 0.0, -1.0}};
      EXPECT_LT(glm::distance(moved[i], glm::vec3(motion(glm::dvec3(kMiddle)))), 8 * 0x1p-23f)
          << "of some units";
      const glm::dquat meant = aboutY(2.0 * static_cast<double>(i));
      // Either of the two quaternions of one turn, in float.
      const double cosine = glm::dot(glm::dvec4(turned[i]), glm::dvec4(meant.x, meant.y, meant.z, meant.w));
      EXPECT_NEAR(std::abs(cosine), 1.0, 4 * 0x1p-24);
      if (i > 0) {
        EXPECT_GE(glm::dot(turned[i], turned[i - 1]), 0.0f) << "the shorter way";
      }
    }
    EXPECT_TRUE(scales(model, "moving").empty());
    const tinygltf::Node& node = model.nodes[nodeOf(model, "moving")];
    ASSERT_EQ(node.children.size(), 1u);
    const tinygltf::Node& held = model.nodes[node.children[0]];
    EXPECT_GE(held.mesh, 0);
    EXPECT_EQ(held.translation, (std::vector<double>{-3, -1, 0})) << "it turns about its middle";
    EXPECT_EQ(node.translation, (std::vector<double>{3, 1, -1})) << "as in the first frame";
  }
}

TEST(Animation, APartThatChangesHasAMeshForEachShapeOfWhichOneIsThere) {
  const tinygltf::Model model = writtenAs("a.glb", example());
  const tinygltf::Node& parent = model.nodes[nodeOf(model, "changing")];
  EXPECT_EQ(parent.mesh, -1);
  EXPECT_EQ(parent.children, (std::vector<int>{nodeOf(model, "changing 1"), nodeOf(model, "changing 2")}));
  for (const int child : parent.children)
    EXPECT_EQ(std::ranges::count(model.scenes[0].nodes, child), 0) << "a child is no root";
  const glm::vec3 here(1.0f), gone(0.0f);
  EXPECT_EQ(scales(model, "changing 1"), (std::vector{here, here, gone, gone}));
  EXPECT_EQ(scales(model, "changing 2"), (std::vector{gone, gone, here, here}));
  EXPECT_EQ(model.nodes[nodeOf(model, "changing 2")].scale, (std::vector<double>{0, 0, 0}));
  EXPECT_TRUE(model.nodes[nodeOf(model, "changing 1")].scale.empty());
  EXPECT_EQ(translations(model, "changing 2").back(), glm::vec3(0, 2, 0));
}

TEST(Animation, ASceneThatRestsHasNone) {
  Animation animation{{0.0, 1.0, 2.0, 3.0}, std::vector<Scene>(kFrames), {}};
  animation.parts.push_back({"resting", {still(part("resting", sphere(3, 4)))}});
  EXPECT_TRUE(writtenAs("a.glb", animation).animations.empty());
  EXPECT_FALSE(moves(animation));
  EXPECT_TRUE(moves(example()));
}

TEST(Animation, TheCameraAndLightsMove) {
  Animation animation = example();
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double t = static_cast<double>(i);
    animation.scenes[i].camera.from = Vec3E(5.0 * std::sin(t), 1.0, 5.0 * std::cos(t));
    animation.scenes[i].lights = {Light{.vector = Vec3E(1.0, t, 0.0)}, Light{.vector = Vec3E(1.0, 1.0, 0.0)}};
  }
  const tinygltf::Model model = writtenAs("a.glb", animation);
  const auto eyes = translations(model, "camera");
  ASSERT_EQ(eyes.size(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i)
    EXPECT_LT(glm::distance(eyes[i], glm::vec3(5.0 * std::sin(i), 1.0, 5.0 * std::cos(i))), 1e-6f);
  EXPECT_EQ(rotations(model, "camera").size(), kFrames);
  EXPECT_EQ(rotations(model, "light 1").size(), kFrames);
  EXPECT_TRUE(rotations(model, "light 2").empty());
  EXPECT_EQ(notAnimated(animation), std::vector<std::string>{});
}

TEST(Animation, AnOpenCameraSeesAllFrames) {
  Animation animation = example();
  for (std::size_t i = 0; i < kFrames; ++i)
    animation.scenes[i].add("ball", translate(sphere(1.0), {static_cast<double>(i), 0.0, 0.0}));
  const tinygltf::Model model = writtenAs("a.glb", animation);
  EXPECT_TRUE(translations(model, "camera").empty());
  Scene all;
  all.add("all", translate(box({2.5, 1.0, 1.0}), {1.5, 0.0, 0.0}));
  const Folder folder;
  ASSERT_TRUE(writeMeshes(folder / "b.glb", all, {part("all", sphere(3, 4))}));
  const tinygltf::Model fitted = load(folder / "b.glb");
  EXPECT_EQ(model.nodes[nodeOf(model, "camera")].translation,
            fitted.nodes[nodeOf(fitted, "camera")].translation);
}

TEST(Animation, SaysWhatCannotBeAnimated) {
  const auto linesOf = [](auto change) {
    Animation animation = example();
    for (Scene& scene : animation.scenes) {
      scene.camera.from = Vec3E(0.0, 0.0, 5.0);
      scene.lights = {Light{.kind = Light::Kind::Point, .vector = Vec3E(1.0, 2.0, 3.0)}};
    }
    change(animation.scenes.back());
    writtenAs("a.glb", animation);
    std::string lines;
    for (const std::string& line : notAnimated(animation)) lines += line + "\n";
    return lines;
  };
  EXPECT_EQ(linesOf([](Scene&) {}), "");
  EXPECT_EQ(linesOf([](Scene& s) { s.camera.fov = 20.0; }),
            "the camera's field of view changes; the file has that of the first frame\n");
  EXPECT_EQ(linesOf([](Scene& s) { s.camera.from = s.camera.to; }),
            "the camera is not one at all times; the file has none\n");
  EXPECT_EQ(linesOf([](Scene& s) { s.lights[0].intensity = 0.0; }),
            "light 1 changes its colour or intensity; the file has those of the first frame\n");
  EXPECT_EQ(
      linesOf([](Scene& s) { s.lights[0].vector = Vec3E(1.0, 2.0, 4.0); }),
      "light 1 moves; its candela agree with the scene's intensity where it stands in the first frame\n");
  EXPECT_EQ(linesOf([](Scene& s) { s.lights.emplace_back(); }),
            "lights come, go or change their kind; the file has those of the first frame, at rest\n");
}

TEST(Animation, OnlyGltfFilesHoldIt) {
  const Folder folder;
  const Status status = writeAnimation(folder / "a.stl", example());
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::Usage);
  EXPECT_EQ(status.error().message,
            ".stl files hold no animation; write .glb or .gltf, or a file for each frame");
  EXPECT_TRUE(folder.empty());
}

}  // namespace animation_test
}  // namespace sdf
