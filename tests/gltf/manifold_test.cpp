// What files say of the solid beside its drawn primitives.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "gltf/manifold_read.h"
#include "sdf/export/export.h"
#include "sdf/gltf/primitive.h"
#include "sdf/mesh/mesher.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"
#include "support/folder.h"
#include "synthetic.h"

namespace sdf {
namespace manifold_test {

using tinygltf::Value;

/// The sphere with its triangles in turn blue, red and green, so that all three meet in most points.
Mesh threeColoredSphere(int rows, int columns) {
  const Mesh plain = sphere(rows, columns);
  Mesh mesh = plain;
  mesh.materials.push_back(paint("red", {1.0f, 0.0f, 0.0f}));
  mesh.materials.push_back(paint("green", {0.0f, 1.0f, 0.0f}));
  mesh.triangles.clear();
  mesh.triangleMaterial.clear();
  for (std::uint32_t m = 0; m < 3; ++m) {
    std::map<std::uint32_t, std::uint32_t> copies;
    for (std::size_t t = m; t < plain.triangles.size(); t += 3) {
      glm::uvec3 triangle = plain.triangles[t];
      for (int k = 0; m > 0 && k < 3; ++k) {
        const std::uint32_t v = triangle[k];
        const auto [copy, isNew] = copies.try_emplace(v, static_cast<std::uint32_t>(mesh.positions.size()));
        if (isNew) {
          mesh.positions.push_back(glm::vec3(plain.positions[v]));
          mesh.normals.push_back(glm::vec3(plain.normals[v]));
          mesh.colors.push_back(mesh.materials[m].color);
          mesh.copyOf.push_back(v);
        }
        triangle[k] = copy->second;
      }
      mesh.triangles.push_back(triangle);
      mesh.triangleMaterial.push_back(m);
    }
  }
  return mesh;
}

class ManifoldFile : public ::testing::Test {
 protected:
  tinygltf::Model write(const ExportPart& part) {
    EXPECT_TRUE(writeMeshes(folder_ / "a.glb", Scene{}, {part}));
    return load(folder_ / "a.glb");
  }

