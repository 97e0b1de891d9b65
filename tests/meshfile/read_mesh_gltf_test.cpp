// glTF files made by hand: what our own writer does not write.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "mesh_files.h"
#include "sdf/gltf/glb.h"

namespace sdf {
namespace read_mesh_gltf_test {

using Corners = std::vector<glm::vec3>;
constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;

/// The draft's only triangle as it is read.
Corners cornersIn(GltfDraft& draft, const Folder& folder) {
  return cornersOf(readPlainly(draft.save(folder / "a.gltf")));
}

/// A draft of the unit triangle; node 0 holds it.
GltfDraft triangle() {
  GltfDraft draft;
  draft.node({{"attributes", {{"POSITION", draft.positions(kTriangle)}}}});
  return draft;
}

void expectNear(const Corners& a, const Corners& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT(glm::distance(a[i], b[i]), 1e-6f)  // a few roundings near 1
        << i << ": " << a[i].x << " " << a[i].y << " " << a[i].z;
  }
}

// --- nodes ---

TEST(ReadGltf, PlacesNodesByScaleTurnAndMove) {
  const Folder folder;
  GltfDraft draft = triangle();
  const double half = std::sqrt(0.5);
  draft.json["nodes"][0].update(
      {{"scale", {2, 3, 4}}, {"rotation", {0, 0, half, half}}, {"translation", {5, 6, 7}}});
  expectNear(cornersIn(draft, folder), {{5, 6, 7}, {5, 8, 7}, {2, 6, 7}});
}

TEST(ReadGltf, PlacesNodesByMatricesOfColumns) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.json["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  expectNear(cornersIn(draft, folder), {{5, 6, 7}, {7, 6, 7}, {5, 9, 7}});
}

TEST(ReadGltf, PlacesChildrenInTheirParents) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.json["nodes"].push_back({{"children", {0}}, {"scale", {2, 2, 2}}});
  draft.json["nodes"].push_back({{"children", {1}}, {"translation", {1, 0, 0}}});
  draft.json["nodes"][0]["translation"] = {0, 1, 0};
  expectNear(cornersIn(draft, folder), {{1, 2, 0}, {3, 2, 0}, {1, 4, 0}});
}

TEST(ReadGltf, KeepsMirroredTrianglesFacingOutside) {
  const Folder folder;
  GltfDraft draft;
  const int normals = draft.accessor(Corners(3, glm::vec3(0, 0, 1)), "VEC3", kFloat);
  draft.node({{"attributes", {{"POSITION", draft.positions(kTriangle)}, {"NORMAL", normals}}}});
  draft.json["nodes"][0]["scale"] = {-1, 1, 1};
  TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  expectNear(cornersOf(mesh), {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  draft.json["nodes"][0]["scale"] = {1, 1, -1};  // seen from below now, and so is its normal
  mesh = readPlainly(draft.save(folder / "a.gltf"));
  expectNear(cornersOf(mesh), {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, -1));
}

TEST(ReadGltf, KeepsNormalsUprightWhereScalesDiffer) {
  const Folder folder;
  GltfDraft draft;
  const glm::vec3 slope = glm::normalize(glm::vec3(1, 1, 0));
  const int normals = draft.accessor(Corners(3, slope), "VEC3", kFloat);
  draft.node({{"attributes",
               {{"POSITION", draft.positions({{1, 0, 0}, {0, 1, 0}, {1, 0, 1}})}, {"NORMAL", normals}}}});
  draft.json["nodes"][0]["scale"] = {1, 2, 1};
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  const Corners c = cornersOf(mesh);
  EXPECT_NEAR(glm::dot(mesh.normals[0], glm::normalize(c[1] - c[0])), 0.0f, 1e-6f);
}

TEST(ReadGltf, ReadsTheDefaultSceneOrTheFirstOrAllNodes) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.node({{"attributes", {{"POSITION", 0}}}})["translation"] = {0, 0, 1};
  const auto heights = [&] {
    std::vector<float> out;
    for (const glm::vec3& p : cornersIn(draft, folder))
      if (p.x == 1.0f) out.push_back(p.z);
    return out;
  };
  EXPECT_EQ(heights(), (std::vector<float>{0, 1}));
  draft.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  EXPECT_EQ(heights(), std::vector<float>{0});
  draft.json["scene"] = 1;
  EXPECT_EQ(heights(), std::vector<float>{1});
}

TEST(ReadGltf, RefusesNodesThatAreTwiceThere) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.json["scenes"] = {{{"nodes", {0}}}};
  draft.json["nodes"][0]["children"] = {0};
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "its node 0 is in more than one place");
  draft.json["nodes"][0]["children"] = {7};
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "it has no node 7");
  draft.json["nodes"][0] = {{"mesh", 3}};
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "it has no mesh 3");
}

