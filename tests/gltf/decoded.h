// Compressed glTF files as a reader of EXT_meshopt_compression holds them (Kapoulkine 2020).
#pragma once
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sdf/gltf/glb.h"
#include "support/folder.h"

namespace sdf {

using Bytes = std::vector<unsigned char>;
using GltfJson = nlohmann::json;

/// A glTF file's text and the data that it holds.
struct GltfFile {
  GltfJson json;
  Bytes data;
};

inline GltfFile readGltf(const std::filesystem::path& file) {
  GltfFile out;
  const std::string bytes = contents(file);
  if (file.extension() == ".glb") {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof(length));
    out.json = GltfJson::parse(bytes.substr(20, length));
    const std::size_t begin = 20 + length + 8;
    if (begin < bytes.size())
      out.data.assign(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end());
    return out;
  }
  out.json = GltfJson::parse(bytes);
  if (out.json.contains("buffers")) {
    std::string kind;
    EXPECT_TRUE(tinygltf::DecodeDataURI(&out.data, kind, out.json["buffers"][0]["uri"], 0, false));
  }
  return out;
}

/// The bytes that an encoded view stands for. Everything that the extension demands of it is expected.
inline Bytes decodedView(const GltfFile& file, const GltfJson& view) {
  const GltfJson& encoded = view["extensions"]["EXT_meshopt_compression"];
  const std::size_t count = encoded["count"], stride = encoded["byteStride"], length = encoded["byteLength"],
                    offset = encoded.value("byteOffset", 0);
  const std::string mode = encoded["mode"], filter = encoded.value("filter", "NONE");
  EXPECT_EQ(encoded["buffer"], 0);
  EXPECT_LE(offset + length, file.data.size());
  EXPECT_EQ(view["byteLength"], count * stride);
  EXPECT_EQ(view.contains("byteStride"), mode == "ATTRIBUTES");
  EXPECT_EQ(view.value("byteStride", stride), stride);
  Bytes out(count * stride);
  int failed = -1;
  if (mode == "TRIANGLES") {
    EXPECT_EQ(file.data.at(offset), 0xE1);
    EXPECT_EQ(count % 3, 0u);
    EXPECT_EQ(filter, "NONE");
    failed = meshopt_decodeIndexBuffer(out.data(), count, stride, &file.data[offset], length);
  } else if (mode == "ATTRIBUTES") {
    EXPECT_EQ(file.data.at(offset), 0xA0);
    EXPECT_EQ(stride % 4, 0u);
    failed = meshopt_decodeVertexBuffer(out.data(), count, stride, &file.data[offset], length);
  }
  EXPECT_EQ(failed, 0) << mode;
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), count, stride);
  EXPECT_TRUE(filter == "NONE" || filter == "OCTAHEDRAL" || filter == "EXPONENTIAL") << filter;
  return out;
}

/// Expects of the placeholder that views reach no farther than it does, and that no file holds it.
inline void expectPlaceholder(const GltfJson& json) {
  ASSERT_EQ(json["buffers"].size(), 2u);
  const GltfJson& placeholder = json["buffers"][1];
  EXPECT_FALSE(placeholder.contains("uri"));
  EXPECT_EQ(placeholder["extensions"]["EXT_meshopt_compression"]["fallback"], true);
  for (const GltfJson& view : json["bufferViews"]) {
    EXPECT_EQ(view["buffer"] == 1, view.contains("extensions"));
    const std::size_t offset = view.value("byteOffset", 0), length = view["byteLength"];
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + length, json["buffers"][view["buffer"].get<int>()]["byteLength"].get<std::size_t>());
  }
}

/// Writes the file as an uncompressed .glb.
inline void writeDecoded(const std::filesystem::path& compressed, const std::filesystem::path& target) {
  GltfFile file = readGltf(compressed);
  expectPlaceholder(file.json);
  Bytes data;
  for (GltfJson& view : file.json["bufferViews"]) {
    const std::size_t offset = view.value("byteOffset", 0), length = view["byteLength"];
    const bool isEncoded = view.contains("extensions");
    const Bytes bytes = isEncoded ? decodedView(file, view)
                                  : Bytes(file.data.begin() + static_cast<std::ptrdiff_t>(offset),
                                          file.data.begin() + static_cast<std::ptrdiff_t>(offset + length));
    view.erase("extensions");
    view["buffer"] = 0;
    view["byteOffset"] = data.size();
    data.insert(data.end(), bytes.begin(), bytes.end());
    data.resize((data.size() + 3) / 4 * 4);
  }
  file.json["buffers"] = {{{"byteLength", data.size()}}};
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    GltfJson& names = file.json[list];
    names.erase(std::find(names.begin(), names.end(), "EXT_meshopt_compression"));
  }
  std::ofstream out(target, std::ios::binary);
  writeGlb(out, file.json.dump(), data);
}

}  // namespace sdf