 private:
  Folder folder_;
};

TEST_F(ManifoldFile, MergesCloseWhatMaterialsSplit) {
  for (const Mesh& mesh : {twoColoredSphere(9, 11), threeColoredSphere(8, 7), twoColoredSphere(300, 300)}) {
    const tinygltf::Model model = write(part("p", mesh));
    ASSERT_EQ(model.meshes.size(), 1u);
    std::vector<std::uint32_t> split;
    for (const tinygltf::Primitive& primitive : model.meshes[0].primitives)
      for (const std::uint32_t i : indices(model, primitive)) split.push_back(i);
    EXPECT_GT(openEdges(split), 0u);
    const std::vector<std::uint32_t> merged = manifoldIndices(model, model.meshes[0]);
    ASSERT_EQ(merged.size(), split.size());
    EXPECT_EQ(openEdges(merged), 0u);
    const auto positions =
        elements<glm::vec3>(model, model.meshes[0].primitives[0].attributes.at("POSITION"));
    for (std::size_t i = 0; i < merged.size(); ++i) ASSERT_EQ(positions[merged[i]], positions[split[i]]);
  }
}

TEST_F(ManifoldFile, KeepsWhatTheExtensionAsksOfItsAccessors) {
  const tinygltf::Model model = write(part("p", twoColoredSphere(9, 11)));
  EXPECT_NE(std::ranges::find(model.extensionsUsed, "EXT_mesh_manifold"), model.extensionsUsed.end());
  EXPECT_TRUE(model.extensionsRequired.empty());
  const tinygltf::Mesh& mesh = model.meshes[0];
  const Value& manifold = manifoldPrimitive(mesh);
  EXPECT_EQ(manifold.Get("mode").GetNumberAsInt(), TINYGLTF_MODE_TRIANGLES);
  EXPECT_FALSE(manifold.Has("material"));
  EXPECT_EQ(manifold.Get("attributes").Keys(), (std::vector<std::string>{"POSITION"}));
  const tinygltf::Accessor& all = model.accessors.at(manifold.Get("indices").GetNumberAsInt());
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    EXPECT_EQ(primitive.attributes.at("POSITION"),
              manifold.Get("attributes").Get("POSITION").GetNumberAsInt());
    EXPECT_EQ(model.accessors.at(primitive.indices).bufferView, all.bufferView);
  }
  // The merges are the sparse part once more: same views, offsets and types.
  const Value& extension = mesh.extensions.at("EXT_mesh_manifold");
  const tinygltf::Accessor& places = model.accessors.at(extension.Get("mergeIndices").GetNumberAsInt());
  const tinygltf::Accessor& values = model.accessors.at(extension.Get("mergeValues").GetNumberAsInt());
  EXPECT_EQ(places.bufferView, all.sparse.indices.bufferView);
  EXPECT_EQ(values.bufferView, all.sparse.values.bufferView);
  EXPECT_EQ(places.componentType, all.sparse.indices.componentType);
  EXPECT_EQ(values.componentType, all.componentType);
  EXPECT_EQ(places.count, static_cast<std::size_t>(all.sparse.count));
  EXPECT_EQ(values.count, static_cast<std::size_t>(all.sparse.count));
}

TEST_F(ManifoldFile, OneMaterialNeedsNoMerges) {
  const tinygltf::Model model = write(part("p", sphere(9, 11)));
  const tinygltf::Mesh& mesh = model.meshes[0];
  EXPECT_EQ(manifoldPrimitive(mesh).Get("indices").GetNumberAsInt(), mesh.primitives[0].indices);
  EXPECT_EQ(openEdges(manifoldIndices(model, mesh)), 0u);
}

TEST_F(ManifoldFile, PointsThatOnlyCoincideStayApart) {
  // Two spheres that touch in the same numbers: (0, 1, 0) and (0, -1, 0) + (0, 2, 0).
  Mesh mesh = sphere(3, 4);
  const Mesh above = sphere(3, 4, {0.0f, 2.0f, 0.0f});
  for (std::size_t i = 0; i < above.positions.size(); ++i) {
    mesh.positions.push_back(glm::vec3(above.positions[i]));
    mesh.normals.push_back(glm::vec3(above.normals[i]));
    mesh.colors.push_back(glm::vec3(above.colors[i]));
  }
  for (const glm::uvec3& t : above.triangles) mesh.triangles.push_back(t + glm::uvec3(mesh.welded));
  mesh.welded += above.welded;
  mesh.triangleMaterial.assign(mesh.triangles.size(), 0);
  const tinygltf::Model model = write(part("p", mesh));
  const std::vector<std::uint32_t> merged = manifoldIndices(model, model.meshes[0]);
  EXPECT_EQ(*std::ranges::max_element(merged) + 1, mesh.welded);
}

TEST_F(ManifoldFile, WhatIsNotManifoldDoesNotSaySo) {
  for (const bool isManifold : {false, true}) {
    ExportPart open = part("p", sphere(3, 4));
    open.stats.manifold = isManifold;
    open.stats.watertight = !isManifold;
    const tinygltf::Model model = write(open);
    EXPECT_TRUE(model.meshes[0].extensions.empty());
    EXPECT_TRUE(model.extensionsUsed.empty());
  }
}

TEST_F(ManifoldFile, AMeshedSceneOfThreeMaterialsIsClosed) {
  const auto ball = [](double x, const Vec3E& color) {
    return translate(sphere(1.0), {x, 0.3 * x, 0.0}).paint({.color = color});
  };
  const Shape shape = unite(unite(ball(-0.7, {1, 0, 0}), ball(0.0, {0, 1, 0})), ball(0.6, {0, 0, 1}));
  Progress progress;
  auto meshed = meshShape(shape, "balls", {.voxelSize = 0.07}, progress);
  ASSERT_TRUE(meshed) << meshed.error().message;
  const tinygltf::Model model = write({"balls", std::move(meshed->mesh), meshed->stats, {}});
  ASSERT_EQ(model.meshes[0].primitives.size(), 3u);
  EXPECT_EQ(openEdges(manifoldIndices(model, model.meshes[0])), 0u);
}

}  // namespace manifold_test
}  // namespace sdf