// --- primitives ---

const Corners kStrip{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};

TEST(ReadGltf, TurnsEveryOtherTriangleOfAStrip) {
  const Folder folder;
  GltfDraft draft;
  draft.node({{"attributes", {{"POSITION", draft.positions(kStrip)}}}, {"mode", 5}});
  const Corners corners = cornersIn(draft, folder);
  ASSERT_EQ(corners.size(), 9u);
  for (std::size_t i = 0; i < 9; i += 3)
    EXPECT_GT(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]).z, 0.0f) << i;
}

TEST(ReadGltf, ReadsFans) {
  const Folder folder;
  GltfDraft draft;
  draft.node({{"attributes", {{"POSITION", draft.positions({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})}}},
              {"mode", 6}});
  EXPECT_EQ(cornersIn(draft, folder),
            (Corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

TEST(ReadGltf, LeavesOutPointsAndLines) {
  const Folder folder;
  GltfDraft draft = triangle();
  for (const int mode : {0, 1, 2, 3}) draft.node({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  const ReadMesh read = readWell(draft.save(folder / "a.gltf"));
  EXPECT_EQ(read.mesh.triangles.size(), 1u);
  EXPECT_EQ(read.warnings, std::vector<std::string>{"points and lines are left out"});
}

template <class T>
Corners indexed(int componentType, const Folder& folder) {
  GltfDraft draft;
  const int indices = draft.accessor(std::vector<T>{1, 2, 3}, "SCALAR", componentType);
  const int positions = draft.positions({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  draft.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  return cornersIn(draft, folder);
}

TEST(ReadGltf, ReadsIndicesOfEverySize) {
  const Folder folder;
  EXPECT_EQ(indexed<std::uint8_t>(kUnsignedByte, folder), kTriangle);
  EXPECT_EQ(indexed<std::uint16_t>(kUnsignedShort, folder), kTriangle);
  EXPECT_EQ(indexed<std::uint32_t>(kUnsignedInt, folder), kTriangle);
}

TEST(ReadGltf, SharesVerticesBetweenPrimitives) {
  const Folder folder;
  GltfDraft draft;
  const int positions = draft.positions(kStrip);
  const int one = draft.accessor(std::vector<std::uint8_t>{0, 1, 2}, "SCALAR", kUnsignedByte);
  const int two = draft.accessor(std::vector<std::uint8_t>{2, 1, 3}, "SCALAR", kUnsignedByte);
  draft.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}, {{"name", "unused"}}};
  draft.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", positions}}}, {"indices", one}, {"material", 1}},
         {{"attributes", {{"POSITION", positions}}}, {"indices", two}, {"material", 0}}}}}};
  draft.json["nodes"] = {{{"mesh", 0}}};
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  EXPECT_EQ(mesh.positions.size(), 4u);
  ASSERT_EQ(mesh.materials.size(), 2u);
  EXPECT_EQ(mesh.materials[mesh.materialOf[0]].name, "b");
  EXPECT_EQ(mesh.materials[mesh.materialOf[1]].name, "a");
}

// --- accessors ---

TEST(ReadGltf, ReadsQuantizedAttributes) {
  const Folder folder;
  GltfDraft draft;
  draft.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  // Three bytes and a fourth of no meaning, and a node to scale them: 127 is 1, and so is -128 no less than
  // -1.
  const int view = draft.view(std::vector<std::int8_t>{0, 0, 0, 9, 127, 0, 0, 9, 0, -128, 0, 9}, 4);
  const int positions = draft.accessor(
      {{"bufferView", view}, {"componentType", kByte}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}});
  const int whole =
      draft.accessor({{"bufferView", view}, {"componentType", kByte}, {"count", 3}, {"type", "VEC3"}});
  const int shorts = draft.view(std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0}, 8);
  const int wide = draft.accessor({{"bufferView", shorts},
                                   {"componentType", kShort},
                                   {"count", 3},
                                   {"type", "VEC3"},
                                   {"normalized", true}});
  GltfJson& node = draft.node({{"attributes", {{"POSITION", positions}}}});
  EXPECT_EQ(cornersIn(draft, folder), (Corners{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
  (void)node;
  draft.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = whole;
  EXPECT_EQ(cornersIn(draft, folder), (Corners{{0, 0, 0}, {127, 0, 0}, {0, -128, 0}}));
  draft.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = wide;
  EXPECT_EQ(cornersIn(draft, folder), (Corners{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

TEST(ReadGltf, ReadsInterleavedVertices) {
  const Folder folder;
  GltfDraft draft;
  Corners both;
  for (const glm::vec3& p : kTriangle) both.insert(both.end(), {p, glm::vec3(0, 0, 2)});
  const int view = draft.view(both, 24);
  const auto at = [&](int offset) {
    return draft.accessor({{"bufferView", view},
                           {"byteOffset", offset},
                           {"componentType", kFloat},
                           {"count", 3},
                           {"type", "VEC3"}});
  };
  draft.node({{"attributes", {{"POSITION", at(0)}, {"NORMAL", at(12)}}}});
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  EXPECT_EQ(cornersOf(mesh), kTriangle);
  EXPECT_EQ(mesh.normals, Corners(3, glm::vec3(0, 0, 1)));
}

TEST(ReadGltf, ReadsSparseAccessors) {
  const Folder folder;
  GltfDraft draft;
  const int places = draft.view(std::vector<std::uint16_t>{1, 2}),
            values = draft.view(Corners{kTriangle[1], kTriangle[2]});
  GltfJson accessor{{"componentType", kFloat},
                    {"count", 3},
                    {"type", "VEC3"},
                    {"sparse",
                     {{"count", 2},
                      {"indices", {{"bufferView", places}, {"componentType", kUnsignedShort}}},
                      {"values", {{"bufferView", values}}}}}};
  draft.node({{"attributes", {{"POSITION", draft.accessor(accessor)}}}});
  EXPECT_EQ(cornersIn(draft, folder), kTriangle);
  draft.json["accessors"][0]["bufferView"] = draft.view(Corners(3, glm::vec3(0, 0, 5)));
  EXPECT_EQ(cornersIn(draft, folder), (Corners{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}}));
  draft.json["accessors"][0]["count"] = 2;
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "its accessor 0 is sparse, and its indices do not rise");
  draft.json["accessors"][0]["sparse"]["count"] = 3;
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")),
            "its accessor 0 is sparse, and reaches beyond its buffer views");
}

TEST(ReadGltf, SaysWhichAccessorIsWrong) {
  const Folder folder;
  const auto why = [&](const GltfJson& changes) {
    GltfDraft draft = triangle();
    draft.json["accessors"][0].update(changes);
    return whyNot(draft.save(folder / "a.gltf"));
  };
  EXPECT_EQ(why({{"count", 4}}), "its accessor 0 reaches beyond its buffer view");
  EXPECT_EQ(why({{"count", 4'000'000'000u}}), "its accessor 0 reaches beyond its buffer view");
  EXPECT_EQ(why({{"count", 1ull << 62}}), "its accessor 0 is too long");
  EXPECT_EQ(why({{"byteOffset", 1ull << 63}}), "its accessor 0 reaches beyond its buffer view");
  EXPECT_EQ(why({{"bufferView", 3}}), "it has no buffer view 3");
  EXPECT_EQ(why({{"componentType", 5130}}), "its accessor 0 is of a type that no vertex has");
  EXPECT_EQ(why({{"type", "MAT2"}}), "its accessor 0 is of a type that no vertex has");
  EXPECT_EQ(why({{"type", "VEC2"}}), "its accessor 0 is of no type for POSITION");
  EXPECT_EQ(why({{"type", "VEC9"}}),
            "it is no valid glTF: Unsupported `type` for accessor object. Got \"VEC9\"");
}

TEST(ReadGltf, SaysWhichViewIsWrong) {
  const Folder folder;
  const auto why = [&](const GltfJson& changes) {
    GltfDraft draft = triangle();
    draft.json["bufferViews"][0].update(changes);
    return whyNot(draft.save(folder / "a.gltf"));
  };
  EXPECT_EQ(why({{"byteLength", 37}}), "its buffer view 0 reaches beyond its buffer");
  EXPECT_EQ(why({{"byteOffset", 1ull << 63}}), "its buffer view 0 reaches beyond its buffer");
  EXPECT_EQ(why({{"buffer", 1}}), "its buffer view 0 is of no buffer");
}

TEST(ReadGltf, SaysWhichIndexIsWrong) {
  const Folder folder;
  GltfDraft draft;
  const int indices = draft.accessor(std::vector<std::uint16_t>{0, 1, 3}, "SCALAR", kUnsignedShort);
  draft.node({{"attributes", {{"POSITION", draft.positions(kTriangle)}}}, {"indices", indices}});
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")),
            "a triangle names vertex 3, and there are 3, numbered from 0");
  draft.json["accessors"][0]["componentType"] = kShort;
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "its accessor 0 is of no type for indices");
}

TEST(ReadGltf, SaysWhichAttributesAreTooFew) {
  const Folder folder;
  GltfDraft draft;
  const int normals = draft.accessor(Corners(2, glm::vec3(0, 0, 1)), "VEC3", kFloat);
  draft.node({{"attributes", {{"POSITION", draft.positions(kTriangle)}, {"NORMAL", normals}}}});
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")),
            "a primitive has fewer normals, colours or texture coordinates than positions");
}

TEST(ReadGltf, LeavesOutPrimitivesWithoutPositions) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.node({{"attributes", {{"NORMAL", 0}}}});
  EXPECT_EQ(readWell(draft.save(folder / "a.gltf")).warnings,
            std::vector<std::string>{"primitives without positions are left out"});
}

TEST(ReadGltf, MakesNormalsThatSomePrimitivesLack) {
  const Folder folder;
  GltfDraft draft = triangle();
  const int normals = draft.accessor(Corners{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}}, "VEC3", kFloat);
  draft.node({{"attributes", {{"POSITION", 0}, {"NORMAL", normals}}}});
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  EXPECT_EQ(mesh.normals, (Corners{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}}));
}

// --- the look ---

/// A draft of a triangle with that material and, by name, these attributes.
GltfDraft painted(const GltfJson& material,
                  const std::map<std::string, std::vector<glm::vec2>>& coordinates = {}) {
  GltfDraft draft;
  GltfJson attributes{{"POSITION", draft.positions(kTriangle)}};
  for (const auto& [name, at] : coordinates) attributes[name] = draft.accessor(at, "VEC2", kFloat);
  draft.node({{"attributes", attributes}, {"material", 0}});
  draft.json["materials"] = GltfJson::array({material});
  return draft;
}

TEST(ReadGltf, ReadsMaterials) {
  const Folder folder;
  GltfDraft draft = painted(
      {{"name", "brass"},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.25, 0.5, 0.75, 1}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.125}}},
       {"emissiveFactor", {0.5, 0, 1}},
       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}});
  const TriangleMaterial material = readPlainly(draft.save(folder / "a.gltf")).materials.at(0);
  EXPECT_EQ(material.name, "brass");
  EXPECT_EQ(material.color, glm::vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(material.metallic, 0.5f);
  EXPECT_EQ(material.roughness, 0.125f);
  EXPECT_EQ(material.emission, glm::vec3(4, 0, 8));
  EXPECT_EQ(material.colorTexture, -1);
}

