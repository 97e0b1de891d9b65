// glTF files read back with tinygltf's loader.
#pragma once
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace sdf {

inline tinygltf::Model load(const std::filesystem::path& file) {
  tinygltf::Model model;
  std::string error, warning;
  tinygltf::TinyGLTF loader;
  const bool loaded = file.extension() == ".glb"
                          ? loader.LoadBinaryFromFile(&model, &error, &warning, file.string())
                          : loader.LoadASCIIFromFile(&model, &error, &warning, file.string());
  EXPECT_TRUE(loaded) << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

/// The elements of an accessor, as the type they are stored in.
template <class T>
std::vector<T> elements(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(index);
  const tinygltf::BufferView& view = model.bufferViews.at(accessor.bufferView);
  std::vector<T> out(accessor.count);
  const std::size_t length = accessor.count * sizeof(T);
  EXPECT_LE(accessor.byteOffset + length, view.byteLength);
  std::memcpy(out.data(), model.buffers.at(view.buffer).data.data() + view.byteOffset + accessor.byteOffset,
              length);
  return out;
}

/// Whole numbers of 16 or 32 bits.
inline std::vector<std::uint32_t> wholeNumbers(const tinygltf::Model& model, int index) {
  if (model.accessors.at(index).componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    return elements<std::uint32_t>(model, index);
  const auto narrow = elements<std::uint16_t>(model, index);
  return {narrow.begin(), narrow.end()};
}

inline std::vector<std::uint32_t> indices(const tinygltf::Model& model,
                                          const tinygltf::Primitive& primitive) {
  return wholeNumbers(model, primitive.indices);
}

inline std::vector<glm::vec3> corners(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
  const auto positions = elements<glm::vec3>(model, primitive.attributes.at("POSITION"));
  std::vector<glm::vec3> out;
  for (const std::uint32_t i : indices(model, primitive)) out.push_back(positions.at(i));
  return out;
}

}  // namespace sdf
