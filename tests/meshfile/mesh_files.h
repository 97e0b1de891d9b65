// Mesh files for the tests of readMesh.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sdf/meshfile/read_mesh.h"
#include "support/folder.h"

namespace sdf {

inline std::filesystem::path written(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

/// What the file holds; an error fails the test.
inline ReadMesh readWell(const std::filesystem::path& file) {
  Result<ReadMesh> read = readMesh(file);
  EXPECT_TRUE(read.ok()) << (read ? "" : read.error().message);
  return read ? std::move(*read) : ReadMesh{};
}

/// The same, which must give no warning.
inline TriangleMesh readPlainly(const std::filesystem::path& file) {
  ReadMesh read = readWell(file);
  EXPECT_EQ(read.warnings, std::vector<std::string>());
  return std::move(read.mesh);
}

/// The error's message after "cannot read 'file': ".
inline std::string whyNot(const std::filesystem::path& file) {
  const Result<ReadMesh> read = readMesh(file);
  if (read) return "it was read";
  const std::string start = "cannot read '" + file.string() + "': ";
  EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
  if (!read.error().message.starts_with(start)) return "another beginning: " + read.error().message;
  return read.error().message.substr(start.size());
}

inline std::vector<glm::vec3> cornersOf(const TriangleMesh& mesh) {
  std::vector<glm::vec3> out;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) out.push_back(mesh.positions.at(t[k]));
  return out;
}

/// Everything that TriangleMesh promises.
inline void expectSound(const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_FALSE(mesh.materials.empty());
  EXPECT_EQ(mesh.materialOf.size(), mesh.triangles.size());
  for (const std::size_t size : {mesh.normals.size(), mesh.colors.size(), mesh.textureAt.size()})
    EXPECT_TRUE(size == 0 || size == count) << size << " of " << count;
  for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), count);
  for (const std::uint32_t m : mesh.materialOf) ASSERT_LT(m, mesh.materials.size());
  for (const glm::vec3& n : mesh.normals) ASSERT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1.0f, 1e-5f);
  const auto images = static_cast<int>(mesh.images.size());
  for (const TriangleMaterial& m : mesh.materials)
    EXPECT_TRUE(m.colorTexture < images && m.emissionTexture < images);
}

using GltfJson = nlohmann::json;

/// A glTF file as it is made: accessors over one buffer, which save() writes as a data URI.
struct GltfDraft {
  GltfJson json{{"asset", {{"version", "2.0"}}}};
  std::string data;

  /// Index of a view of these elements.
  template <class T>
  int view(const std::vector<T>& elements, int stride = 0) {
    GltfJson one{{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", elements.size() * sizeof(T)}};
    if (stride > 0) one["byteStride"] = stride;
    data.append(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(T));
    data.resize((data.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(one);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }
  int accessor(const GltfJson& accessor) {
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  template <class T>
  int accessor(const std::vector<T>& elements, const std::string& type, int componentType,
               bool normalized = false) {
    return accessor({{"bufferView", view(elements)},
                     {"componentType", componentType},
                     {"count", elements.size()},
                     {"type", type},
                     {"normalized", normalized}});
  }
  int positions(const std::vector<glm::vec3>& points) { return accessor(points, "VEC3", 5126); }
  /// Adds a mesh of one primitive and a node for it, and returns the node.
  GltfJson& node(const GltfJson& primitive) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    return json["nodes"].back();
  }

  static std::string base64(const std::string& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      const auto at = [&](std::size_t k) {
        return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0u;
      };
      const unsigned all = at(i) << 16 | at(i + 1) << 8 | at(i + 2);
      for (int k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[all >> (18 - 6 * k) & 63] : '=';
    }
    return out;
  }
  std::string text() {
    if (!data.empty()) {
      json["buffers"] = {
          {{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
    }
    return json.dump();
  }
  std::filesystem::path save(const std::filesystem::path& file) { return written(file, text()); }
};

/// The unit right triangle in the plane of x and y, seen from +z.
inline const std::vector<glm::vec3> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace sdf