TEST(ReadGltf, TakesTheFormatsDefaultsForMaterials) {
  const Folder folder;
  GltfDraft draft = painted(GltfJson::object());
  const TriangleMaterial material = readPlainly(draft.save(folder / "a.gltf")).materials.at(0);
  EXPECT_EQ(material.color, glm::vec3(1));
  EXPECT_EQ(material.metallic, 1.0f);
  EXPECT_EQ(material.roughness, 1.0f);
  EXPECT_EQ(material.emission, glm::vec3(0));
  draft.json["meshes"][0]["primitives"][0]["material"] = 1;
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "it has no material 1");
}

TEST(ReadGltf, ReadsColoursOfVertices) {
  const Folder folder;
  GltfDraft draft = triangle();
  using Color = glm::vec<4, std::uint8_t>;
  draft.node(
      {{"attributes",
        {{"POSITION", 0},
         {"COLOR_0", draft.accessor(std::vector<Color>{{255, 0, 51, 9}, {0, 255, 0, 9}, {0, 0, 255, 9}},
                                    "VEC4", kUnsignedByte, true)}}}});
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  ASSERT_EQ(mesh.colors.size(), 6u);
  EXPECT_EQ(mesh.colors[0], glm::vec3(1)) << "the primitive without";
  EXPECT_EQ(mesh.colors[3], glm::vec3(1, 0, 0.2f)) << "linear as it stands";
  EXPECT_EQ(mesh.materials[mesh.materialOf[0]].color, TriangleMaterial{}.color);
  EXPECT_EQ(mesh.materials[mesh.materialOf[1]].color, glm::vec3(1)) << "it would darken them";
}

