// A glTF file as it is built; every part of the writer adds to it. Khronos, glTF 2.0 Specification (2021),
// section numbers in comments.
#pragma once
#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "sdf/gltf/gltf.h"
#include "sdf/gltf/view.h"
#include "sdf/meshfile/meshopt.h"

namespace sdf {

inline std::vector<double> numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
inline std::vector<double> numbers(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

/// The measured figures, as a part's and the file's `extras` hold them.
tinygltf::Value::Object extrasOf(const MeshStats& stats);

using Texel = glm::vec<3, std::uint8_t>;

/// A tinygltf model with one buffer and one scene.
struct GltfModel : tinygltf::Model {
  GltfModel();

  std::vector<unsigned char>& bytes() { return buffers[0].data; }

  /// Adds a node to the scene, or to another node's children, and returns its index.
  int addNode(tinygltf::Node node);
  int addNode(tinygltf::Node node, int parent);
  void useExtension(const std::string& name);
  /// The same, as a required extension: readers that do not know it must not read the file.
  void requireExtension(const std::string& name);

  /// Appends elementAt(0) … elementAt(count - 1) and returns the index of a view of them. The next view
  /// begins at a multiple of four.
  template <class ElementAt>
  int addView(std::size_t count, int target, ElementAt elementAt);
  /// Index of a view of elements that a reader has to decode (EXT_meshopt_compression).
  int addView(const Encoded& encoded, int target);
  /// Index of an accessor of `count` elements from this byte of a view on.
  int addAccessor(int view, std::size_t count, int componentType, int type, std::size_t byteOffset = 0);

  /// Index of a square picture of these texels, sRGB, by rows; the same one is held once.
  int addImage(int side, std::span<const Texel> texels);

  /// Writes the file; its data is gone then. Errors: Limits (a .glb over 4 GiB, encoded views over 2 GiB).
  Status write(std::ostream& out, GltfContainer container);

 private:
  Status writeBinary(std::ostream& out);
  std::string json();
  std::string placeholder() const;
  std::vector<std::vector<unsigned char>> pictures_;  // the images as PNG
  std::size_t decodedBytes_ = 0;                      // of all encoded views
};

/// Index of the value in the list, to which it is added unless it is there.
template <class T>
int placeOf(T value, std::vector<T>& list) {
  const auto found = std::ranges::find(list, value);
  const auto place = static_cast<int>(found - list.begin());
  if (found == list.end()) list.push_back(std::move(value));
  return place;
}

/// A node of this name where the placement says; what is at the origin and not turned is not said.
tinygltf::Node placed(const std::string& name, const Placement& placement);

template <class ElementAt>
int GltfModel::addView(std::size_t count, int target, ElementAt elementAt) {
  using Element = decltype(elementAt(std::size_t{0}));
  std::vector<unsigned char>& data = bytes();
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = count * sizeof(Element);
  view.target = target;
  if (target == TINYGLTF_TARGET_ARRAY_BUFFER) view.byteStride = sizeof(Element);
  data.resize((data.size() + view.byteLength + 3) / 4 * 4);
  for (std::size_t i = 0; i < count; ++i) {
    const Element element = elementAt(i);
    std::memcpy(data.data() + view.byteOffset + i * sizeof(Element), &element, sizeof(Element));
  }
  bufferViews.push_back(std::move(view));
  return static_cast<int>(bufferViews.size()) - 1;
}

}  // namespace sdf
