// A part's mesh and materials in a glTF file.
#pragma once
#include "sdf/base/box.h"
#include "sdf/gltf/gltf_model-inl.h"

namespace sdf {

/// A node of the part's name, with its figures. Its mesh, if it has triangles, is added to the file: a
/// primitive for each material, with those materials that the file does not have yet.
tinygltf::Node partNode(GltfModel& model, const ExportPart& part);

/// About the most bytes that the part takes in the file's buffer. With room for all parts no data is moved.
std::size_t mostBytesOf(const ExportPart& part);

/// The box of all positions that the file's meshes have; empty if there are none.
Box boundsOfMeshes(const GltfModel& model);

}  // namespace sdf