/// A picture of one row, as PNG or JPEG.
std::string picture(const std::vector<glm::vec<3, std::uint8_t>>& texels, const char* kind = "png") {
  tinygltf::Image image;
  image.width = static_cast<int>(texels.size());
  image.height = 1;
  image.component = 3;
  image.bits = 8;
  image.pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  for (const auto& t : texels) image.image.insert(image.image.end(), {t.x, t.y, t.z});
  const std::string folder, name = std::string("a.") + kind;
  std::string uri;
  tinygltf::WriteImageData(&folder, &name, &image, true, &uri, nullptr);
  std::vector<unsigned char> bytes;
  tinygltf::DecodeDataURI(&bytes, uri, std::string(uri), 0, false);
  return {bytes.begin(), bytes.end()};
}

const std::vector<unsigned char> kRedGreen{255, 0, 0, 255, 0, 255, 0, 255};
const std::vector<glm::vec2> kCoordinates{{0, 0}, {1, 0}, {0, 1}};
const GltfJson kTextured{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};

TEST(ReadGltf, ReadsPicturesFromTextsViewsAndFiles) {
  const Folder folder;
  const std::string png = picture({{255, 0, 0}, {0, 255, 0}});
  GltfDraft draft = painted(kTextured, {{"TEXCOORD_0", kCoordinates}});
  draft.json["textures"] = {{{"source", 0}}};
  std::filesystem::create_directory(folder / "sub folder");
  written(folder / "sub folder/a.png", png);
  const int view = draft.view(std::vector<char>(png.begin(), png.end()));
  for (const GltfJson& image :
       {GltfJson{{"uri", "data:image/png;base64," + GltfDraft::base64(png)}},
        GltfJson{{"bufferView", view}, {"mimeType", "image/png"}}, GltfJson{{"uri", "sub%20folder/a.png"}}}) {
    draft.json["images"] = GltfJson::array({image});
    const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
    ASSERT_EQ(mesh.images.size(), 1u);
    EXPECT_EQ(mesh.images[0].width, 2);
    EXPECT_EQ(mesh.images[0].height, 1);
    EXPECT_EQ(mesh.images[0].pixels, kRedGreen);
    EXPECT_EQ(mesh.materials[0].colorTexture, 0);
    EXPECT_EQ(mesh.textureAt, kCoordinates);
  }
}

