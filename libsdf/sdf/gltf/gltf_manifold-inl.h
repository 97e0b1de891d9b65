// The solid that a mesh's primitives make together, in a glTF file.
#pragma once
#include "sdf/gltf/gltf_model-inl.h"
#include "sdf/gltf/manifold.h"

namespace sdf {

/// The indices of all primitives of a mesh, in one view.
struct IndexView {
  int view, componentType;
  std::size_t count;
};

/// Gives a mesh its EXT_mesh_manifold: a primitive of all triangles, its indices overlaid with the merges.
void addManifold(GltfModel& model, const IndexView& indices, const Merges& merges, tinygltf::Mesh& mesh);

}  // namespace sdf
