// Files are read back with tinygltf's loader and, in validator_test.cpp, by Khronos' validator.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "gltf/read_back.h"
#include "sdf/export/export.h"
#include "sdf/gltf/primitive.h"
#include "support/folder.h"
#include "synthetic.h"

namespace sdf {
namespace gltf_test {

std::vector<glm::vec3> cornersOf(const Mesh& mesh, std::uint32_t material) {
  std::vector<glm::vec3> out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangleMaterial[t] != material) continue;
    for (int k = 0; k < 3; ++k) out.push_back(mesh.positions[mesh.triangles[t][k]]);
  }
  return out;
}

TEST(Gltf, ReadsBackTheTrianglesOfEveryPartAndMaterial) {
  const Folder folder;
  const Mesh one = twoColoredSphere(5, 7), two = sphere(4, 6, {3.0f, 0.0f, 0.0f});
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("left", one), part("right", two)}));
    const tinygltf::Model model = load(folder / name);
    ASSERT_EQ(model.meshes.size(), 2u);
    ASSERT_EQ(model.meshes[0].primitives.size(), 2u);
    EXPECT_EQ(corners(model, model.meshes[0].primitives[0]), cornersOf(one, 0));
    EXPECT_EQ(corners(model, model.meshes[0].primitives[1]), cornersOf(one, 1));
    ASSERT_EQ(model.meshes[1].primitives.size(), 1u);
    EXPECT_EQ(corners(model, model.meshes[1].primitives[0]), cornersOf(two, 0));
  }
}

TEST(Gltf, GivesEachPartANodeOfItsName) {
  const Folder folder;
  ASSERT_TRUE(
      writeMeshes(folder / "a.glb", Scene{}, {part("left", sphere(3, 4)), part("right", sphere(3, 4))}));
  const tinygltf::Model model = load(folder / "a.glb");
  ASSERT_EQ(model.scenes.size(), 1u);
  ASSERT_GE(model.scenes[0].nodes.size(), 2u);
  const tinygltf::Node& left = model.nodes.at(model.scenes[0].nodes[0]);
  const tinygltf::Node& right = model.nodes.at(model.scenes[0].nodes[1]);
  EXPECT_EQ(left.name, "left");
  EXPECT_EQ(right.name, "right");
  EXPECT_NE(left.mesh, right.mesh);
}

TEST(Gltf, EachVertexIsUsedByOnePrimitive) {
  const Folder folder;
  const Mesh mesh = twoColoredSphere(20, 20);
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
  const tinygltf::Model model = load(folder / "a.glb");
  const auto& primitives = model.meshes[0].primitives;
  ASSERT_EQ(primitives.size(), 2u);
  EXPECT_EQ(primitives[0].attributes, primitives[1].attributes);
  const std::size_t count = model.accessors.at(primitives[0].attributes.at("POSITION")).count;
  std::vector<int> users(count, 0);
  for (const tinygltf::Primitive& primitive : primitives) {
    const std::vector<std::uint32_t> all = indices(model, primitive);
    for (const std::uint32_t i : std::set(all.begin(), all.end())) ++users.at(i);
  }
  EXPECT_EQ(users, std::vector<int>(count, 1));
  // First copies of vertices that only the second material uses are gone.
  EXPECT_LT(count, mesh.positions.size());
}