TEST(ReadGltf, ReadsJpeg) {
  const Folder folder;
  const std::string jpeg = picture(std::vector<glm::vec<3, std::uint8_t>>(16, {200, 100, 50}), "jpg");
  GltfDraft draft = painted(kTextured, {{"TEXCOORD_0", kCoordinates}});
  draft.json["textures"] = {{{"source", 0}}};
  draft.json["images"] = {{{"uri", "data:image/jpeg;base64," + GltfDraft::base64(jpeg)}}};
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  ASSERT_EQ(mesh.images.at(0).width, 16);
  constexpr int kCoarse = 3;  // JPEG rounds three channels, each by half a step, on the way in and out
  EXPECT_NEAR(mesh.images[0].pixels[0], 200, kCoarse);
  EXPECT_NEAR(mesh.images[0].pixels[1], 100, kCoarse);
  EXPECT_NEAR(mesh.images[0].pixels[2], 50, kCoarse);
}

TEST(ReadGltf, KeepsThePlainColourWherePicturesAreMissingOrBroken) {
  const Folder folder;
  const std::string png = picture({{255, 0, 0}, {0, 255, 0}});
  std::string huge = png;
  huge.replace(16, 8, std::string("\0\0\x20\0\0\0\x20\0", 8));  // 8192 x 8192 in 80 bytes
  std::string larger = png;
  larger[16] = 1;
  const auto data = [](const std::string& bytes) {
    return "data:image/png;base64," + GltfDraft::base64(bytes);
  };
  const std::pair<std::string, std::string> cases[] = {
      {"none.png", "the file 'none.png' that it names: No such file or directory; put it there"},
      {"../a.png", "it names the file '../a.png', which lies outside its folder; move that beside it"},
      {"/etc/hosts", "it names the file '/etc/hosts', which lies outside its folder; move that beside it"},
      {data("GIF89a"), "it is no PNG or JPEG"},
      {data(png.substr(0, 40)), "it is broken"},
      {data(huge), "it is broken"},
      {data(larger), "it is too large"},
      {"data:image/webp;base64,AAAA", "it has data of an unknown kind: 'data:image/webp;base64,AAAA'"}};
  for (const auto& [uri, why] : cases) {
    GltfDraft draft = painted(kTextured, {{"TEXCOORD_0", kCoordinates}});
    draft.json["textures"] = {{{"source", 0}}};
    draft.json["images"] = {{{"uri", uri}}};
    const ReadMesh read = readWell(draft.save(folder / "a.gltf"));
    ASSERT_EQ(read.warnings.size(), 1u) << uri;
    EXPECT_TRUE(read.warnings[0].starts_with("picture 0 is left out: ") && read.warnings[0].ends_with(why))
        << read.warnings[0];
    EXPECT_EQ(read.mesh.materials.at(0).colorTexture, -1);
    EXPECT_TRUE(read.mesh.images.empty());
  }
  GltfDraft draft = painted(kTextured);
  EXPECT_EQ(readWell(draft.save(folder / "a.gltf")).warnings,
            std::vector<std::string>{"picture -1 is left out: it is missing"});
}

