// What our own writers write, read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gltf/synthetic.h"
#include "mesh_files.h"
#include "sdf/export/compress.h"
#include "sdf/export/export.h"

namespace sdf {
namespace read_mesh_round_trip_test {

using Corners = std::vector<glm::vec3>;

Corners cornersOf(const Mesh& mesh) {
  Corners out;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) out.push_back(mesh.positions[t[k]]);
  return out;
}

bool before(const glm::vec3& a, const glm::vec3& b) {
  return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
}

/// Triangles as a set: each begins with its least corner, and they are in order.
std::vector<std::array<glm::vec3, 3>> inOrder(const Corners& corners) {
  std::vector<std::array<glm::vec3, 3>> out;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    std::array<glm::vec3, 3> t{corners[i], corners[i + 1], corners[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end(), before), t.end());
    out.push_back(t);
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
  });
  return out;
}

constexpr const char* kFormats[] = {"a.glb", "a.gltf", "a.stl", "a.ply", "a.obj"};

TEST(ReadMeshRoundTrip, KeepsEveryTriangleOfEveryFormat) {
  const Folder folder;
  const Mesh sent = twoColoredSphere(6, 8);
  for (const char* name : kFormats) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    const TriangleMesh mesh = readPlainly(folder / name);
    expectSound(mesh);
    EXPECT_EQ(inOrder(cornersOf(mesh)), inOrder(cornersOf(sent))) << name;
  }
}

TEST(ReadMeshRoundTrip, KeepsAllParts) {
  const Folder folder;
  const Mesh one = sphere(3, 4), two = sphere(4, 5, {5, 0, 0});
  Corners both = cornersOf(one);
  for (const glm::vec3& p : cornersOf(two)) both.push_back(p);
  for (const char* name : kFormats) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", one), part("b", two)}));
    EXPECT_EQ(inOrder(cornersOf(readPlainly(folder / name))), inOrder(both)) << name;
  }
}

TEST(ReadMeshRoundTrip, KeepsVerticesShared) {
  const Folder folder;
  const Mesh sent = sphere(6, 8);
  for (const char* name : kFormats) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    EXPECT_EQ(readPlainly(folder / name).positions.size(), sent.positions.size()) << name;
  }
}

TEST(ReadMeshRoundTrip, KeepsNormals) {
  const Folder folder;
  const Mesh sent = sphere(6, 8);  // where a normal is its vertex's position
  for (const char* name : {"a.glb", "a.gltf", "a.ply", "a.obj"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    const TriangleMesh mesh = readPlainly(folder / name);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << name;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
      EXPECT_LT(glm::distance(mesh.normals[i], mesh.positions[i]), 1e-6f) << name;
  }
}

/// The colour at the corners of triangle t.
glm::vec3 colorAt(const TriangleMesh& mesh, std::size_t t) {
  const glm::vec3 vertex = mesh.colors.empty() ? glm::vec3(1.0f) : mesh.colors[mesh.triangles[t].x];
  return mesh.materials[mesh.materialOf[t]].color * vertex;
}

TEST(ReadMeshRoundTrip, KeepsColours) {
  const Folder folder;
  const Mesh sent = twoColoredSphere(6, 8);
  // Half a step of sRGB's 255 in its steepest place, at white: (1 + 0.055) / 1.055 * 2.4 / 255 / 2.
  constexpr float kStep = 2.4f / 1.055f / 255.0f / 2.0f;
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    const TriangleMesh mesh = readPlainly(folder / name);
    std::size_t blue = 0, red = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      blue += glm::distance(colorAt(mesh, t), glm::vec3(0.25f, 0.5f, 0.75f)) < 2 * kStep;
      red += glm::distance(colorAt(mesh, t), glm::vec3(1.0f, 0.0f, 0.0f)) < 2 * kStep;
    }
    EXPECT_EQ(blue, sent.triangles.size() / 2) << name;
    EXPECT_EQ(red, sent.triangles.size() / 2) << name;
  }
  ASSERT_TRUE(writeMeshes(folder / "a.ply", Scene{}, {part("a", sphere(6, 8))}));
  const TriangleMesh mesh = readPlainly(folder / "a.ply");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_LT(glm::distance(colorAt(mesh, t), glm::vec3(0.25f, 0.5f, 0.75f)), 2 * kStep);
}

TEST(ReadMeshRoundTrip, KeepsMaterials) {
  const Folder folder;
  Mesh sent = sphere(3, 4);
  sent.materials[0].emission = {4.0f, 2.0f, 0.0f};  // above 1: KHR_materials_emissive_strength
  sent.materials[0].specular = glm::vec3(1.0f);
  sent.materials[0].shininess = 40.0f;
  for (const char* name : {"a.glb", "a.gltf"}) {
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {part("a", sent)}));
    const TriangleMesh mesh = readPlainly(folder / name);
    ASSERT_EQ(mesh.materials.size(), 1u);
    EXPECT_EQ(mesh.materials[0].name, "blue");
    EXPECT_LT(glm::distance(mesh.materials[0].emission, sent.materials[0].emission), 1e-5f);
    EXPECT_NEAR(mesh.materials[0].roughness, std::pow(1.0 / 81.0, 0.25), 1e-6);  // pbr.h
    EXPECT_EQ(mesh.materials[0].metallic, 0.0f);
  }
}

TEST(ReadMeshRoundTrip, ReadsBakedLightAsAnEmissionTexture) {
  const Folder folder;
  ExportPart sent = part("a", sphere(3, 4));
  for (const glm::vec3& p : sent.mesh.positions) sent.mesh.ambient.push_back(glm::abs(p));
  sent.ambient = AmbientLight{glm::vec3(0.5f), std::vector<float>(sent.mesh.positions.size(), 0.5f)};
  ASSERT_TRUE(writeMeshes(folder / "a.glb", Scene{}, {sent}));
  const TriangleMesh mesh = readPlainly(folder / "a.glb");
  expectSound(mesh);
  ASSERT_GE(mesh.materials[0].emissionTexture, 0);
  ASSERT_GE(mesh.materials[0].colorTexture, 0);
  EXPECT_EQ(mesh.textureAt.size(), mesh.positions.size());
  const TextureImage& white = mesh.images[mesh.materials[0].colorTexture];
  EXPECT_EQ(white.width, 1);
  EXPECT_EQ(white.pixels, (std::vector<unsigned char>{255, 255, 255, 255}));
  EXPECT_EQ(mesh.images[mesh.materials[0].emissionTexture].width, 2);
}

TEST(ReadMeshRoundTrip, DecodesCompressedFiles) {
  const Folder folder;
  for (const char* name : {"a.glb", "a.gltf"}) {
    ExportPart sent = part("a", twoColoredSphere(20, 30));
    compress(sent);
    ASSERT_TRUE(writeMeshes(folder / name, Scene{}, {sent}));
    ASSERT_NE(contents(folder / name).find("EXT_meshopt_compression"), std::string::npos);
    const TriangleMesh mesh = readPlainly(folder / name);
    expectSound(mesh);
    EXPECT_EQ(inOrder(cornersOf(mesh)), inOrder(cornersOf(sent.mesh))) << name;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    // What 12 bits leave of a normal (meshopt.h), and what rounding moves a vertex by.
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
      EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 0.99f);
  }
}

}  // namespace read_mesh_round_trip_test
}  // namespace sdf
