// A glTF file as it is read; every part of the reader looks into it. Khronos, glTF 2.0 Specification
// (2021), section numbers in comments.
#pragma once
#include <tiny_gltf.h>

#include <array>
#include <deque>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sdf/meshfile/mesh_file.h"

namespace sdf {

/// Where the bytes of a picture are: beside the file, in its text, or in a buffer view.
struct GltfPicture {
  std::string uri;
  int view = -1;
};

/// A file's structure as tinygltf has it, but for buffers and pictures, which are here: tinygltf would copy
/// the former, read files from anywhere for either, and refuse files whose pictures it cannot decode.
class GltfDocument {
 public:
  /// Errors: Files.
  static Result<GltfDocument> open(const MeshFile& file);

  const MeshFile& file() const { return *file_; }
  const tinygltf::Model& model() const { return model_; }
  const std::vector<GltfPicture>& pictures() const { return pictures_; }
  /// Contents of the file that this reader does not look at, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// The bytes of a buffer view, decoded if they are compressed (EXT_meshopt_compression).
  Result<std::string_view> view(int index);
  /// The bytes of a picture's file.
  Result<std::string> pictureBytes(const GltfPicture& picture);

 private:
  friend class GltfOpener;
  Result<std::string_view> piece(int buffer, std::size_t offset, std::size_t length, int view) const;
  Result<std::string_view> decoded(int index, const tinygltf::Value& encoding);

  const MeshFile* file_ = nullptr;
  tinygltf::Model model_;
  std::vector<std::optional<std::string_view>> buffers_;  // none: a placeholder of what is compressed
  std::deque<std::string> held_;           // what buffers_ and views_ lie in, unless in the file
  std::map<int, std::string_view> views_;  // decoded ones
  std::size_t decodable_ = 0;              // bytes that views may yet decode to
  std::vector<GltfPicture> pictures_;
  std::vector<std::string> warnings_;
};

/// The elements of an accessor (3.6.2), whichever type they are stored in.
class GltfElements {
 public:
  /// Errors: Files (the accessor contradicts itself or its buffer view).
  static Result<GltfElements> open(GltfDocument& document, int accessor);

  std::size_t count() const { return count_; }
  int components() const { return components_; }
  bool isWhole() const { return componentType_ != TINYGLTF_COMPONENT_TYPE_FLOAT && !normalized_; }
  bool isUnsigned() const;

  /// Normalised numbers as what they stand for (3.11); what an element lacks is 0. Precondition: i < count().
  glm::vec4 at(std::size_t i) const;
  /// The first component of a whole, unsigned element. Precondition: i < count().
  std::uint32_t index(std::size_t i) const;

 private:
  const char* bytesOf(std::size_t i) const;

  std::size_t count_ = 0, stride_ = 0, size_ = 0;
  int components_ = 1, componentType_ = 0;
  bool normalized_ = false;
  const char* data_ = nullptr;           // null: all 0
  std::vector<std::uint32_t> replaced_;  // sparse: rising indices of elements that lie elsewhere,
  const char* replacements_ = nullptr;   // one after the other
};

}  // namespace sdf