TEST(ReadGltf, ReadsTheTextureCoordinatesThatTheColourNames) {
  const Folder folder;
  GltfDraft draft =
      painted(kTextured, {{"TEXCOORD_0", {{5, 5}, {5, 5}, {5, 5}}}, {"TEXCOORD_1", kCoordinates}});
  GltfJson& texture = draft.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["texCoord"] = 1;
  draft.json["textures"] = {{{"source", 0}}};
  draft.json["images"] = {{{"uri", "data:image/png;base64," + GltfDraft::base64(picture({{1, 2, 3}}))}}};
  EXPECT_EQ(readPlainly(draft.save(folder / "a.gltf")).textureAt, kCoordinates);
  texture["texCoord"] = 2;
  EXPECT_EQ(readWell(draft.save(folder / "a.gltf")).warnings,
            std::vector<std::string>{"a primitive with a texture has no TEXCOORD_2"});
}

TEST(ReadGltf, TransformsTextureCoordinates) {
  const Folder folder;
  GltfDraft draft = painted(kTextured, {{"TEXCOORD_0", kCoordinates}});
  draft.json["extensionsRequired"] = {"KHR_texture_transform"};
  draft.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform",
       {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", std::numbers::pi / 2}}}};
  draft.json["textures"] = {{{"source", 0}}};
  draft.json["images"] = {{{"uri", "data:image/png;base64," + GltfDraft::base64(picture({{1, 2, 3}}))}}};
  const TriangleMesh mesh = readPlainly(draft.save(folder / "a.gltf"));
  // The extension's matrices, by hand: (u, v) becomes (2u, 3v), then (3v, -2u), then is moved.
  const std::vector<glm::vec2> expected{{0.5, 0.25}, {0.5, -1.75}, {3.5, 0.25}};
  for (int i = 0; i < 3; ++i) EXPECT_LT(glm::distance(mesh.textureAt[i], expected[i]), 1e-6f) << i;
}

TEST(ReadGltf, WarnsOfTexturesThatItTakesOtherwise) {
  const Folder folder;
  GltfDraft draft =
      painted({{"name", "m"},
               {"alphaMode", "BLEND"},
               {"emissiveFactor", {1, 1, 1}},
               {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
               {"pbrMetallicRoughness",
                {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}}},
              {{"TEXCOORD_0", kCoordinates}, {"TEXCOORD_1", kCoordinates}});
  draft.json["textures"] = {{{"source", 0}}};
  draft.json["images"] = {
      {{"uri", "data:image/png;base64," + GltfDraft::base64(picture({{0, 51, 255}, {0, 153, 0}}))}}};
  const ReadMesh read = readWell(draft.save(folder / "a.gltf"));
  EXPECT_EQ(read.warnings,
            (std::vector<std::string>{
                "material 'm' is transparent, and read as opaque",
                "material 'm' has an emission texture with coordinates of its own, which is left out",
                "material 'm' has a metal and roughness texture, of which the mean is taken"}));
  const TriangleMaterial& material = read.mesh.materials.at(0);
  EXPECT_EQ(material.emissionTexture, -1);
  EXPECT_FLOAT_EQ(material.roughness, 0.4f);  // the mean of 51 and 153 of 255
  EXPECT_FLOAT_EQ(material.metallic, 0.5f);
}

TEST(ReadGltf, WarnsOfWhatMoves) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  draft.json["animations"] = GltfJson::array({GltfJson::object()});
  draft.json["skins"] = {{{"joints", {0}}}};
  draft.json["nodes"][0]["skin"] = 0;
  EXPECT_EQ(readWell(draft.save(folder / "a.gltf")).warnings,
            (std::vector<std::string>{"its animations are left out",
                                      "its skins are left out: what they bend is read at rest",
                                      "its morph targets are left out"}));
}

// --- the file ---

TEST(ReadGltf, RefusesWhatItDoesNotKnowAndMust) {
  const Folder folder;
  GltfDraft draft = triangle();
  draft.json["extensionsUsed"] = {"EXT_something", "KHR_draco_mesh_compression"};
  EXPECT_EQ(cornersIn(draft, folder), kTriangle);
  draft.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")),
            "it requires 'KHR_draco_mesh_compression', which is unknown here; export it without");
}

