// Materials and pictures of a glTF file.
#pragma once
#include <glm/mat3x3.hpp>
#include <map>

#include "sdf/meshfile/gltf_document-inl.h"
#include "sdf/meshfile/picture.h"
#include "sdf/meshfile/read_mesh.h"

namespace sdf {

/// The texture coordinates of a material, and how it changes them.
struct GltfTextureAt {
  int set = 0;  ///< TEXCOORD_set
  glm::mat3 transform{1.0f};
  bool operator==(const GltfTextureAt&) const = default;
};

/// Takes over those materials and pictures that triangles have.
class GltfLook {
 public:
  GltfLook(GltfDocument& document, ReadMesh& out) : document_(document), out_(out) {
    out.mesh.materials.clear();
  }

  struct Used {
    std::uint32_t place;  ///< in TriangleMesh::materials
    std::optional<GltfTextureAt> textureAt;
  };
  /// The material of that index; what is in its place where there is none, depending on the colours of
  /// vertices.
  Result<Used> material(int index, bool hasColors);

 private:
  Used describe(const tinygltf::Material& from);
  /// The picture of a texture; none, with a warning, where it cannot be had.
  std::optional<TextureImage> load(int texture);
  /// Its place in TriangleMesh::images, or -1.
  int picture(int texture);
  GltfTextureAt textureAt(int set, const tinygltf::ExtensionMap& extensions) const;
  /// Has the mean of a metal and roughness texture stand for it.
  void takeMean(int texture, TriangleMaterial& material);

  GltfDocument& document_;
  ReadMesh& out_;
  PictureReader reader_;
  std::map<int, Used> used_;
  std::map<int, int> pictures_;  // by texture
};

}  // namespace sdf