TEST(Gltf, ColoursThatVaryInOneMaterialLeaveTheOthersAlone) {
  const Folder folder;
  Mesh mesh = twoColoredSphere(6, 6);
  for (std::size_t i = mesh.welded; i < mesh.colors.size(); ++i) mesh.colors[i].y = (i % 2) ? 0.5f : 0.0f;
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
  const tinygltf::Model model = load(folder / "a.glb");
  const auto& primitives = model.meshes[0].primitives;
  EXPECT_EQ(primitives[0].attributes.count("COLOR_0"), 0u);
  EXPECT_EQ(model.materials.at(primitives[0].material).pbrMetallicRoughness.baseColorFactor,
            (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
  const auto colors = elements<glm::vec<4, std::uint16_t>>(model, primitives[1].attributes.at("COLOR_0"));
  for (const std::uint32_t i : indices(model, primitives[1])) {
    EXPECT_EQ(colors.at(i).x, 65535);
    EXPECT_TRUE(colors[i].y == 0 || colors[i].y == 32768);
  }
}

TEST(Gltf, IndicesAreSixteenBitsUpToTheRestartValueAndThirtyTwoBeyond) {
  const Folder folder;
  const auto componentType = [&](int rows, int columns) {
    const Mesh mesh = sphere(rows, columns);
    EXPECT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
    const tinygltf::Model model = load(folder / "a.glb");
    const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
    EXPECT_EQ(corners(model, primitive), cornersOf(mesh, 0));
    return model.accessors.at(primitive.indices).componentType;
  };
  EXPECT_EQ(componentType(13, 5041),
            TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);  // 65,535: the last index is 65534
  EXPECT_EQ(componentType(2, 32767), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);  // 65,536
  EXPECT_EQ(componentType(300, 300), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

TEST(Gltf, PositionBoundsAreThoseOfTheVertices) {
  const Folder folder;
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", sphere(31, 64, {-5.0f, 2.0f, 1.0f}))}));
  const tinygltf::Model model = load(folder / "a.glb");
  const tinygltf::Accessor& accessor =
      model.accessors.at(model.meshes[0].primitives[0].attributes.at("POSITION"));
  EXPECT_EQ(accessor.minValues, (std::vector<double>{-6.0, 1.0, 0.0}));
  EXPECT_EQ(accessor.maxValues, (std::vector<double>{-4.0, 3.0, 2.0}));
}

TEST(Gltf, NormalsAreUnitEvenWhereTheMeshHasNone) {
  const Folder folder;
  Mesh mesh = sphere(3, 4);
  mesh.normals[0] = glm::vec3(0.0f);
  mesh.normals[1] = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  mesh.normals[2] = glm::vec3(3e-30f, 0.0f, 0.0f);
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
  const tinygltf::Model model = load(folder / "a.glb");
  for (const glm::vec3& n :
       elements<glm::vec3>(model, model.meshes[0].primitives[0].attributes.at("NORMAL"))) {
    // Three components rounded to float: each is off by half an ulp, at most 2^-25 of one.
    EXPECT_NEAR(glm::length(glm::dvec3(n)), 1.0, 3 * std::numeric_limits<float>::epsilon() / 4);
  }
}

TEST(Gltf, AConstantColourBecomesTheMaterialsFactor) {
  const Folder folder;
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", sphere(3, 4))}));
  const tinygltf::Model model = load(folder / "a.glb");
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  EXPECT_EQ(primitive.attributes.count("COLOR_0"), 0u);
  EXPECT_EQ(model.materials.at(primitive.material).pbrMetallicRoughness.baseColorFactor,
            (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

TEST(Gltf, VaryingColoursAreSixteenBitLinearVertexColours) {
  const Folder folder;
  Mesh mesh = sphere(3, 4);
  for (std::size_t i = 0; i < mesh.colors.size(); ++i)
    mesh.colors[i] = glm::vec3(static_cast<float>(i) / 16, 0, 1);
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
  const tinygltf::Model model = load(folder / "a.glb");
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  const int index = primitive.attributes.at("COLOR_0");
  EXPECT_TRUE(model.accessors.at(index).normalized);
  EXPECT_EQ(model.accessors.at(index).type, TINYGLTF_TYPE_VEC3);
  EXPECT_EQ(model.materials.at(primitive.material).pbrMetallicRoughness.baseColorFactor,
            (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
  const auto colors = elements<glm::vec<4, std::uint16_t>>(model, index);
  const std::vector<std::uint32_t> order = splitByMaterial(mesh)[0].vertices;
  ASSERT_EQ(colors.size(), order.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    EXPECT_NEAR(colors[i].x / 65535.0, mesh.colors[order[i]].x, 0.5 / 65535.0);
    EXPECT_EQ(colors[i].z, 65535);
  }
}

TEST(Gltf, PartsInOneMaterialShareIt) {
  const Folder folder;
  ASSERT_TRUE(
      writeMeshes(folder / "a.glb", Scene{}, {part("a", twoColoredSphere(3, 4)), part("b", sphere(3, 4))}));
  EXPECT_EQ(load(folder / "a.glb").materials.size(), 2u);
}

TEST(Gltf, BrightEmissionUsesItsExtension) {
  const Folder folder;
  Mesh mesh = sphere(3, 4);
  mesh.materials[0].emission = glm::vec3(4.0f, 2.0f, 0.0f);
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part("p", mesh)}));
  const tinygltf::Model model = load(folder / "a.glb");
  EXPECT_EQ(model.materials[0].emissiveFactor, (std::vector<double>{1.0, 0.5, 0.0}));
  const auto& extension = model.materials[0].extensions.at("KHR_materials_emissive_strength");
  EXPECT_EQ(extension.Get("emissiveStrength").GetNumberAsDouble(), 4.0);
  EXPECT_EQ(model.extensionsUsed,
            (std::vector<std::string>{"KHR_materials_emissive_strength", "EXT_mesh_manifold"}));
}

TEST(Gltf, CarriesCameraAndLights) {
  const Folder folder;
  Scene scene;
  scene.camera.mirrored = true;
  scene.lights = {Light{}, Light{.kind = Light::Kind::Point, .vector = Vec3E(1.0, 2.0, 3.0)}};
  ASSERT_TRUE(writeMeshes(folder / "a.glb", scene, {part("p", sphere(3, 4))}));
  const tinygltf::Model model = load(folder / "a.glb");
  ASSERT_EQ(model.cameras.size(), 1u);
  EXPECT_EQ(model.cameras[0].type, "perspective");
  ASSERT_EQ(model.nodes.size(), 4u);
  EXPECT_EQ(model.nodes[1].camera, 0);
  EXPECT_TRUE(model.nodes[1].extras.Get("mirrored").Get<bool>());
  ASSERT_EQ(model.lights.size(), 2u);
  EXPECT_EQ(model.lights[0].type, "directional");
  EXPECT_EQ(model.lights[1].type, "point");
  EXPECT_EQ(model.nodes[3].translation, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(model.nodes[3].extensions.at("KHR_lights_punctual").Get("light").GetNumberAsInt(), 1);
}

TEST(Gltf, TellsTheMeasuredErrorOfEachPartAndOfAll) {
  const Folder folder;
  ExportPart coarse = part("coarse", sphere(3, 4)), fine = part("fine", sphere(3, 4));
  fine.stats.maxDistance = 0.375;
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {coarse, fine}));
  const tinygltf::Model model = load(folder / "a.glb");
  EXPECT_EQ(model.nodes[1].extras.Get("maxDistance").GetNumberAsDouble(), 0.375);
  EXPECT_EQ(model.nodes[1].extras.Get("rmsDistance").GetNumberAsDouble(), 0.25);
  EXPECT_EQ(model.nodes[1].extras.Get("voxelSize").GetNumberAsDouble(), 0.125);
  EXPECT_EQ(model.asset.extras.Get("maxDistance").GetNumberAsDouble(), 0.5);
  EXPECT_EQ(model.asset.generator.substr(0, 7), "libsdf ");
}

TEST(Gltf, NamesThatAreNotTextStayReadable) {
  const Folder folder;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"Gr\xC3\xBC\xC3\x9F", "Gr\xC3\xBC\xC3\x9F"},
      {"\xF0\x9F\x90\x8C", "\xF0\x9F\x90\x8C"},
      {"a\xFFz", "a\xEF\xBF\xBDz"},
      {"cut\xC3", "cut\xEF\xBF\xBD"},
      {"\xC0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD"},
      {"\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"},
      {"quote\"\\\n", "quote\"\\\n"},
  };
  for (const auto& [name, expected] : cases) {
    ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {part(name, sphere(3, 4))}));
    EXPECT_EQ(load(folder / "a.glb").nodes[0].name, expected);
  }
}

TEST(Gltf, WritesTheSameBytesEachTime) {
  const Folder folder;
  Scene scene;
  scene.lights = {Light{}};
  for (const char* extension : {"glb", "gltf", "stl", "ply", "obj"}) {
    const auto one = folder / (std::string("one.") + extension),
               two = folder / (std::string("two.") + extension);
    ASSERT_TRUE(writeMeshes(one, scene, {part("p", twoColoredSphere(9, 9))}));
    ASSERT_TRUE(writeMeshes(two, scene, {part("p", twoColoredSphere(9, 9))}));
    EXPECT_EQ(contents(one), contents(two)) << extension;
    EXPECT_FALSE(contents(one).empty());
  }
}

}  // namespace gltf_test
}  // namespace sdf