TEST(ReadGltf, ReadsBuffersFromFilesBesideIt) {
  const Folder folder;
  std::filesystem::create_directory(folder / "inner");
  GltfDraft draft = triangle();
  written(folder / "inner/a b.bin", draft.data);
  written(folder / "a.bin", draft.data);
  const std::size_t length = std::exchange(draft.data, "").size();
  const auto naming = [&](const std::string& uri) {
    draft.json["buffers"] = {{{"byteLength", length}, {"uri", uri}}};
    return draft.save(folder / "inner/a.gltf");
  };
  EXPECT_EQ(cornersOf(readPlainly(naming("a%20b.bin"))), kTriangle);
  const std::string outside = ", which lies outside its folder; move that beside it";
  EXPECT_EQ(whyNot(naming("../a.bin")), "it names the file '../a.bin'" + outside);
  EXPECT_EQ(whyNot(naming("./../inner/a b.bin")), "it names the file './../inner/a b.bin'" + outside);
  EXPECT_EQ(whyNot(naming("%2e%2e/a.bin")), "it names the file '../a.bin'" + outside);
  EXPECT_EQ(whyNot(naming("/etc/hosts")), "it names the file '/etc/hosts'" + outside);
  std::filesystem::create_symlink("../a.bin", folder / "inner/link.bin");
  EXPECT_EQ(whyNot(naming("link.bin")), "it names the file 'link.bin'" + outside);
  EXPECT_EQ(whyNot(naming("none.bin")),
            "the file 'none.bin' that it names: No such file or directory; put it there");
  EXPECT_EQ(whyNot(naming("a%00b")), "it names the file 'a?b', which no file can be called");
  draft.json["buffers"] = {{{"byteLength", length + 1}, {"uri", "a b.bin"}}};
  EXPECT_EQ(whyNot(draft.save(folder / "inner/a.gltf")), "its buffer 0 is cut off: 36 of 37 bytes are there");
  draft.json["buffers"] = {{{"byteLength", length}}};
  EXPECT_EQ(whyNot(draft.save(folder / "inner/a.gltf")),
            "its buffer view 0 is of buffer 0, which is missing");
  draft.json["buffers"] = GltfJson::array({GltfJson::object()});
  EXPECT_EQ(whyNot(draft.save(folder / "inner/a.gltf")), "its buffer 0 has no length");
}

