// A mesh cut into glTF's primitives: the triangles of one material, with only the vertices they use.
#pragma once
#include <cstdint>
#include <vector>

#include "sdf/mesh/mesh.h"

namespace sdf {

struct Primitive {
  std::uint32_t material = 0;
  std::vector<std::uint32_t> vertices;  ///< indices into the mesh's vertex arrays, in order of first use
  std::vector<std::uint32_t> indices;   ///< into `vertices`, three a triangle
};

/// One primitive for each run of triangles of one material, in the mesh's order. Every triangle is in exactly
/// one.
std::vector<Primitive> splitByMaterial(const Mesh& mesh);

}  // namespace sdf
