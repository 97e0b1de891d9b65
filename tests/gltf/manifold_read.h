// EXT_mesh_manifold, read as a program that wants the solid reads it (Lalish 2023, EXT_mesh_manifold).
#pragma once
#include <algorithm>
#include <functional>
#include <map>

#include "gltf/read_back.h"

namespace sdf {

inline const tinygltf::Value& manifoldPrimitive(const tinygltf::Mesh& mesh) {
  return mesh.extensions.at("EXT_mesh_manifold").Get("manifoldPrimitive");
}

/// The solid's indices: those of the manifold primitive with its sparse values in their places.
inline std::vector<std::uint32_t> manifoldIndices(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  const int index = manifoldPrimitive(mesh).Get("indices").GetNumberAsInt();
  std::vector<std::uint32_t> out = wholeNumbers(model, index);
  const tinygltf::Value& extension = mesh.extensions.at("EXT_mesh_manifold");
  EXPECT_EQ(extension.Has("mergeIndices"), model.accessors.at(index).sparse.isSparse);
  EXPECT_EQ(extension.Has("mergeValues"), model.accessors.at(index).sparse.isSparse);
  if (!extension.Has("mergeIndices")) return out;
  const auto places = wholeNumbers(model, extension.Get("mergeIndices").GetNumberAsInt());
  const auto values = wholeNumbers(model, extension.Get("mergeValues").GetNumberAsInt());
  EXPECT_EQ(std::ranges::adjacent_find(places, std::greater_equal<>()), places.end());
  for (std::size_t i = 0; i < places.size(); ++i) out.at(places[i]) = values.at(i);
  return out;
}

/// Edges that do not go once each way.
inline std::size_t openEdges(const std::vector<std::uint32_t>& indices) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (std::size_t t = 0; t < indices.size(); t += 3)
    for (int k = 0; k < 3; ++k) ++ways[{indices[t + k], indices[t + (k + 1) % 3]}];
  return std::ranges::count_if(ways, [&](const auto& edge) {
    const auto back = ways.find({edge.first.second, edge.first.first});
    return edge.second != 1 || back == ways.end();
  });
}

}  // namespace sdf