std::string glb(const GltfDraft& draft) {
  GltfJson json = draft.json;
  json["buffers"] = {{{"byteLength", draft.data.size()}}};
  std::ostringstream out;
  writeGlb(out, json.dump(), {draft.data.begin(), draft.data.end()});
  return std::move(out).str();
}

TEST(ReadGltf, SaysWhatIsWrongWithTheContainer) {
  const Folder folder;
  const std::string whole = glb(triangle());
  const std::string size = std::to_string(whole.size());
  const auto why = [&](const std::string& bytes) { return whyNot(written(folder / "a.glb", bytes)); };
  EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.glb", whole))), kTriangle);
  EXPECT_EQ(cornersOf(readPlainly(written(folder / "a.gltf", whole)))[1], kTriangle[1]) << "by its content";
  EXPECT_EQ(why("{}"), "it is no binary glTF: it does not begin with 'glTF'");
  EXPECT_EQ(why(whole.substr(0, 10)), "it is cut off: 10 of its 20 bytes are there");
  EXPECT_EQ(why(whole.substr(0, 100)), "it is cut off: 100 of its " + size + " bytes are there");
  const auto with = [&](std::size_t at, char c) {
    std::string changed = whole;
    changed[at] = c;
    return changed;
  };
  EXPECT_EQ(why(with(4, 1)), "it is glTF 1, and only 2 is read");
  EXPECT_EQ(why(with(16, 'X')), "its first chunk is not JSON");
  EXPECT_TRUE(why(with(15, 127)).starts_with("it is cut off: "));
}

TEST(ReadGltf, SaysWhatIsWrongWithTheText) {
  const Folder folder;
  const auto why = [&](const std::string& text) { return whyNot(written(folder / "a.gltf", text)); };
  EXPECT_EQ(why("hello"), "its JSON is broken at byte 1");
  EXPECT_EQ(why("{\"asset\":{\"version\":\"2.0\"}"), "its JSON is broken at byte 27");
  EXPECT_EQ(why("[]"), "its JSON is no object");
  EXPECT_EQ(why("{\"a\":1e999}"), "its JSON is broken");
  EXPECT_EQ(why("{}"), "it is no glTF: it names no version");
  EXPECT_EQ(why("{\"asset\":{\"version\":\"1.0\"}}"), "it is glTF '1.0', and only 2 is read");
  EXPECT_EQ(why("{\"asset\":{\"version\":\"2.0\"}}"), "it has no triangles");
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_EQ(why("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep + "}"), "its JSON is nested too deep");
}

TEST(ReadGltf, SaysWhichCompressedViewIsBroken) {
  const Folder folder;
  GltfDraft draft = triangle();
  GltfJson& view = draft.json["bufferViews"][0];
  const GltfJson encoding{
      {"buffer", 0}, {"byteLength", 36}, {"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}};
  for (const GltfJson& change :
       {GltfJson::object(), GltfJson{{"count", 1'000'000'000}}, GltfJson{{"byteStride", 0}},
        GltfJson{{"byteStride", 13}}, GltfJson{{"mode", "TRIANGLES"}}, GltfJson{{"mode", "OTHER"}}}) {
    GltfJson changed = encoding;
    changed.update(change);
    view["extensions"] = {{"EXT_meshopt_compression", changed}};
    EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "its buffer view 0, which is compressed, is broken");
  }
  view["extensions"]["EXT_meshopt_compression"]["byteLength"] = 37;
  EXPECT_EQ(whyNot(draft.save(folder / "a.gltf")), "its buffer view 0 reaches beyond its buffer");
}

}  // namespace read_mesh_gltf_test
}  // namespace sdf
