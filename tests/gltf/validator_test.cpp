// Khronos' glTF validator over files of every kind; see validate.js.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>

#include "gltf/decoded.h"
#include "sdf/export/compress.h"
#include "sdf/gltf/animation.h"
#include "support/folder.h"
#include "synthetic.h"

namespace sdf {
namespace validator_test {

/// What the validator prints about the file: its errors and warnings.
std::string complaints(const std::filesystem::path& file) {
  const std::string command = "node '" SDF_SOURCE_DIR "/tests/gltf/validate.js' '" SDF_VALIDATOR_MODULES
                              "' '" +
                              file.string() + "' 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string out;
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    out.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  return status == 0 ? "" : out + "(status " + std::to_string(status) + ")";
}

std::string complaints(const std::string& extension, const Scene& scene,
                       const std::vector<ExportPart>& parts) {
  const Folder folder;
  const auto file = folder / ("a" + extension);
  const Status status = writeMeshes(file, scene, parts);
  return status ? complaints(file) : status.error().message;
}

Scene litScene() {
  Scene scene;
  scene.lights = {
      Light{},
      Light{.kind = Light::Kind::Point, .vector = Vec3E(1.0, 2.0, 3.0), .color = Vec3E(3.0, 1.0, 0.0)}};
  return scene;
}

TEST(Validator, AcceptsPartsWithMaterialsCameraAndLights) {
  Mesh glowing = twoColoredSphere(9, 9);
  glowing.materials[0].emission = {5.0f, 1.0f, 0.0f};
  glowing.materials[1].specular = {1.0f, 0.8f, 0.2f};
  for (std::size_t i = 0; i < glowing.colors.size(); ++i) glowing.colors[i].x = static_cast<float>(i % 7) / 6;
  const std::vector<ExportPart> parts = {part("one", glowing), part("two", sphere(5, 5))};
  EXPECT_EQ(complaints(".glb", litScene(), parts), "");
  EXPECT_EQ(complaints(".gltf", litScene(), parts), "");
}

TEST(Validator, AcceptsAnOddNumberOfShortIndices) {
  EXPECT_EQ(complaints(".glb", Scene{}, {part("p", twoColoredSphere(1, 3)), part("q", sphere(1, 3))}), "");
}

TEST(Validator, AcceptsMoreVerticesThanSixteenBitsCount) {
  EXPECT_EQ(complaints(".glb", Scene{}, {part("p", sphere(300, 300))}), "");
}

TEST(Validator, AcceptsExactlyAsManyVerticesAsSixteenBitsCount) {
  EXPECT_EQ(complaints(".glb", Scene{}, {part("p", sphere(13, 5041))}), "");
}

TEST(Validator, AcceptsWhatIsMadeOfBrokenNormalsColoursAndNames) {
  Mesh mesh = sphere(3, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.normals[0] = glm::vec3(0.0f);
  mesh.normals[1] = glm::vec3(nan);
  mesh.colors[2] = {nan, 7.0f, -1.0f};
  mesh.materials[0].name = "\xFF";
  mesh.materials[0].shininess = nan;
  EXPECT_EQ(complaints(".glb", Scene{}, {part("\xC3", mesh)}), "");
}

TEST(Validator, AcceptsBakedLight) {
  const auto lit = [](Mesh mesh) {
    ExportPart lit = part("lit", std::move(mesh));
    lit.ambient.emplace(AmbientLight{glm::vec3(0.5f), {}, 0.0f});
    for (const glm::vec3& p : lit.mesh.positions) {
      lit.mesh.ambient.push_back({1.0f, 0.5f + 0.5f * p.x, 0.0f});
      lit.ambient->occlusion.push_back(0.5f + 0.5f * p.y);
    }
    return lit;
  };
  Mesh glowing = twoColoredSphere(5, 5);
  glowing.materials[0].emission = {5.0f, 1.0f, 0.0f};
  const std::vector<ExportPart> parts{lit(glowing), lit(sphere(4, 4)), lit(sphere(1, 3))};
  EXPECT_EQ(complaints(".glb", litScene(), parts), "");
  EXPECT_EQ(complaints(".gltf", litScene(), parts), "");
}

TEST(Validator, AcceptsAnimations) {
  const std::vector<double> times{0.0, 0.5};
  Animation animation{times, {litScene(), litScene()}, {}};
  animation.scenes[1].camera.from = Vec3E(1.0, 2.0, 3.0);
  animation.scenes[1].lights[1].vector = Vec3E(1.0, 2.0, 4.0);
  const RigidMotion moved{glm::angleAxis(3.0, glm::dvec3(0.6, 0.0, 0.8)), {1.0, 2.0, 3.0}};
  animation.parts.push_back({"moving", {{part("moving", sphere(3, 4)), {RigidMotion{}, moved}}}});
  animation.parts.push_back({"changing",
                             {{part("changing", sphere(3, 4)), {RigidMotion{}, std::nullopt}},
                              {part("changing", twoColoredSphere(3, 5)), {std::nullopt, moved}}}});
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Folder folder;
    ASSERT_TRUE(writeAnimation(folder / name, animation));
    EXPECT_EQ(complaints(folder / name), "");
  }
  animation.times = {2.0};
  animation.scenes.resize(1);
  animation.parts[1].meshes.resize(1);
  for (AnimatedPart& part : animation.parts) part.meshes[0].motions.resize(1);
  const Folder folder;
  ASSERT_TRUE(writeAnimation(folder / "a.glb", animation));
  EXPECT_EQ(complaints(folder / "a.glb"), "") << "one frame";
}

/// It knows KHR_mesh_quantization, but not what is compressed: that it reads once it is decoded.
TEST(Validator, AcceptsCompressedFiles) {
  Mesh colored = twoColoredSphere(9, 9);
  for (std::size_t i = 0; i < colored.colors.size(); ++i) colored.colors[i].x = static_cast<float>(i % 7) / 6;
  std::vector<ExportPart> parts = {part("one", colored), part("two", sphere(5, 5)),
                                   part("three", sphere(1, 3))};
  for (ExportPart& part : parts) compress(part);
  for (const char* name : {"a.glb", "a.gltf"}) {
    const Folder folder;
    ASSERT_TRUE(writeMeshes(folder / name, litScene(), parts));
    EXPECT_EQ(complaints(folder / name), "");
    writeDecoded(folder / name, folder / "decoded.glb");
    EXPECT_EQ(complaints(folder / "decoded.glb"), "");
  }
}

TEST(Validator, AcceptsAPartWithoutTriangles) {
  EXPECT_EQ(complaints(".glb", Scene{}, {part("empty", Mesh{})}), "");
  EXPECT_EQ(complaints(".gltf", litScene(), {part("empty", Mesh{}), part("full", sphere(3, 4))}), "");
}

TEST(Validator, WouldComplainOfABrokenFile) {
  const Folder folder;
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", sphere(3, 4))}));
  std::string bytes = contents(folder / "a.glb");
  bytes.replace(bytes.size() - 8, 8, 8, '\xFF');  // the last index pairs or normals
  std::ofstream(folder / "a.glb", std::ios::binary) << bytes;
  EXPECT_NE(complaints(folder / "a.glb"), "");
}

}  // namespace validator_test
}  // namespace sdf
